"""Vehicle to MuJoCo: `build` makes a plant of a chosen model, `write` puts it into an MJCF file."""

from __future__ import annotations

from ..models import HANDLING, MODELS, OSCILLATION, Topology
from .building import build, specification, write
from .handling import K_AND_C

__all__ = ["HANDLING", "K_AND_C", "MODELS", "OSCILLATION", "Topology", "build", "specification", "write"]
