"""Vertical tyre springs of the oscillation models."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from ...units import NonNegativeForce, Stiffness
from ..element import ForceElement, chosen_from
from ..law import Law, Parameters


def tyre_spring_force(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """``max(0, static + k_t (z_road - z_wheel))``; p = static load, k_t."""
    return max(0.0, p[0] + p[1] * deflection)


class Tyre(ForceElement):
    """A tyre as a vertical force between road and wheel.

    Attributes:
        static_load: wheel load [N] at zero deflection, the design position; None stands for the design wheel load.
    """

    kind: str
    static_load: NonNegativeForce | None = None

    def at_static_load(self, force: float) -> Tyre:
        """The same tyre, carrying `force` [N] in the design position if no load of its own is given."""
        if self.static_load is not None:
            return self
        return type(self).model_validate({**self.model_dump(), "static_load": force})


class TyreSpring(Tyre):
    """Linear tyre spring that cannot pull: ``F_t = max(0, F_static + k_t (z_road - z_wheel))``.

    Contact is lost where the force reaches zero (thesis section 5.3; physics of the quarter car in chapter 3).

    Attributes:
        rate: k_t [N/m].
    """

    law: ClassVar[Law] = Law("tyre_spring", tyre_spring_force)

    kind: Literal["spring"] = "spring"
    rate: Stiffness

    def parameters(self) -> tuple[float, ...]:
        if self.static_load is None:
            raise ValueError("tyre has no static load yet; use at_static_load(force)")
        return (self.static_load, self.rate)


TYRES: dict[str, type[Tyre]] = {"spring": TyreSpring}
AnyTyre = Annotated[Tyre, chosen_from(TYRES)]
