"""A car that drives freely with nothing but what closed forms have: linear tyres, linear springs, no kinematics but a
path."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from vehicles.reading import load_vehicle
from vehicles.vehicle import Vehicle


@dataclass(frozen=True)
class PlainCar:
    """Numbers of the car in SI; masses of the whole car, not of its body."""

    mass: float = 2090.0
    yaw_inertia: float = 4700.0
    front: float = 1.5572
    rear: float = 1.5238
    height: float = 0.6
    unsprung: float = 20.0
    track: float = 1.4
    cornering: tuple[float, float] = (120000.0, 160000.0)
    wheel_rate: tuple[float, float] = (40000.0, 40000.0)
    damping: tuple[float, float] = (4000.0, 4000.0)
    roll_centre: tuple[float, float] = (0.0, 0.0)
    tyre_rate: float = 250000.0
    rolling_resistance: float = 0.0
    drag: float = 0.0
    ratio: float = 16.0
    wheel_inertia: float = 1.0
    load_dependent: bool = False
    extra: dict[str, object] = field(default_factory=dict)

    RADIUS = 0.32

    def vehicle(self, folder) -> Vehicle:
        """The car as a vehicle file would describe it."""
        wheelbase, mu = self.front + self.rear, self.unsprung
        sprung = self.mass - 4 * mu
        behind = (self.mass * self.front - 2 * mu * wheelbase) / sprung
        arms = [self.front**2, self.front**2, self.rear**2, self.rear**2]
        of_wheels = sum(mu * (arm + (self.track / 2) ** 2) for arm in arms) + 4 * 0.55 * self.wheel_inertia
        of_wheels += 2 * max(1.0 - 0.55 * self.wheel_inertia, 0.05)
        inertia = self.yaw_inertia - of_wheels - sprung * (behind - self.front) ** 2
        lines = [
            'title = "plain car"',
            f"wheelbase = {wheelbase}",
            f"wheel_radius = {self.RADIUS}",
            "[loads.ko]",
            f"sprung_mass = {sprung}",
            f"cg = [{-behind}, 0, {(self.mass * self.height - 4 * mu * self.RADIUS) / sprung - self.RADIUS}]",
            f"inertia = [900, 3800, {inertia}]",
        ]
        for i, axle in enumerate(("front", "rear")):
            load = self.mass * 9.81 * (self.rear if axle == "front" else self.front) / wheelbase / 2
            slope = 2 * self.roll_centre[i] / self.track
            lines += [
                f"[{axle}]",
                f"track = {self.track}",
                f"unsprung_mass = {mu}",
                f"wheel_inertia = {self.wheel_inertia}",
                "spring = "
                f"{{ kind = 'linear', rate = {self.wheel_rate[i]}, stops = {{ rebound = -0.2, compression = 0.2, "
                f"rate = 1e5 }} }}",
                f"damper = {{ kind = 'zoned', rates = [{self.damping[i]}] }}",
                f"kinematics = {{ travel = [-0.2, 0, 0.2], lateral = [{-0.2 * slope}, 0, {0.2 * slope}] }}",
                "compliance = {}",
                f"[{axle}.handling_tyre]",
                "kind = 'linear'",
                f"radius = {self.RADIUS + load / self.tyre_rate}",
                f"vertical_stiffness = {self.tyre_rate}",
                "vertical_damping = 100",
                f"nominal_load = {load}",
                f"load_dependent = {str(self.load_dependent).lower()}",
                f"cornering_stiffness = {self.cornering[i] / 2}",
                "longitudinal_stiffness = 100000",
                f"rolling_resistance = {self.rolling_resistance}",
                "longitudinal_relaxation = 0.3",
                "lateral_relaxation = 0.05",
            ]
        lines += [
            "[steering]",
            f"ratio = {self.ratio}",
            "stiffness = 100000",
            "damping = 300",
            "knuckle_inertia = 1.0",
            "trail = 0",
            "scrub = 0",
            "ackermann = 0",
            "limit = 10",
            "[powertrain]",
            "driven = 'rear'",
            "speed = [50, 300, 600]",
            "full_torque = [300, 400, 300]",
            "drag_torque = [-20, -30, -50]",
            "inertia = 0.3",
            "idle_speed = 70",
            "coupling = 20",
            "gears = [3.0, 1.5, 1.0]",
            "final_drive = 3.0",
            "efficiency = 1.0",
            "shift_up = 550",
            "shift_down = 120",
            "shift_time = 0.2",
            "[brakes]",
            "torque = 8000",
            "front_share = 0.6",
            "[aerodynamics]",
            "area = 2.0",
            f"drag = {self.drag}",
            "lift_front = 0",
            "lift_rear = 0",
            "side = 0",
            "yaw = 0",
        ]
        path = folder / "plain.toml"
        path.write_text("\n".join(lines))
        return load_vehicle(path, overrides=self.extra)


def settled(run, name: str) -> float:
    """Value of a channel at the end."""
    return float(run[name][-1])


DEGREE = math.pi / 180
