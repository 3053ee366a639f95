"""A car that drives freely: where a run puts its body and its wheels."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from susp_mj.names import channel_name
from susp_mj.run import Run

from ..clip import at, stations_of, tyre_deflection
from ..rotations import about_x, about_y, about_z
from ..scene import Frame

UP = np.array([0.0, 0.0, 1.0])
"""Unit vector upwards."""


@dataclass(frozen=True)
class Chassis:
    """Measures of the car; x from the front axle, y from the middle, z from the road in the design position.

    Attributes:
        cg: the body's centre of gravity [m].
        wheelbase: [m].
        centres: wheel centres in the design position [m], by station.
        tyres: radius of the unloaded tyre [m], by station.
    """

    cg: np.ndarray
    wheelbase: float
    centres: Mapping[str, np.ndarray]
    tyres: Mapping[str, float]

    @classmethod
    def of(cls, run: Run) -> Chassis:
        """From the facts of a run, which `kinds.kind_of` has checked."""
        facts = run.meta["facts"]
        centres = {}
        for station in stations_of(run):
            axle = "front" if station[0] == "f" else "rear"
            x = 0.0 if axle == "front" else -float(facts["wheelbase"])
            y = side_of(station) * float(facts[f"track_{axle}"]) / 2
            centres[station] = np.array([x, y, float(facts[f"wheel_radius_{axle}"])])
        pressed = {
            axle: np.mean([tyre_deflection(run, each) for each in centres if each[0] == axle])
            for axle in {each[0] for each in centres}
        }
        tyres = {station: float(centre[2] + pressed[station[0]]) for station, centre in centres.items()}
        cg = np.array([float(facts["cg_x"]), float(facts.get("cg_y", 0.0)), float(facts["cg_height"])])
        return cls(cg, float(facts["wheelbase"]), centres, tyres)

    @property
    def half_track(self) -> float:
        """Largest distance of a wheel from the middle [m]."""
        return max(abs(float(centre[1])) for centre in self.centres.values())


def side_of(station: str) -> float:
    """1 for wheels of the left side, -1 for the right side."""
    return 1.0 if station[1] == "l" else -1.0


@dataclass(frozen=True)
class WheelPose:
    """Where a wheel is.

    Attributes:
        centre: [m].
        upright: (3, 3) rotation of the wheel carrier: steer and camber on top of the body's.
        spin: turning angle of the wheel, positive forwards [rad].
        load: [N].
        road: height of the road under it [m].
    """

    centre: np.ndarray
    upright: np.ndarray
    spin: float
    load: float
    road: float

    @property
    def turned(self) -> np.ndarray:
        """(3, 3) rotation of the wheel."""
        return self.upright @ about_y(self.spin)


@dataclass(frozen=True)
class HandlingPose:
    """Where a run puts the car at one time.

    Attributes:
        origin: where the point of the body is that lies on the road under the middle of the front axle in the design
            position [m].
        turned: (3, 3) rotation of the body.
        yaw: heading [rad].
        place: (x, y) of the centre of gravity [m].
        wheels: by station.
    """

    origin: np.ndarray
    turned: np.ndarray
    yaw: float
    place: np.ndarray
    wheels: Mapping[str, WheelPose]

    def frames(self, prefix: str = "") -> dict[str, Frame]:
        """Place and rotation of the car's bodies, by name."""
        placed: dict[str, Frame] = {f"{prefix}body": (self.origin, self.turned)}
        for station, wheel in self.wheels.items():
            placed[f"{prefix}{station}_wheel"] = (wheel.centre, wheel.turned)
            placed[f"{prefix}{station}_carrier"] = (wheel.centre, wheel.upright)
        return placed


class Motion:
    """The motion of a car that drives freely, from the channels of its run.

    With p a point of the body in the design position, c the centre of gravity there, and R = Rz(yaw) Ry(pitch)
    Rx(roll), the point is at ``(position_x, position_y, c_z + body_displacement) + R (p - c)``. A wheel centre moves
    along the body's z axis by the suspension deflection; the wheel is turned by ``R Rz(steer) Rx(lean) Ry(spin)``, lean
    being the inclination outwards at the top, ``spin`` the integral of the wheel speed.
    """

    def __init__(self, run: Run) -> None:
        self.run, self.chassis = run, Chassis.of(run)

    @cached_property
    def spins(self) -> dict[str, np.ndarray]:
        """(n,) turning angle of each wheel [rad]; rolling without slip where its speed was not recorded."""
        angles = {}
        for station, radius in self.chassis.tyres.items():
            name = channel_name(station, "wheel_speed")
            speed = self.run[name] if name in self.run else self.run["speed"] / radius
            angles[station] = np.concatenate([[0.0], np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(self.run.time))])
        return angles

    def pose(self, time: float) -> HandlingPose:
        """Where the car is at a time [s]."""
        run, chassis = self.run, self.chassis
        yaw = at(run, "yaw_angle", time)
        turned = about_z(yaw) @ about_y(at(run, "pitch_angle", time)) @ about_x(at(run, "roll_angle", time))
        place = np.array([at(run, "position_x", time), at(run, "position_y", time)])
        cg = np.array([*place, chassis.cg[2] + at(run, "body_displacement", time)])
        wheels = {}
        for station, centre in chassis.centres.items():
            raised = centre + at(run, channel_name(station, "suspension_deflection"), time) * UP
            steer = at(run, channel_name(station, "steer_angle"), time, 0.0)
            lean = -side_of(station) * at(run, channel_name(station, "inclination_angle"), time, 0.0)
            wheels[station] = WheelPose(
                cg + turned @ (raised - chassis.cg),
                turned @ about_z(steer) @ about_x(lean),
                float(np.interp(time, run.time, self.spins[station])),
                at(run, channel_name(station, "wheel_load"), time),
                at(run, channel_name(station, "road_height"), time, 0.0),
            )
        return HandlingPose(cg - turned @ chassis.cg, turned, yaw, place, wheels)

    def travelled(self) -> float:
        """Distance driven in the whole run [m]."""
        return float(np.hypot(np.diff(self.run["position_x"]), np.diff(self.run["position_y"])).sum())
