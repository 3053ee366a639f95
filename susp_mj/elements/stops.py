"""Hard stops that end the suspension travel in compression and in rebound."""

from __future__ import annotations

from typing import ClassVar

from pydantic import model_validator

from ..description import wrong
from ..units import Length, Stiffness
from .element import ForceElement
from .law import Law, Parameters


def stop_force(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """Zero between the stops, ``rate (x - x_stop)`` beyond either; p = rebound, compression, rate."""
    if deflection > p[1]:
        return p[2] * (deflection - p[1])
    if deflection < p[0]:
        return p[2] * (deflection - p[0])
    return 0.0


class Stops(ForceElement):
    """Hard stops: ``F = k_hs (x - x_max)`` for x > x_max, ``F = k_hs (x - x_min)`` for x < x_min, else 0.

    The spring's own force is held at its value at the stop, so both add up to the thesis' spring with hard stops
    (thesis tables A1.2 and A1.4).

    Attributes:
        rebound: deflection [m] of the rebound stop, negative.
        compression: deflection [m] of the compression stop, positive.
        rate: stiffness k_hs [N/m] of both.
    """

    law: ClassVar[Law] = Law("stops", stop_force)

    rebound: Length
    compression: Length
    rate: Stiffness = 1e7

    @model_validator(mode="after")
    def _ordered(self) -> Stops:
        if not self.rebound < 0:
            raise wrong(f"{self.rebound} m is not allowed; the rebound stop lies below 0", "rebound")
        if not self.compression > 0:
            raise wrong(f"{self.compression} m is not allowed; the compression stop lies above 0", "compression")
        return self

    def parameters(self) -> tuple[float, ...]:
        return (self.rebound, self.compression, self.rate)
