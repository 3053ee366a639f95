"""Service brakes: a friction in each wheel that holds at standstill and slides beyond its limit."""

from __future__ import annotations

from collections.abc import MutableSequence
from typing import Annotated, ClassVar, Literal

from ..units import Quantity
from .element import Element, chosen_from
from .law import Law, Parameters, Role

BRAKE = Role("brake", ("pedal", "bristle", "spin", "front"), ("torque", "bristle_rate"))
"""Of one wheel's brake: ``brake(pedal, bristle, spin, front, p, out)`` with the pedal [0 to 1], the wind-up of the
friction as an inner state, the speed of the wheel against its carrier [rad/s], and 1 for a front wheel, 0 for a rear
one. It writes the torque against the turning [N m] and the rate of the inner state [1/s]."""
BRISTLE, BRISTLE_TIME, BRISTLE_DAMPING = 0.02, 1e-3, 2e-3
"""Wind-up of a brake that holds [rad], its shortest time [s] when sliding fast, and its damping time when it holds
[s]."""


def proportional_brake(
    pedal: float, bristle: float, spin: float, front: float, p: Parameters, out: MutableSequence[float]
) -> None:
    """The formulas of `ProportionalBrakes`; p = torque of all wheels, share of the front axle."""
    share = p[1] if front > 0.0 else 1.0 - p[1]
    rate = (spin - abs(spin) * bristle) / max(BRISTLE, abs(spin) * BRISTLE_TIME)
    largest = p[0] * share / 2.0
    out[0] = largest * max(pedal, 0.0) * min(max(bristle + BRISTLE_DAMPING * rate, -1.0), 1.0)
    out[1] = rate


class Brakes(Element):
    """Brakes of the four wheels; `law` is that of one wheel, see `BRAKE`."""

    role: ClassVar[Role] = BRAKE

    kind: str


class ProportionalBrakes(Brakes):
    """Brakes whose torque is proportional to the pedal, with a fixed distribution; both wheels of an axle brake alike.

    A front wheel gets ``pedal * torque * front_share / 2``, against its turning. With the wind-up b of a bristle,
    ``db/dt = (w - |w| b)/max(0.02 rad, |w| 1 ms)`` and the torque in proportion to ``b + (2 ms) db/dt``, at most 1: a
    wheel that has stopped is held (Dahl's friction).

    Attributes:
        torque: sum over all wheels [N m] at full pedal.
        front_share: share of the front axle, 0 to 1.
    """

    law: ClassVar[Law] = Law("proportional_brake", proportional_brake, role=BRAKE)

    kind: Literal["proportional"] = "proportional"
    torque: Annotated[float, Quantity("N m", gt=0)]
    front_share: Annotated[float, Quantity("", ge=0, le=1)]

    def parameters(self) -> tuple[float, ...]:
        return (self.torque, self.front_share)


BRAKES: dict[str, type[Brakes]] = {"proportional": ProportionalBrakes}
AnyBrakes = Annotated[Brakes, chosen_from(BRAKES, usual="proportional")]
