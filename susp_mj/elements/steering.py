"""Steering: ratio and elasticity between the steering wheel and the front wheels, geometry of the steering axis."""

from __future__ import annotations

import math
from typing import Annotated

from ..description import Description
from ..units import Inertia, Length, Quantity


def limited_angle(angle: float, rate: float, limit: float) -> tuple[float, float]:
    """Angle [rad] of the steering wheel and its rate, held where it goes no further."""
    return (math.copysign(limit, angle), 0.0) if abs(angle) > limit else (angle, rate)


def rack_angle(angle: float, rate: float, ratio: float, bend: float) -> tuple[float, float]:
    """Angle [rad] that the rack gives a wheel, ``d + bend d²`` with ``d = angle/ratio``, and its rate.

    Args:
        angle, rate: of the steering wheel.
        bend: ``ackermann track/(2 wheelbase)``, negative for the right wheel.
    """
    mean, mean_rate = angle / ratio, rate / ratio
    return mean + bend * mean * mean, mean_rate * (1.0 + 2.0 * bend * mean)


class Steering(Description):
    """Rack steering of the front wheels, elastic between the rack and each wheel.

    The steering wheel angle, positive to the left, divided by the ratio is the mean angle that the rack gives the
    wheels; the two differ by `ackermann` of the ideal difference. Each wheel, of inertia J about its steering axis,
    hangs on the rack by a spring and a damper, and the tyre turns it: ``J d'' + D (d' - d_rack') + C (d - d_rack) = M_z
    - F_y trail -+ F_x scrub``, minus for the left wheel and plus for the right one: a force forwards toes both in when
    their axes stand inboard of the patches.

    Attributes:
        ratio: angle of the steering wheel per mean angle of the front wheels.
        stiffness: C [N m/rad] of one wheel about its steering axis, steering wheel held.
        damping: D [N m s/rad] of one wheel about its steering axis.
        knuckle_inertia: J [kg m²] of one wheel with its carrier about its steering axis. The wheel alone has 0.55 of
            its `wheel_inertia`; the carrier is given at least 5 % of J.
        trail: caster trail [m] at the ground, positive when the axis meets the ground ahead of the contact patch; a
            lateral force then turns the wheel towards straight running.
        scrub: scrub radius [m] at the ground, positive when the axis meets the ground inboard of the contact patch.
        ackermann: share of the ideal (Ackermann) difference of the angles: 0 both wheels parallel, 1 both wheels' axes
            meet on the line of the rear axle.
        limit: largest angle [rad] of the steering wheel to either side.
    """

    ratio: Annotated[float, Quantity("", gt=0)]
    stiffness: Annotated[float, Quantity("N m/rad", gt=0)]
    damping: Annotated[float, Quantity("N m s/rad", gt=0)]
    knuckle_inertia: Inertia
    trail: Length
    scrub: Length
    ackermann: Annotated[float, Quantity("", ge=0, le=1)]
    limit: Annotated[float, Quantity("rad", gt=0)]

    @property
    def largest_wheel_angle(self) -> float:
        """``limit / ratio`` [rad], what the rack gives a wheel at most."""
        return self.limit / self.ratio
