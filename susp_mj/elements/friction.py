"""Friction of the suspension linkage."""

from __future__ import annotations

import math
from typing import ClassVar

from ..units import NonNegativeForce
from .element import ForceElement
from .law import Law, Parameters


def linkage_friction_force(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """``F_max (2/pi) arctan(201.7 v)``; p = F_max."""
    return p[0] * 2.0 / math.pi * math.atan(201.7 * speed)


class LinkageFriction(ForceElement):
    """Regularised Coulomb friction of joints and bushings: ``F = F_max (2/pi) arctan(201.7 v)`` (thesis 5.13).

    201.7 s/m makes it 90 % of F_max at 0.0314 m/s, the peak speed of 0.01 m at 0.5 Hz.

    Attributes:
        force: F_max [N]; 0 is none.
    """

    law: ClassVar[Law] = Law("linkage_friction", linkage_friction_force)

    force: NonNegativeForce

    def parameters(self) -> tuple[float, ...]:
        return (self.force,)
