"""Speed of the car that drives freely: real-time factor, cost of its callbacks, and the CommonRoad multi-body model
beside it."""

from __future__ import annotations

import importlib.util
import math
import warnings
from collections.abc import Callable, Sequence

import numpy as np
from measuring import REPEATS, Result, callback_cost, quickest, ratio
from scipy.integrate import odeint, solve_ivp

from manoeuvres import StepSteer
from susp_mj import simulate
from susp_mj.compiled import input_block
from susp_mj.inputs import sample_inputs
from susp_mj.plant import Plant
from susp_mj.run import Run
from susp_mj.trim import Blocks, trimmed
from vehicles import load_vehicle
from vehicles.mjcf import build

STEP = 1e-3
DURATION = 9.0
NEWER_TYRE = {
    f"{axle}.handling_tyre.{key}": value
    for axle in ("front", "rear")
    for key, value in (("kind", "magic_formula_61"), ("file", "mf61_205_60R15.tir"))
}
SHARED = StepSteer(duration=DURATION, angle=np.radians(40), rate=np.radians(300))
"""The step steer that both programs drive. CommonRoad's wheels turn at 0.4 rad/s at most (0.36 here). Its tyres may
pull on the road: after the 85° of our own figures the inner front wheel's load becomes negative and the solution grows
without bounds within 3 s."""

State = Sequence[float] | np.ndarray
Rates = Callable[[State, float], list[float]]


def handling() -> list[Result]:
    """Real-time factor of a recorded step steer, and what the callbacks cost."""
    saloon = build(load_vehicle("s_class", "configuration_4"), "handling")
    small = build(load_vehicle("bmw_320i"), "handling")
    newer = build(load_vehicle("bmw_320i", overrides=NEWER_TYRE), "handling")
    text = "3D car, step steer 9 s at 1 ms"
    return [
        Result(f"{text}, recorded: simulated / real time", _real_time(saloon, 4 * REPEATS), 40.0, "x", more=True),
        Result(
            "3D car, step steer 1 s at 1 ms: compiled callbacks / the same MJCF without them",
            _callbacks(saloon),
            1.6,
            "x",
        ),
        Result(f"{text}, bmw_320i: simulated / real time", _real_time(small, REPEATS), None, "x", more=True),
        Result(f"{text}, bmw_320i, tyre 6.1: simulated / real time", _real_time(newer, REPEATS), None, "x", more=True),
        Result("3D car, step steer 1 s at 1 ms, bmw_320i, tyre 6.1: callbacks / without", _callbacks(newer), None, "x"),
    ]


def _real_time(plant: Plant, repeats: int) -> float:
    manoeuvre = StepSteer(duration=DURATION)
    return DURATION / quickest(lambda: simulate(plant, manoeuvre, step=STEP), repeats)


def _callbacks(plant: Plant) -> float:
    """Short repetitions, all of them in the curve: without its forces the car falls."""
    manoeuvre, steps = StepSteer(start=0.0), 1000
    samples = sample_inputs(plant, manoeuvre, np.arange(2 * steps + 1) * (STEP / 2))
    blocks = Blocks(input_block(samples, STEP / 2, plant.entries()))
    return callback_cost(plant, trimmed(plant, blocks, manoeuvre.speed), blocks, steps, 5 * REPEATS)


def against_commonroad() -> list[Result | str]:
    """The same step steer by the multi-body model of M. Althoff and G. Würsching (BSD licence), vehicle 2, in Python.

    It is integrated as its users do, by odeint with its defaults as in its README, and with fixed steps. Odeint takes
    long steps once the car is on its circle, and what it records are states alone; accelerations, which our records
    have, take one more evaluation per record.

    The two are one car by their figures, yet CommonRoad's turns in more sharply at equal angles of the road wheels: its
    yaw rate is 15 % higher at 2 m/s², 20 % at 4 m/s². At 2 m/s² 7 % of that are the tyre's shifts by camber, which
    change sign with it there and belong to the side of the car here; 4 % the influence of load, which its tyre table
    lacks, so that load transfer costs no cornering stiffness; 2 % the aligning moment, which it does not have. Without
    all three the yaw rates differ by 1 %. Ours rolls by 10 % more per lateral acceleration: what accelerates the wheels
    sideways acts at their centres and is borne by the body's springs (7 %), where its rigid axles bear it themselves;
    and the turning wheels' gyroscopic moment (3 %) is not in its equations.
    """
    if importlib.util.find_spec("vehiclemodels") is None:
        return ["no comparison with CommonRoad: pip install commonroad-vehicle-models, or the extra 'bench'"]
    plant = build(load_vehicle("bmw_320i"), "handling")
    run = simulate(plant, SHARED, step=STEP)
    settled = {name: float(run[name][-500:].mean()) for name in ("yaw_rate", "lateral_acceleration", "roll_angle")}
    rates, start = _commonroad(_wheel_angle(run))
    time = np.arange(len(run.time)) * STEP
    theirs = _states(rates, start, time)
    fixed = _stepped(rates, start, len(time) - 1)
    if abs(fixed[5] - theirs[-1, 5]) > 1e-3 * abs(fixed[5]):
        raise SystemExit("CommonRoad's model does not come out the same from odeint and from fixed steps")

    def ours() -> object:
        return simulate(plant, SHARED, step=STEP)

    def lsoda() -> object:
        return solve_ivp(
            lambda t, x: rates(x, t), (0.0, DURATION), start, method="LSODA", t_eval=time, max_step=20 * STEP
        )

    def with_rates() -> object:
        return [rates(x, t) for x, t in zip(_states(rates, start, time), time, strict=True)]

    text = "CommonRoad MB, step steer 9 s at 1 ms"
    end = theirs[-1]
    return [
        Result(
            f"{text}: odeint, states only / susp_mj",
            ratio(lambda: _states(rates, start, time), ours, 5),
            None,
            "x",
            more=True,
        ),
        Result(f"{text}: LSODA, steps <= 20 ms / susp_mj", ratio(lsoda, ours, 5), None, "x", more=True),
        Result(f"{text}: odeint, and accelerations / susp_mj", ratio(with_rates, ours, 3), None, "x", more=True),
        Result(
            f"{text}: RK4 in Python / susp_mj",
            ratio(lambda: _stepped(rates, start, len(time) - 1), ours, 3),
            None,
            "x",
            more=True,
        ),
        f"  yaw rate {end[5]:.4f} (susp_mj {settled['yaw_rate']:.4f}) rad/s, lateral acceleration "
        f"{end[5] * end[3]:.2f} "
        f"({settled['lateral_acceleration']:.2f}) m/s², roll {math.degrees(-end[6]):.2f} "
        f"({math.degrees(settled['roll_angle']):.2f})°",
    ]


def _wheel_angle(run: Run) -> float:
    """Angle of the road wheels on the circle [rad], mean of both: CommonRoad steers the wheels, ours are turned back by
    their tyres."""
    return float(np.mean([run[f"{corner}_steer_angle"][-500:].mean() for corner in ("fl", "fr")]))


def _commonroad(angle: float) -> tuple[Rates, list[float]]:
    """Right-hand side of CommonRoad's model, in odeint's order, and its initial state; half a cosine to `angle`, speed
    held."""
    from vehiclemodels.init_mb import init_mb
    from vehiclemodels.parameters_vehicle2 import parameters_vehicle2
    from vehiclemodels.vehicle_dynamics_mb import vehicle_dynamics_mb

    parameters = parameters_vehicle2()
    rise, began, speed = SHARED.rise_time, SHARED.start, SHARED.speed
    peak = angle / rise * math.pi / 2

    def rates(x: State, t: float) -> list[float]:
        share = (t - began) / rise
        steering = peak * math.sin(math.pi * share) if 0.0 < share < 1.0 else 0.0
        return vehicle_dynamics_mb(x, [steering, 20.0 * (speed - math.hypot(x[3], x[10]))], parameters)

    return rates, init_mb([0.0, 0.0, 0.0, speed, 0.0, 0.0, 0.0], parameters)


def _states(rates: Rates, start: list[float], time: np.ndarray) -> np.ndarray:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return odeint(rates, start, time)


def _stepped(rates: Rates, start: Sequence[float], steps: int) -> Sequence[float]:
    """Classical Runge-Kutta on lists, which its scalar code takes three times as fast as arrays; returns the last
    state."""
    x, h = start, STEP
    for step in range(steps):
        t = step * h
        k1 = rates(x, t)
        k2 = rates([a + h / 2 * b for a, b in zip(x, k1, strict=True)], t + h / 2)
        k3 = rates([a + h / 2 * b for a, b in zip(x, k2, strict=True)], t + h / 2)
        k4 = rates([a + h * b for a, b in zip(x, k3, strict=True)], t + h)
        x = [a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(x, k1, k2, k3, k4, strict=True)]
    return x
