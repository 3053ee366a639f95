"""The car that drives freely a second time: equations of motion written down by hand, plain numpy and scipy, no code of
the product's car.

Newton and Euler in body axes (x forward, y left, z up, origin in the body's centre of gravity). With A the acceleration
of the centre of gravity, w the body's angular velocity and ``r = (X, Y, Z + z)`` a wheel of mass m that slides along
the body's z axis,

    a = A + w' x r + w x (w x r) + 2 w x z' e_z + z'' e_z
    force    M A + sum m a                                = F + (M + sum m) g
    moment   I w' + w x I w + sum r x m a + sum dH/dt     = T + sum r x m g
    travel   m a . e_z                                    = Q_z + m g . e_z
    steering e_z . dH/dt                                  = Q_d
    spin     e . dH/dt                                    = Q_s

where H is the angular momentum of knuckle and wheel about the wheel's centre, ``e = (-sin d, cos d, 0)`` the spin axis,
s the spin, ``W = w + d' e_z`` the knuckle's angular velocity and ``dH/dt = (J_k + J_t) W' + (J_s - J_t) ((W' . e) e +
(W . e) W x e) + J_s (s' e + s W x e)``, the gyroscopic moment being its last part. Q are the partial velocities of the
contact patch and the partial angular velocities of the wheel times the tyre's force and moment (Kane). The spin is that
against the body, which is what a drive shaft sees; the contact patch lies below the wheel's centre and moves along its
path. A brake rubs on the carrier, which turns about the lateral axis as it travels, by ``theta(z)``: it adds ``T
theta'`` to Q_z.

The orientation is kept as yaw, pitch, roll (z, y, x); tables are splines of the given points, in two dimensions where
they have two. Taken from the product are descriptions and the laws of single elements: springs, dampers, stops,
friction, the tyre's contact law. The road is flat, the car rolls forwards faster than walking pace; gears are those
that a run has recorded.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline, PchipInterpolator, RectBivariateSpline
from scipy.optimize import root

G = 9.81
SIDE = np.array([1.0, -1.0, 1.0, -1.0])
EZ = np.array([[0.0], [0.0], [1.0]])
WHEELS = ("fl", "fr", "rl", "rr")
# what the theory page states of the car beyond its description
BUSHING_TIME, BRISTLE, BRISTLE_TIME, BRISTLE_DAMPING = 0.005, 0.02, 1e-3, 2e-3
LEAST_RELAXATION, LEAST_TIME = 0.05, 7e-4
SLIDING_SLIP = 0.15
SHIFT_OPEN, MATCHING_TIME = 0.6, 0.05
CONTROL_GAIN, CONTROL_INTEGRAL, WIND_UP = 1.5, 0.5, 1.2
STALL_SPEED, IDLE_GAIN, TRANSVERSE = 220.0, 10.0, 0.55


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Vector product of columns."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def skew(a: np.ndarray) -> np.ndarray:
    """Matrix of ``a x``."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def rotation(yaw: float, pitch: float, roll: float) -> np.ndarray:
    """Body to inertial axes."""
    (cz, cy, cx), (sz, sy, sx) = np.cos((yaw, pitch, roll)), np.sin((yaw, pitch, roll))
    return np.array(
        [
            [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
            [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
            [-sy, cy * sx, cy * cx],
        ]
    )


class AxleTables:
    """Kinematics and compliance of both wheels of an axle, as for the left one.

    The carrier's turn about the lateral axis is what the wheel centre moves forwards more than the contact patch, over
    its height.
    """

    def __init__(self, axle: Any, height: float) -> None:
        given, elastic = axle.kinematics, axle.compliance
        z, steer = np.array(given.travel), np.array(given.steer)
        swing = (given.path("longitudinal_centre") - given.path("longitudinal")) / height
        paths = np.column_stack([given.path("lateral"), given.path("longitudinal_centre"), swing])
        angles = [given.angles("toe"), given.angles("camber")]
        ends = "not-a-knot" if len(z) > 2 else "natural"
        self.over_steer: list[RectBivariateSpline] = []
        if len(steer) and any(np.ptp(each, axis=1).any() for each in angles):
            self.over_steer = [RectBivariateSpline(z, steer, each, kx=3, ky=3) for each in angles]
        else:
            paths = np.column_stack([paths, *(each[:, 0] for each in angles)])
        self.over_travel = CubicSpline(z, paths, bc_type=ends)
        self.slope = self.over_travel.derivative()
        nothing = [0.0] * 500
        self.elastic: list[tuple[int, PchipInterpolator]] = []
        for which, (force, toe, camber) in enumerate(
            (
                (elastic.lateral_force, elastic.toe, elastic.camber),
                (elastic.longitudinal_force, elastic.toe_longitudinal, ()),
                (elastic.aligning_moment, elastic.toe_aligning, ()),
            )
        ):
            if force:
                n = len(force)
                self.elastic.append(
                    (which, PchipInterpolator(force, np.column_stack([toe or nothing[:n], camber or nothing[:n]])))
                )

    def at(self, z: np.ndarray, steer: np.ndarray, forces: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Outwards, forwards, swing, toe, camber of both wheels; their slopes over travel; slopes of toe and camber
        over steering.

        Args:
            z, steer: (2,) travel, and steering with the sign of a left wheel.
            forces: (3, 2) inwards, forwards, moment to toe-in, as the elastic suspension feels them.
        """
        value, slope, over_steer = self.over_travel(z).T, self.slope(z).T, np.zeros((2, 2))
        if self.over_steer:
            value = np.vstack([value, *(each.ev(z, steer) for each in self.over_steer)])
            slope = np.vstack([slope, *(each.ev(z, steer, dx=1) for each in self.over_steer)])
            over_steer = np.array([each.ev(z, steer, dy=1) for each in self.over_steer])
        value = value.copy()
        for which, curve in self.elastic:
            value[3:] += curve(forces[which]).T
        return value, slope, over_steer


class Corner:
    """Elements of one corner as plain functions: force between wheel and body, speed of the damper rod, the tyre's
    law."""

    def __init__(self, axle: Any, side: str) -> None:
        parts = [axle.spring, axle.spring.stops, *([axle.friction] if axle.friction is not None else [])]
        self.parts = [(part.active_law.function, part.parameters()) for part in parts]
        law = axle.damper.active_law
        self.damper, self.rod, self.damping = law.function, law.state_rate, axle.damper.parameters()
        self.tyre = axle.handling_tyre.mounted(side)
        self.contact, self.numbers = self.tyre.law.function, self.tyre.parameters()

    def suspension(self, z: float, speed: float, rod: float) -> tuple[float, float]:
        force = sum(law(z, speed, 0.0, p) for law, p in self.parts) + self.damper(z, speed, rod, self.damping)
        return force, speed if self.rod is None else self.rod(z, speed, rod, self.damping)

    def grip(
        self, kappa: float, tangent: float, camber: float, load: float, rolling: float, lateral: float
    ) -> list[float]:
        """F_x, F_y, M_x, M_y, M_z, relaxation lengths, rolling radius."""
        out = [0.0] * 8
        self.contact(kappa, tangent, camber, load, rolling, lateral, 1.0, self.numbers, out)
        return out


_SIZES = {
    "place": 3, "angles": 3, "velocity": 3, "turning": 3, "z": 4, "z_rate": 4, "steer": 2, "steer_rate": 2, "spin": 4,
    "kappa": 4,
    "tangent": 4, "bristle": 4, "elastic": 12, "rod": 4, "engine": 1, "integral": 1,
}  # fmt: skip
_ENDS = np.cumsum([0, *_SIZES.values()])
AT = {name: slice(start, start + size) for (name, size), start in zip(_SIZES.items(), _ENDS[:-1], strict=True)}
STATES = int(_ENDS[-1])
"""The state: place and angles inertial, velocities in body axes."""


class ReferenceCar:
    """The car of a vehicle description; `inputs` are functions of time by quantity."""

    def __init__(self, vehicle: Any, load: str = "ko") -> None:
        case, front, rear = vehicle.load(load), vehicle.axle("front"), vehicle.axle("rear")
        axles = [front, front, rear, rear]
        self.vehicle, self.wheelbase = vehicle, vehicle.wheelbase
        self.corners = [Corner(axle, "LEFT" if side > 0 else "RIGHT") for axle, side in zip(axles, SIDE, strict=True)]
        self.bars = [0.0 if axle.anti_roll_bar is None else axle.anti_roll_bar.rate for axle in (front, rear)]
        self.mass, self.inertia = case.sprung_mass, np.diag(case.inertia)
        self.unsprung = np.array([axle.unsprung_mass for axle in axles])
        self.whole = self.mass + self.unsprung.sum()
        self.radius = np.array([corner.tyre.radius for corner in self.corners])
        self.rate = np.array([corner.tyre.vertical_stiffness for corner in self.corners])
        self.damping = np.array([corner.tyre.vertical_damping for corner in self.corners])
        x = np.array([0.0, 0.0, -vehicle.wheelbase, -vehicle.wheelbase])
        y = SIDE * np.array([axle.track for axle in axles]) / 2
        self.hubs = np.array([x - case.cg[0], y - case.cg[1], np.full(4, -case.cg[2])])
        carried = (
            np.array([vehicle.corner_mass(name, "ko") for name in ("front", "front", "rear", "rear")]) + self.unsprung
        )
        heights = self.radius - carried * G / self.rate
        self.design = heights[0] - case.cg[0] / vehicle.wheelbase * (heights[2] - heights[0]) + case.cg[2]
        self.place = np.array([case.cg[0], case.cg[1], self.design])
        self.tables = [AxleTables(front, heights[0]), AxleTables(rear, heights[2])]
        steering = vehicle.steering
        self.spin_inertia = np.array([axle.wheel_inertia for axle in axles])
        knuckle = steering.knuckle_inertia
        self.across = TRANSVERSE * self.spin_inertia
        self.upright = np.where(x == 0.0, np.maximum(knuckle - self.across, 0.05 * knuckle), 0.0)
        self.arm = np.array([np.where(x == 0, -steering.trail, 0.0), np.where(x == 0, SIDE * steering.scrub, 0.0)])
        self.bend = SIDE[:2] * steering.ackermann * front.track / (2 * vehicle.wheelbase)
        brakes, train = vehicle.brakes, vehicle.powertrain
        self.brake = brakes.torque / 2 * np.array([brakes.front_share] * 2 + [1 - brakes.front_share] * 2)
        self.driven = np.array([float((train.driven == "front") == (each == 0.0)) for each in x])
        self.full, self.drag = (
            PchipInterpolator(train.speed, curve) for curve in (train.full_torque, train.drag_torque)
        )
        self.converter = max(train.full_torque) / STALL_SPEED**2
        self.idle_torque = float(np.interp(train.idle_speed, train.speed, train.full_torque))
        self.inputs: dict[str, Callable[[float], tuple[float, float]]] = {}
        self.trim_angle = 0.0
        self.gear: Callable[[float], tuple[float, float]] = lambda t: (train.gears[-1], 1e3)
        self.free_pedal = False

    def input(self, name: str, t: float) -> tuple[float, float]:
        """Value and rate of an input, 0 where it is not given."""
        return self.inputs[name](t) if name in self.inputs else (0.0, 0.0)

    # ---- power train, brakes, air

    def drive(
        self, t: float, spin: np.ndarray, engine: float, integral: float, speed: float
    ) -> tuple[float, float, float]:
        """Torque on each driven wheel, rates of engine and controller."""
        train = self.vehicle.powertrain
        ratio, since = self.gear(t)
        speed_in = spin @ self.driven / 2 * train.final_drive * ratio
        ratio *= train.final_drive
        full, drag = float(self.full(engine)), float(self.drag(engine))
        target, weight = self.input("speed_target", t)[0], self.input("speed_control", t)[0]
        error = target - speed
        radius = float(self.radius[self.driven > 0][-1])
        wanted = ((CONTROL_GAIN * self.whole * error + integral) * radius / ratio / train.efficiency - drag) / (
            full - drag
        )
        share = wanted if self.free_pedal else min(max(wanted, 0.0), 1.0)
        stuck = (wanted > WIND_UP and error > 0) or (wanted < 1 - WIND_UP and error < 0)
        torque = (
            drag
            + weight * share * (full - drag)
            + min(max(IDLE_GAIN * (train.idle_speed - engine), 0.0), self.idle_torque)
        )
        closed = min(max((since / max(train.shift_time, 1e-3) - SHIFT_OPEN) / (1 - SHIFT_OPEN), 0.0), 1.0)
        lock = min(max(2 * speed_in / train.idle_speed - 1.6, 0.0), 1.0)
        passed = closed * (self.converter * engine + lock * train.coupling) * (engine - speed_in)
        passed = min(max(passed, -2 * max(train.full_torque)), 2 * max(train.full_torque))
        efficiency = train.efficiency if passed > 0 else 1 / train.efficiency
        integral_rate = 0.0 if stuck else weight * CONTROL_INTEGRAL * self.whole * error
        matched = (max(speed_in, train.idle_speed) - engine) / MATCHING_TIME
        engine_rate = closed * (torque - passed) / train.inertia + (1 - closed) * matched
        return passed * ratio * efficiency / 2, engine_rate, integral_rate

    def air(self, velocity: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Force and moment about the centre of gravity, body axes; still air."""
        a, (u, v) = self.vehicle.aerodynamics, -velocity[:2]
        pressure, square = a.density * a.area / 2, u * u + v * v
        beta = math.atan2(v, -u)
        front, rear = pressure * square * a.lift_front, pressure * square * a.lift_rear
        force = np.array([pressure * a.drag * math.sqrt(square) * u, pressure * a.side * square * beta, front + rear])
        moment = np.array([0.0, (rear - front) * self.wheelbase / 2, pressure * square * self.wheelbase * a.yaw * beta])
        at = np.array([-self.wheelbase / 2, 0.0, 0.0]) - self.place
        return force, moment + cross(at, force)

    # ---- equations of motion

    def rates(self, t: float, state: np.ndarray, record: dict[str, Any] | None = None) -> np.ndarray:
        """Derivative of the state; `record` takes what the wheels do."""
        s = {name: state[part] for name, part in AT.items()}
        turn, w, v = rotation(*s["angles"]), s["turning"], s["velocity"]
        z, z_rate, spin = s["z"], s["z_rate"], s["spin"]
        steer, steer_rate = np.append(s["steer"], [0.0, 0.0]), np.append(s["steer_rate"], [0.0, 0.0])
        felt = s["elastic"].reshape(3, 4)

        # where each wheel is and how it stands: outwards, forwards, swing, toe, camber
        guided = [
            table.at(z[i], SIDE[i] * steer[i], np.array([-SIDE[i] * felt[1][i], felt[0][i], -SIDE[i] * felt[2][i]]))
            for table, i in zip(self.tables, (slice(0, 2), slice(2, 4)), strict=True)
        ]
        (out, ahead, _, toe, camber), slope, over_steer = (np.hstack(each) for each in zip(*guided, strict=True))
        sine, cosine = np.sin(steer), np.cos(steer)
        lever = np.array([cosine * self.arm[0] - sine * self.arm[1], sine * self.arm[0] + cosine * self.arm[1]])
        centre = self.hubs + np.array([lever[0] - self.arm[0] + ahead, lever[1] - self.arm[1] + SIDE * out, z])
        up = turn[2]  # the inertial z axis in body axes, normal of the road
        loaded = (s["place"][2] + up @ centre) / up[2]
        contact = centre - loaded * EZ
        w_column = w[:, None]
        partial_z = np.array([slope[1], SIDE * slope[0], np.ones(4)])  # of the contact patch over travel
        partial_d = np.array([-lever[1], lever[0], np.zeros(4)])  # and over steering
        moving = v[:, None] + cross(w_column, contact) + partial_z * z_rate + partial_d * steer_rate

        heading, lean = steer - SIDE * toe, -SIDE * camber
        axis = np.array([-np.sin(heading) * np.cos(lean), np.cos(heading) * np.cos(lean), np.sin(lean)])
        normal = np.broadcast_to(up[:, None], (3, 4))
        forward = cross(axis, normal)
        forward /= np.sqrt((forward**2).sum(0))
        left = cross(normal, forward)
        tilt = np.arcsin((axis * normal).sum(0))
        rolling, lateral = (moving * forward).sum(0), (moving * left).sum(0)
        pressed = self.radius - loaded
        load = np.where(
            pressed > 0, np.maximum(self.rate * pressed - self.damping * (moving * normal).sum(0), 0.0), 0.0
        )

        # tyres, slips and brakes
        columns = zip(self.corners, s["kappa"], s["tangent"], tilt, load, rolling, lateral, strict=True)
        tyre = np.array([corner.grip(*map(float, each)) for corner, *each in columns]).T
        fx, fy, mx, my, mz, sigma_x, sigma_y, effective = tyre
        size = np.abs(rolling)
        least = np.maximum(LEAST_RELAXATION, size * LEAST_TIME)
        along, across = (
            sigma / (1 + (s[slip] / SLIDING_SLIP) ** 2) for sigma, slip in ((sigma_x, "kappa"), (sigma_y, "tangent"))
        )
        kappa_rate = (spin * effective - rolling - size * s["kappa"]) / np.maximum(along, least)
        tan_rate = (lateral - size * s["tangent"]) / np.maximum(across, least)
        rubbing = spin - slope[2] * z_rate
        bristle_rate = (rubbing - np.abs(rubbing) * s["bristle"]) / np.maximum(BRISTLE, np.abs(rubbing) * BRISTLE_TIME)
        braking = (
            self.brake * self.input("brake_pedal", t)[0] * np.clip(s["bristle"] + BRISTLE_DAMPING * bristle_rate, -1, 1)
        )
        velocity = turn @ v
        drive, engine_rate, integral_rate = self.drive(
            t, spin, s["engine"][0], s["integral"][0], math.hypot(velocity[0], velocity[1])
        )
        elastic_rate = (np.array([fx, fy, mz]) - felt) / BUSHING_TIME

        # forces of the road: at the contact patch, and the couple that makes the rolling radius the lever of F_x about
        # the spin axis
        push = fx * forward + fy * left + load * normal
        twist = mx * forward + (my - fx * (effective - loaded)) * axis + mz * normal
        about_x = np.array([np.cos(heading), np.sin(heading), np.zeros(4)])
        turning_z = -SIDE * (slope[4] * about_x + slope[3] * EZ)  # partial angular velocities of the wheel
        turning_d = (1 - over_steer[0]) * EZ - over_steer[1] * about_x
        between = [
            corner.suspension(*map(float, each))
            for corner, *each in zip(self.corners, z, z_rate, s["rod"], strict=True)
        ]
        internal, rod_rate = np.array(between).T
        bar = np.array([self.bars[0] * (z[0] - z[1]) / 2, self.bars[1] * (z[2] - z[3]) / 2])
        internal = internal + np.array([bar[0], -bar[0], bar[1], -bar[1]])
        q_travel = (push * partial_z + twist * turning_z).sum(0) + braking * slope[2] - internal
        steering = self.vehicle.steering
        angle, angle_rate = self.input("steering_wheel_angle", t)
        rack, rack_rate = (angle + self.trim_angle) / steering.ratio, angle_rate / steering.ratio
        target, target_rate = rack + self.bend * rack**2, rack_rate * (1 + 2 * self.bend * rack)
        q_steer = (push * partial_d + twist * turning_d).sum(0)[:2]
        q_steer -= steering.stiffness * (steer[:2] - target) + steering.damping * (steer_rate[:2] - target_rate)
        q_spin = drive * self.driven - braking + my - fx * effective
        air_force, air_moment = self.air(v)
        force = push.sum(1) + air_force
        moment = (cross(contact, push) + twist).sum(1) + air_moment

        solved = self._accelerations(
            w, z, z_rate, steer, steer_rate, spin, -G * up, force, moment, q_travel, q_steer, q_spin
        )
        acceleration, w_rate = solved[:3], solved[3:6]
        _, pitch, roll = s["angles"]
        yaw_rate = (w[1] * math.sin(roll) + w[2] * math.cos(roll)) / math.cos(pitch)
        angle_rates = (yaw_rate, w[1] * math.cos(roll) - w[2] * math.sin(roll), w[0] + yaw_rate * math.sin(pitch))
        if record is not None:
            level = turn @ acceleration
            yaw = s["angles"][0]
            record |= {
                "yaw_rate": yaw_rate, "roll_angle": roll, "pitch_angle": pitch,
                "body_displacement": s["place"][2] - self.design,
                "lateral_acceleration": math.cos(yaw) * level[1] - math.sin(yaw) * level[0],
                "longitudinal_acceleration": math.cos(yaw) * level[0] + math.sin(yaw) * level[1],
                "speed": math.hypot(velocity[0], velocity[1]), "engine_speed": s["engine"][0],
                "side_slip_angle": math.atan2(velocity[1], velocity[0]) - yaw,
            }  # fmt: skip
            wheels = {
                "wheel_load": load, "suspension_deflection": z, "slip_angle": np.arctan(s["tangent"]),
                "slip_ratio": s["kappa"],
                "camber_angle": tilt, "steer_angle": heading, "longitudinal_force": fx, "lateral_force": fy,
                "aligning_moment": mz,
                "drive_torque": drive * self.driven, "brake_torque": braking, "wheel_speed": spin,
                "inclination_angle": camber,
            }  # fmt: skip
            record |= {
                f"{name}_{quantity}": each
                for quantity, values in wheels.items()
                for name, each in zip(WHEELS, values, strict=True)
            }
        return np.concatenate(
            [
                velocity, angle_rates, acceleration - cross(w, v), w_rate, z_rate, solved[6:10], steer_rate[:2],
                solved[10:12],
                solved[12:], kappa_rate, tan_rate, bristle_rate, elastic_rate.ravel(), rod_rate, [engine_rate],
                [integral_rate],
            ]
        )  # fmt: skip

    def _accelerations(
        self, w, z, z_rate, steer, steer_rate, spin, gravity, force, moment, q_travel, q_steer, q_spin
    ) -> np.ndarray:
        """A and w' in body axes, z'', d'', s' from the equations above."""
        m, js, jt, jk = self.unsprung, self.spin_inertia, self.across, self.upright
        r = self.hubs + z * EZ
        axis = np.array([-np.sin(steer), np.cos(steer), np.zeros(4)])
        column = w[:, None]
        left, right = np.zeros((16, 16)), np.zeros(16)
        # what the wheels' accelerations have without the unknowns, their weight, and the rest of dH/dt
        free = cross(column, cross(column, r)) + 2 * cross(column, z_rate * EZ) - gravity[:, None]
        knuckle = column + steer_rate * EZ
        turned = cross(column, steer_rate * EZ)
        swept = cross(knuckle, axis)
        rest = (
            (jk + jt) * turned
            + (js - jt) * ((turned * axis).sum(0) * axis + (knuckle * axis).sum(0) * swept)
            + js * spin * swept
        )

        left[:3, :3] = self.whole * np.eye(3)
        arms = skew((m * r).sum(1))
        left[:3, 3:6], left[3:6, :3] = -arms, arms
        outer = (m * r) @ r.T
        left[3:6, 3:6] = (
            self.inertia
            + np.trace(outer) * np.eye(3)
            - outer
            + (jk + jt).sum() * np.eye(3)
            + ((js - jt) * axis) @ axis.T
        )
        travel, hinge, turning = slice(6, 10), slice(10, 12), slice(12, 16)
        left[2, travel] = left[travel, 2] = m
        left[3:6, travel] = cross(r, m * EZ)
        left[travel, 3:6] = left[3:6, travel].T
        left[travel, travel] = np.diag(m)
        left[5, hinge] = left[hinge, 5] = (jk + jt)[:2]
        left[hinge, hinge] = np.diag((jk + jt)[:2])
        left[3:6, turning] = js * axis
        left[turning, 3:6] = left[3:6, turning].T
        left[turning, turning] = np.diag(js)

        right[:3] = force + self.mass * gravity - (m * free).sum(1)
        right[3:6] = moment - cross(w, self.inertia @ w) - (cross(r, m * free) + rest).sum(1)
        right[travel] = q_travel - m * free[2]
        right[hinge] = q_steer - rest[2, :2]
        right[turning] = q_spin - js * (turned * axis).sum(0)
        return np.linalg.solve(left, right)

    # ---- straight running and motion

    def trimmed(self, speed: float) -> np.ndarray:
        """State of steady straight running along x; sets the steering wheel angle that keeps it straight."""
        inputs, self.free_pedal = self.inputs, True
        self.inputs = {"speed_target": lambda t: (speed, 0.0), "speed_control": lambda t: (1.0, 0.0)}
        free = ["spin", "kappa", "tangent", "elastic", "engine", "integral"]
        scale = np.concatenate([np.ones(10), np.full(4, 10.0), np.ones(8), np.full(12, 1e3), [10.0, 1e3, 1.0]])
        rolling = speed / self.radius
        ratio, _ = self.gear(0.0)
        start = np.zeros(37)
        start[10:14], start[34] = (
            rolling / 10,
            rolling @ self.driven / 2 * ratio * self.vehicle.powertrain.final_drive / 10,
        )

        def entered(values: np.ndarray) -> np.ndarray:
            values = values * scale
            state = np.zeros(STATES)
            state[AT["place"]] = self.place + np.array([0.0, 0.0, values[0]])
            state[AT["angles"]] = values[1:4]
            state[AT["velocity"]] = rotation(*values[1:4]).T @ [speed, 0.0, 0.0]
            state[AT["z"]] = state[AT["rod"]] = values[4:8]
            state[AT["steer"]], state[AT["bristle"]], self.trim_angle = values[8:10], 1.0, values[36]
            at = 10
            for name in free:
                state[AT[name]] = values[at : at + _SIZES[name]]
                at += _SIZES[name]
            return state

        rows = [
            AT[name]
            for name in ("velocity", "turning", "z_rate", "steer_rate", "spin", "kappa", "tangent", "elastic", "engine")
        ]
        sizes = np.concatenate([np.ones(24), np.full(12, 1e3), [10.0]])

        def left_over(values: np.ndarray) -> np.ndarray:
            found = self.rates(0.0, entered(values))
            return np.concatenate([found[part] for part in rows]) / sizes

        solution = root(left_over, start, tol=1e-12)
        state = entered(solution.x)
        assert np.abs(left_over(solution.x)).max() < 1e-5, solution.message
        self.inputs, self.free_pedal = inputs, False
        return state

    def drive_along(
        self, speed: float, duration: float, inputs: Mapping[str, Any], *, step: float = 1e-3
    ) -> dict[str, np.ndarray]:
        """Channels at every millisecond, by Kutta's rule of third order; inputs as (time, value) pairs with straight
        lines between."""
        self.inputs = {name: _lines(points) for name, points in inputs.items()}
        state = self.trimmed(speed)
        every, records, steps = round(1e-3 / step), [], round(duration / step)
        for n in range(steps + 1):
            t, record = n * step, {}
            one = self.rates(t, state, record)
            if n % every == 0:
                records.append(record)
            if n < steps:
                two = self.rates(t + step / 2, state + step / 2 * one)
                three = self.rates(t + step, state - step * one + 2 * step * two)
                state = state + step / 6 * (one + 4 * two + three)
        return {name: np.array([each[name] for each in records]) for name in records[0]}


def _lines(points: Any) -> Callable[[float], tuple[float, float]]:
    moments, values = (np.array(each, float) for each in zip(*points, strict=True))
    slopes = np.concatenate([[0.0], np.diff(values) / np.diff(moments), [0.0]])
    return lambda t: (
        float(np.interp(t, moments, values)),
        float(slopes[np.searchsorted(moments, t + 1e-12, side="right")]),
    )


def recorded_gears(
    time: np.ndarray, gear: np.ndarray, ratios: tuple[float, ...]
) -> Callable[[float], tuple[float, float]]:
    """Ratio and time since the last shift, from a run."""
    at = np.flatnonzero(np.diff(gear)) + 1
    moments, places = np.array([-1e3, *time[at]]), np.array([gear[0], *gear[at]]).astype(int)

    def engaged(t: float) -> tuple[float, float]:
        i = int(np.searchsorted(moments, t + 1e-9, side="right")) - 1
        return ratios[places[i] - 1], t - moments[i]

    return engaged
