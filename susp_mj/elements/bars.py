"""Elements that act on the roll of axle and body: anti-roll bars, gravity on a rolling body."""

from __future__ import annotations

from typing import ClassVar

from ..units import NonNegativeStiffness
from .element import ForceElement
from .law import Law, Parameters


def anti_roll_bar_force(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """``c (x - x_other) / 2``; the deflection is the difference of both wheels', p = c."""
    return p[0] * deflection / 2.0


def overturning_moment(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """``- m g h phi``: gravity pulls a body further over; p = m g h."""
    return -p[0] * deflection


class AntiRollBar(ForceElement):
    """Anti-roll bar (stabiliser): ``F = c (x_left - x_right) / 2`` on the left wheel, its opposite on the right.

    The rate c is force per wheel over that wheel's own travel in pure roll, so its roll moment is ``c t²/2 phi``.

    Attributes:
        rate: c [N/m] at the wheel; 0 is a car without a bar.

    Source: thesis appendix 9; the definition is reconstructed, it closes the thesis' own numbers.
    """

    law: ClassVar[Law] = Law("anti_roll_bar", anti_roll_bar_force)

    rate: NonNegativeStiffness

    def parameters(self) -> tuple[float, ...]:
        return (self.rate,)


class Overturning(ForceElement):
    """Gravity on a body that rolls about an axis below its centre of gravity: moment ``m g h phi`` in the sense of phi.

    Attributes:
        moment: m g h [N m/rad], h the height of the centre of gravity above the roll axis.
    """

    law: ClassVar[Law] = Law("overturning", overturning_moment)

    moment: float

    def parameters(self) -> tuple[float, ...]:
        return (self.moment,)
