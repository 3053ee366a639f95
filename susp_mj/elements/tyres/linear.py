"""Linear tyre: forces proportional to slip, for checks against closed forms."""

from __future__ import annotations

from collections.abc import MutableSequence
from typing import Annotated, ClassVar, Literal

from ...units import NonNegativeLength, PositiveForce, Quantity
from ..law import Law, Parameters
from .contact_tyre import CONTACT, ContactTyre
from .slip import SMALLEST_RELAXATION

CorneringStiffness = Annotated[float, Quantity("N/rad", ge=0)]
RADIUS, NOMINAL, PROPORTIONAL, C_X, C_Y, C_CAMBER, TRAIL, ROLLING, SIGMA_X, SIGMA_Y = range(10)
STANDSTILL = 0.1
"""Rolling speed [m/s] below which trail and rolling resistance fade, linearly, to zero at standstill."""


def linear_contact(
    kappa: float,
    tan_alpha: float,
    camber: float,
    load: float,
    rolling: float,
    lateral: float,
    friction: float,
    p: Parameters,
    out: MutableSequence[float],
) -> None:
    """The formulas of `LinearContactTyre`; `lateral` and `friction` change nothing."""
    for i in range(5):
        out[i] = 0.0
    out[5], out[6], out[7] = p[SIGMA_X], p[SIGMA_Y], p[RADIUS]
    if load <= 0.0:
        return
    share = load / p[NOMINAL] if p[PROPORTIONAL] != 0.0 else 1.0
    direction = min(max(rolling / STANDSTILL, -1.0), 1.0)
    force = -share * p[C_Y] * tan_alpha
    out[0] = share * p[C_X] * kappa
    out[1] = force - share * p[C_CAMBER] * camber
    out[3] = -p[ROLLING] * p[RADIUS] * load * direction
    out[4] = -p[TRAIL] * force * direction


class LinearContactTyre(ContactTyre):
    """Linear tyre: ``F_x = C_x s kappa``, ``F_y = -s (C_y tan alpha + C_g gamma)``, ``M_z = t s C_y tan alpha``.

    The share s is ``F_z/F_zN`` with `load_dependent`, else 1, and 0 without contact. ``M_x = 0``,
    ``M_y = -f_r R_0 F_z``, ``R_e = R_0``. Rolling backwards M_y and M_z change sign; below 0.1 m/s they fade to zero.
    It never saturates: there is no friction, and the road's factor on it changes nothing.

    Attributes:
        radius, vertical_stiffness, vertical_damping: as for every `ContactTyre`.
        nominal_load: F_zN [N] at which the stiffnesses hold.
        load_dependent: whether forces are proportional to the load; if not they are the same at any load above zero.
        cornering_stiffness: C_y [N/rad].
        longitudinal_stiffness: C_x [N].
        camber_stiffness: C_g [N/rad], a side force towards the lean; without moment.
        pneumatic_trail: t [m].
        rolling_resistance: f_r [1].
        longitudinal_relaxation, lateral_relaxation: sigma_x, sigma_y [m]; the law gives at least 0.05 m.

    Source: [pacejka2012], section 1.2 and chapter 7 (relaxation).
    """

    law: ClassVar[Law] = Law("linear_contact", linear_contact, role=CONTACT)

    kind: Literal["linear"] = "linear"
    nominal_load: PositiveForce
    load_dependent: bool = True
    cornering_stiffness: CorneringStiffness
    longitudinal_stiffness: Annotated[float, Quantity("N", ge=0)]
    camber_stiffness: CorneringStiffness = 0.0
    pneumatic_trail: NonNegativeLength = 0.0
    rolling_resistance: Annotated[float, Quantity("", ge=0)] = 0.0
    longitudinal_relaxation: NonNegativeLength = 0.0
    lateral_relaxation: NonNegativeLength = 0.0

    def parameters(self) -> tuple[float, ...]:
        return (
            self.radius,
            self.nominal_load,
            float(self.load_dependent),
            self.longitudinal_stiffness,
            self.cornering_stiffness,
            self.camber_stiffness,
            self.pneumatic_trail,
            self.rolling_resistance,
            max(self.longitudinal_relaxation, SMALLEST_RELAXATION),
            max(self.lateral_relaxation, SMALLEST_RELAXATION),
        )
