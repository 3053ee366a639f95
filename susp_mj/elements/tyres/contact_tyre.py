"""What every tyre of the handling car has in common: forces and moments of the contact from slip, camber and load."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, NamedTuple, Self

from ...units import PositiveLength, Quantity, Stiffness
from ..element import Element
from ..law import Role, numbers_of

Side = Literal["LEFT", "RIGHT"]
VerticalDamping = Annotated[float, Quantity("N s/m", ge=0)]


class ContactForces(NamedTuple):
    """What a contact law writes, in its order. Axes ISO-W: x forward in the wheel plane, y left, z up out of the road.

    Attributes:
        longitudinal_force, lateral_force: F_x, F_y [N] of the road on the tyre.
        overturning_moment: M_x [N m], positive left side up.
        rolling_moment: M_y [N m] of rolling resistance alone, negative rolling forwards.
        aligning_moment: M_z [N m], positive to the left.
        longitudinal_relaxation, lateral_relaxation: sigma_x, sigma_y [m].
        rolling_radius: R_e [m].
    """

    longitudinal_force: float
    lateral_force: float
    overturning_moment: float
    rolling_moment: float
    aligning_moment: float
    longitudinal_relaxation: float
    lateral_relaxation: float
    rolling_radius: float


CONTACT = Role(
    "contact",
    ("kappa", "tan_alpha", "camber", "load", "rolling", "lateral", "friction"),
    ContactForces._fields,
)
"""Of a tyre on the road: ``contact(kappa, tan_alpha, camber, load, rolling, lateral, friction, p, out)`` with the slips
kappa and tan alpha [1] (lagged ones, see `slip`; a driven wheel has kappa > 0, a tyre that drifts to the left alpha > 0
and F_y < 0), camber [rad] (positive: the wheel leans to the right), load F_z [N], velocity of the contact point
forwards ``rolling`` V_x and to the left ``lateral`` V_y [m/s], and the road's ``friction`` [1], a factor on the
friction of the measurement. It writes the eight numbers of `ContactForces`, at zero load no force and no moment, and
divides by no speed."""


class ContactTyre(Element):
    """Description of a tyre with slip; `law` turns `parameters()` into forces and moments.

    A subclass provides its `kind` as a `Literal`, the class attribute `law` and `parameters`.

    Attributes:
        radius: R_0 [m], unloaded.
        vertical_stiffness: C_z [N/m] of the tyre on the road.
        vertical_damping: D_z [N s/m] of the tyre on the road.
    """

    role: ClassVar[Role] = CONTACT

    kind: str
    radius: PositiveLength
    vertical_stiffness: Stiffness
    vertical_damping: VerticalDamping = 0.0

    def mounted(self, side: Side) -> Self:
        """The same tyre on a side of the car; mirrored where it was measured on the other one."""
        del side
        return self

    def evaluate(
        self,
        kappa: float = 0.0,
        tan_alpha: float = 0.0,
        camber: float = 0.0,
        load: float = 0.0,
        rolling: float = 20.0,
        lateral: float = 0.0,
        friction: float = 1.0,
    ) -> ContactForces:
        """Forces and moments of the law, in Python; arguments as in `CONTACT`."""
        asked = (kappa, tan_alpha, camber, load, rolling, lateral, friction)
        return ContactForces(*self.law.answer(*asked, parameters=numbers_of(self)))
