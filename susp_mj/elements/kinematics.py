"""How a wheel moves in its suspension: path, toe and camber over travel and steering, and what the forces add."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from ..description import Description, wrong
from ..units import Angle, Force, Length, Moment
from .element import FloatArray
from .stops import Stops
from .tables import ORIGIN, AngleTable, check_increasing, check_length, check_zero, origin_of


class Kinematics(Description):
    """Kinematics of one wheel, as measured on a rig with the body held: tables over its travel, toe and camber also
    over steering.

    Everything is given for the left wheel, with signs that need no side: outwards, toe-in, top outwards. The right
    wheel is its mirror image: the table is read at minus its steer angle. A positive slope ``dy/dz`` of the lateral
    path lifts the body when the tyre is pushed inwards, and the roll centre stands ``(track/2) dy/dz`` above the
    ground; a positive slope ``dx/dz`` of the longitudinal path lifts the body when the tyre is pushed rearwards.
    (Virtual work: a force F_out, F_forward on the contact patch adds ``F_out y' + F_forward x'`` to the force that
    compresses the suspension.)

    Attributes:
        travel: z [m], (n,) strictly increasing, with a point at 0 (design position); positive in compression. It must
            reach from stop to stop.
        steer: [rad], (m,) strictly increasing, with a point at 0; the angle that the rack gives the wheel, positive to
            the left. Empty: toe and camber depend on travel alone. Front axle only.
        lateral: y [m], (n,) movement of the contact patch outwards, 0 at travel 0. Empty: none.
        longitudinal: x [m], (n,) movement of the contact patch forwards, 0 at travel 0. Empty: none.
        longitudinal_centre: [m], (n,) movement of the wheel centre forwards, 0 at travel 0, where the carrier turns
            about the lateral axis as it travels. A brake holds the wheel on the carrier, so its force acts along the
            path of the patch; a drive shaft turns it from the body, so its force acts along the path of the centre.
            Empty: as the patch.
        toe: [rad], (n,) or (n, m), positive toe-in; adds to the angle from the rack, so the left wheel stands at
            ``steer - toe``. At travel 0 it is the static toe. Empty: none.
        camber: [rad], (n,) or (n, m), to the body, positive with the top outwards. At travel 0 it is the static camber.
            Empty: none.
    """

    travel: tuple[Length, ...] = Field(max_length=500)
    steer: tuple[Angle, ...] = Field(default=(), max_length=100)
    lateral: tuple[Length, ...] = ()
    longitudinal: tuple[Length, ...] = ()
    longitudinal_centre: tuple[Length, ...] = ()
    toe: AngleTable = ()
    camber: AngleTable = ()

    @model_validator(mode="after")
    def _tables(self) -> Kinematics:
        check_increasing(self.travel, "travel", "m", "travels")
        origin = origin_of(self.travel, "travel", "m")
        if self.steer:
            check_increasing(self.steer, "steer", "rad", "steer angles")
            origin_of(self.steer, "steer", "rad")
        for key in ("lateral", "longitudinal", "longitudinal_centre"):
            path: tuple[float, ...] = getattr(self, key)
            if path:
                check_length(path, key, self.travel, "travel")
                check_zero(path, key, origin, "m", "travel")
        for key, angles in (("toe", self.toe), ("camber", self.camber)):
            if angles:
                check_length(angles, key, self.travel, "travel")
                self._check_rows(key, angles)
        return self

    def _check_rows(self, key: str, angles: tuple[tuple[float, ...], ...]) -> None:
        columns = len(angles[0])
        allowed = "one value" if not self.steer else f"one value, or {len(self.steer)} as steer has"
        for i, row in enumerate(angles):
            if len(row) not in (1, len(self.steer)):
                raise wrong(f"a row of {len(row)} is not allowed; give {allowed}", f"{key}.{i}")
            if len(row) != columns:
                raise wrong(f"a row of {len(row)} is not allowed; the first row has {columns}", f"{key}.{i}")

    def path(self, name: Literal["lateral", "longitudinal", "longitudinal_centre"]) -> FloatArray:
        """Movement [m] of the contact patch, or of the wheel centre, at each travel, (n,)."""
        values: tuple[float, ...] = getattr(self, name)
        if name == "longitudinal_centre" and not values:
            values = self.longitudinal
        return np.array(values or [0.0] * len(self.travel))

    def angles(self, name: Literal["toe", "camber"]) -> FloatArray:
        """Toe or camber [rad] at each travel and steer angle, (n, m); m is 1 without steer angles."""
        values = self.toe if name == "toe" else self.camber
        shape = (len(self.travel), max(1, len(self.steer)))
        return np.broadcast_to(np.array(values), shape).copy() if values else np.zeros(shape)

    def check_covers(self, stops: Stops, key: str) -> None:
        """Refuse a table that ends before the stops; `key` is the dotted path of these kinematics."""
        if self.travel[0] > stops.rebound + ORIGIN or self.travel[-1] < stops.compression - ORIGIN:
            raise wrong(
                f"{self.travel[0]:g} to {self.travel[-1]:g} m does not cover the stops, "
                f"{stops.rebound:g} to {stops.compression:g} m; it must reach from stop to stop",
                f"{key}.travel",
            )

    def check_covers_steering(self, angle: float, key: str) -> None:
        """Refuse a table that ends before the largest angle [rad] that the rack gives a wheel to either side."""
        if self.steer and (self.steer[0] > -angle + ORIGIN or self.steer[-1] < angle - ORIGIN):
            raise wrong(
                f"{self.steer[0]:.4g} to {self.steer[-1]:.4g} rad does not cover the steering, "
                f"{-angle:.4g} to {angle:.4g} rad (steering.limit / steering.ratio)",
                f"{key}.steer",
            )

    def roll_centre_height(self, track: float) -> float:
        """Height [m] of the axle's roll centre above the ground in the design position: ``(track/2) dy/dz``.

        The slope is that of the parabola through the point at travel 0 and its neighbours, one-sided at an end.
        """
        origin = origin_of(self.travel, "travel", "m")
        order = 2 if len(self.travel) > 2 else 1
        slope = np.gradient(self.path("lateral"), np.array(self.travel), edge_order=order)
        return track / 2 * float(slope[origin])


class Compliance(Description):
    """Elastic part of toe and camber of one wheel over the forces in its contact patch, added to the kinematics.

    Signs need no side, as in `Kinematics`; both wheels of an axle share the tables. Each table is 0 at force 0. In a
    curve the force on the outer wheel points inwards: a front axle that understeers toes out there (toe below 0), a
    rear axle toes in (above 0).

    Attributes:
        lateral_force: [N], strictly increasing, with a point at 0; force of the road on the tyre, positive inwards
            (towards the other wheel of the axle).
        toe: [rad] at each lateral force, positive toe-in.
        camber: [rad] at each lateral force, positive with the top outwards.
        longitudinal_force: [N], strictly increasing, with a point at 0; positive forwards.
        toe_longitudinal: [rad] at each longitudinal force, positive toe-in.
        aligning_moment: [N m], strictly increasing, with a point at 0; moment of the road on the tyre about the
            vertical axis, positive when it turns the wheel to toe-in.
        toe_aligning: [rad] at each aligning moment, positive toe-in.

    All are empty by default: a rigid suspension.
    """

    lateral_force: tuple[Force, ...] = Field(default=(), max_length=500)
    toe: tuple[Angle, ...] = ()
    camber: tuple[Angle, ...] = ()
    longitudinal_force: tuple[Force, ...] = Field(default=(), max_length=500)
    toe_longitudinal: tuple[Angle, ...] = ()
    aligning_moment: tuple[Moment, ...] = Field(default=(), max_length=500)
    toe_aligning: tuple[Angle, ...] = ()

    @model_validator(mode="after")
    def _tables(self) -> Compliance:
        for argument, unit, what, results in (
            ("lateral_force", "N", "forces", ("toe", "camber")),
            ("longitudinal_force", "N", "forces", ("toe_longitudinal",)),
            ("aligning_moment", "N m", "moments", ("toe_aligning",)),
        ):
            arguments = getattr(self, argument)
            given = [key for key in results if getattr(self, key)]
            if not arguments:
                if given:
                    raise wrong(f"is required by {given[0]}", argument)
                continue
            if not given:
                raise wrong(f"stands alone; give {' or '.join(results)} with it", argument)
            check_increasing(arguments, argument, unit, what)
            origin = origin_of(arguments, argument, unit)
            for key in given:
                check_length(getattr(self, key), key, arguments, argument)
                check_zero(getattr(self, key), key, origin, "rad", argument)
        return self
