"""Measured signals on simulated ones: filtered alike, laid on each other in time, and judged by a band of tolerance."""

from .findings import Findings, Judgement, PeakErrors, Shift
from .judgement import judge
from .settings import MeasuredSignal, Tolerance, Validation
from .standards import STANDARDS

__all__ = [
    "STANDARDS",
    "Findings",
    "Judgement",
    "MeasuredSignal",
    "PeakErrors",
    "Shift",
    "Tolerance",
    "Validation",
    "judge",
]
