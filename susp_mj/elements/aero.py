"""Aerodynamics: drag, lift at the axles, side force and yaw moment in the wind."""

from __future__ import annotations

import math
from collections.abc import MutableSequence
from typing import Annotated, ClassVar, Literal

from ..units import Dimensionless, Quantity
from .element import Element, chosen_from
from .law import Law, Parameters, Role

AIR = Role("air", ("along", "across", "wheelbase"), ("x", "y", "z", "roll", "pitch", "yaw"))
"""Of the air around the car: ``air(along, across, wheelbase, p, out)`` with the velocity of the air relative to the car
(wind less the car's own) in the car's axes, forwards and to the left [m/s], and the wheelbase [m]. It writes force [N]
and moment [N m] in the car's axes about the reference point: on the ground, in the middle of wheelbase and track."""
AIR_DENSITY = 1.225
"""Of the standard atmosphere at sea level [kg/m³] (ISO 2533)."""


def linear_air(along: float, across: float, wheelbase: float, p: Parameters, out: MutableSequence[float]) -> None:
    """The formulas of `LinearAerodynamics`; p = rho A/2, drag, lift front, lift rear, side, yaw."""
    for i in range(6):
        out[i] = 0.0
    square = along * along + across * across
    if square < 1e-12:
        return
    beta = math.atan2(across, -along)
    q = p[0] * square
    front, rear = q * p[2], q * p[3]
    out[0], out[1], out[2] = p[0] * p[1] * math.sqrt(square) * along, q * p[4] * beta, front + rear
    out[4], out[5] = (rear - front) * (wheelbase / 2.0), q * wheelbase * p[5] * beta


class Aerodynamics(Element):
    """Force and moment of the air on the car; see `AIR`."""

    role: ClassVar[Role] = AIR

    kind: str


class LinearAerodynamics(Aerodynamics):
    """Air forces in the car's axes at the reference point: on the ground, in the middle of wheelbase and track.

    With u the velocity of the air relative to the car (wind less the car's own), ``V² = u_x² + u_y²`` and the angle of
    the relative wind ``beta = atan2(u_y, -u_x)``, positive for wind from the right (air that flows to the left):

        drag        ``F_x = 1/2 rho A drag V u_x``            rearwards when driving, with c_w = drag
        lift        ``F_z = 1/2 rho A lift_front V²``          at the front axle, upwards; `lift_rear` likewise
        side force  ``F_y = 1/2 rho A side V² beta``           to the left for wind from the right
        yaw moment  ``M_z = 1/2 rho A l yaw V² beta``          l the wheelbase; nose to the left for wind from the right

    The linear terms in beta are good to about 0.5 rad. The usual measurement gives the pitching moment of the drag to
    the lifts of the axles, and so does this one: F_x acts at ground level.

    Attributes:
        area: frontal area A [m²].
        drag: c_w [1].
        lift_front, lift_rear: [1], upwards, related to the whole frontal area.
        side: slope of the side force coefficient [1/rad].
        yaw: slope of the yaw moment coefficient [1/rad].
        density: rho of the air [kg/m³].
    """

    law: ClassVar[Law] = Law("linear_air", linear_air, role=AIR)

    kind: Literal["linear"] = "linear"
    area: Annotated[float, Quantity("m²", gt=0)]
    drag: Annotated[float, Quantity("", ge=0)]
    lift_front: Dimensionless
    lift_rear: Dimensionless
    side: Annotated[float, Quantity("1/rad")]
    yaw: Annotated[float, Quantity("1/rad")]
    density: Annotated[float, Quantity("kg/m³", ge=0)] = AIR_DENSITY

    def parameters(self) -> tuple[float, ...]:
        half = self.density * self.area / 2
        return (half, self.drag, self.lift_front, self.lift_rear, self.side, self.yaw)


AERODYNAMICS: dict[str, type[Aerodynamics]] = {"linear": LinearAerodynamics}
AnyAerodynamics = Annotated[Aerodynamics, chosen_from(AERODYNAMICS, usual="linear")]
