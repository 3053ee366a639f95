"""Linear spring and damper side by side: a servo that holds a freedom, the elasticity between rack and wheel."""

from __future__ import annotations

from typing import ClassVar

from .element import ForceElement
from .law import Law, Parameters


def spring_damper_force(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """``k e + d de/dt`` of the deviation e; p = k, d."""
    return p[0] * deflection + p[1] * speed


class SpringDamper(ForceElement):
    """Linear spring and damper side by side, ``k e + d de/dt``, along a length or about an axis.

    Attributes:
        stiffness: k [N/m or N m/rad].
        damping: d [N s/m or N m s/rad].
    """

    law: ClassVar[Law] = Law("spring_damper", spring_damper_force)

    stiffness: float
    damping: float

    def parameters(self) -> tuple[float, ...]:
        return (self.stiffness, self.damping)
