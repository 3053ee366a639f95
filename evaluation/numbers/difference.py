"""Difference: a number beside the same one of a baseline."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, TypeGuard

from ..display import number_text, quantity_text
from .number import Number

LARGEST_SHARE = 1000.0
"""Beyond that share of the baseline [%] it is as good as zero, and the difference itself says more."""


@dataclass(frozen=True)
class Difference:
    """A number less that of the baseline.

    Attributes:
        value: in SI `unit`; None where one of the two has no value.
        percent: ``100 (v/b - 1)`` of value v and baseline b; None where b is zero, as shown.
        unit: SI unit.
    """

    value: float | None
    percent: float | None
    unit: str

    @property
    def text(self) -> str:
        """In per cent of the baseline, or in the number's own unit where there is no share or no sensible one.

        >>> Difference(-0.02, -12.5, "m").text, Difference(0.02, None, "m").text, Difference(None, None, "m").text
        ('−12.5 %', '+20.0 mm', '–')
        """
        if self.value is None:
            return "–"
        if self.percent is None or abs(self.percent) > LARGEST_SHARE:
            return _signed(quantity_text(self.value, self.unit))
        text = f"{self.percent:.1f}"
        return f"{_signed(text.replace('-', '−') if float(text) else text.lstrip('-'))} %"

    def plain(self) -> dict[str, Any]:
        """As plain JSON values."""
        return {"value": self.value, "percent": self.percent}


def _signed(text: str) -> str:
    nothing = text.startswith("−") or not any(digit in text for digit in "123456789")
    return text if nothing else f"+{text}"


def difference(number: Number, baseline: Number) -> Difference:
    """How a number differs from the same one of the baseline.

    >>> difference(Number(-1500.0, "N"), Number(-2000.0, "N"))
    Difference(value=500.0, percent=-25.0, unit='N')
    """
    if not (_known(number.value) and _known(baseline.value)):
        return Difference(None, None, number.unit)
    value = number.value - baseline.value
    zero = not any(digit in number_text(baseline.value, baseline.unit) for digit in "123456789")
    return Difference(value, None if zero else 100.0 * value / baseline.value, number.unit)


def _known(value: float | None) -> TypeGuard[float]:
    return value is not None and math.isfinite(value)
