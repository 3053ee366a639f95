"""Aerodynamics: drag, lift at the axles, side force and yaw moment in the wind."""

from __future__ import annotations

from typing import Annotated

from ..description import Description
from ..units import Dimensionless, Quantity

AIR_DENSITY = 1.225
"""Of the standard atmosphere at sea level [kg/m³] (ISO 2533)."""


class Aerodynamics(Description):
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

    area: Annotated[float, Quantity("m²", gt=0)]
    drag: Annotated[float, Quantity("", ge=0)]
    lift_front: Dimensionless
    lift_rear: Dimensionless
    side: Annotated[float, Quantity("1/rad")]
    yaw: Annotated[float, Quantity("1/rad")]
    density: Annotated[float, Quantity("kg/m³", ge=0)] = AIR_DENSITY
