"""Speed and size as ratios measured in one run: ``make bench``.

Each line states what is compared, the limit, and what was measured. Ratios are medians of alternating repetitions, so
that a machine whose speed drifts does not matter.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import mujoco
import numpy as np
from bench_handling import against_commonroad, handling
from measuring import REPEATS, Result, callback_cost, quickest, ratio
from scipy.integrate import solve_ivp

from manoeuvres import Bump
from susp_mj import simulate
from susp_mj.compiled import input_block
from susp_mj.inputs import sample_inputs
from susp_mj.plant import Plant
from susp_mj.trim import Blocks
from vehicles import load_vehicle
from vehicles.mjcf import build

sys.path.insert(0, str(Path(__file__).parent.parent))
from tests.verification.reference import bump_road
from tests.verification.thesis_cars import CHAPTER_3


def quarter_car() -> tuple[Plant, Bump]:
    """The non-linear quarter car of chapter 3 and its bump."""
    return build(load_vehicle("chapter3", "nonlinear"), "quarter_2dof"), Bump()


def whole_car() -> tuple[Plant, Bump]:
    """The saloon on seven degrees of freedom and a bump at 80 km/h."""
    return build(load_vehicle("s_class", "configuration_4"), "full_7dof"), Bump(height=0.05, length=4.0, speed=80 / 3.6)


def callbacks(name: str, plant: Plant, manoeuvre: Bump, limit: float) -> Result:
    """The same MJCF stepped with the compiled callbacks and without."""
    block = input_block(sample_inputs(plant, manoeuvre, np.arange(6001) * 5e-4), 5e-4, plant.entries())
    measured = callback_cost(plant, mujoco.MjData(plant.model), Blocks(block), 3000, 3 * REPEATS)
    return Result(f"{name} bump 3 s at 1 ms: compiled callbacks / the same MJCF without them", measured, limit, "x")


def real_time() -> Result:
    """How many times faster than the clock the whole car runs, recording included, on one core.

    Not a ratio of two programs, hence the quickest repetition.
    """
    plant, manoeuvre = whole_car()
    taken = quickest(lambda: simulate(plant, manoeuvre, step=1e-3), 4 * REPEATS)
    return Result(
        "OM7 bump 3 s at 1 ms, recorded: simulated / real time", manoeuvre.duration / taken, 60.0, "x", more=True
    )


def cars() -> list[Result]:
    """Cost of the callbacks and speed of the whole car."""
    return [callbacks("OM5", *quarter_car(), 1.25), callbacks("OM7", *whole_car(), 1.3), real_time()]


def numpy_rates(manoeuvre: Bump) -> Callable[[float, np.ndarray], np.ndarray]:
    """The non-linear quarter car as a script would have it: numpy, the inverse damper characteristic as a look-up.

    Returns rates of (z_body, v_body, z_wheel, v_wheel, y), then body acceleration and wheel load.
    """
    m, mu, g, w = 483.5, 39.5, 9.81, 2 * np.pi * 1.2
    speed = np.array([-40.2, -0.2, 0.0, 0.2, 40.2])
    force = np.array([-32800.0, -800.0, 0.0, 400.0, 16400.0])
    period = manoeuvre.length / manoeuvre.speed

    def rates(t: float, s: np.ndarray) -> np.ndarray:
        zb, vb, zw, vw, y = s
        x, v = zw - zb, vw - vb
        inside = np.clip(x, -0.1, 0.1)
        spring = 4743.0 * np.exp(w**2 * inside / g) + 1e7 * (x - inside)
        mount = 4e5 * (x - y)
        rod = np.interp(np.sign(mount) * np.maximum(np.abs(mount) - 25.0, 0.0), force, speed)
        total = spring + mount + 150.0 * 2 / np.pi * np.arctan(201.7 * v)
        phase = np.clip((t - manoeuvre.start) / period, 0.0, 1.0)
        road = manoeuvre.height / 2 * (1 - np.cos(2 * np.pi * phase))
        load = np.maximum((m + mu) * g + 176e3 * (road - zw), 0.0)
        acceleration = total / m - g
        return np.array([vb, acceleration, vw, (load - total) / mu - g, rod, acceleration, load])

    return rates


def scalar_rates(manoeuvre: Bump) -> Callable[[float, np.ndarray], list[float]]:
    """The same in scalar Python, written for speed."""
    car = CHAPTER_3["nonlinear"]
    road = bump_road(manoeuvre.height, manoeuvre.length, manoeuvre.speed, manoeuvre.start)

    def rates(t: float, s: np.ndarray) -> list[float]:
        derivative, load = car.rates(s, road.height(t), road.rate(t))
        return [*derivative, derivative[1], load]

    return rates


def against_scipy() -> list[Result]:
    """Simulation with recording against the same equations in scipy: rtol 1e-7, body acceleration and load at every ms.

    The solver's step is held to the 1 ms of the records, so that both resolve the bump alike. The last line is the
    harshest comparison: scalar Python written for speed, the solver free to choose its steps.
    """
    plant, manoeuvre = quarter_car()
    time_grid = np.arange(3001) * 1e-3
    at_rest = CHAPTER_3["nonlinear"].at_rest()

    def theirs(rates: Callable[[float, np.ndarray], Sequence[float] | np.ndarray], method: str, step: float) -> float:
        found = solve_ivp(
            lambda t, s: rates(t, s)[:5],
            (0, 3.0),
            at_rest,
            method=method,
            t_eval=time_grid,
            rtol=1e-7,
            atol=1e-9,
            max_step=step,
        )
        recorded = np.array([rates(t, s)[5:] for t, s in zip(time_grid, found.y.T, strict=True)])
        return float(recorded[:, 0].max())

    run = simulate(plant, manoeuvre)
    if abs(theirs(numpy_rates(manoeuvre), "LSODA", 1e-3) - run["body_acceleration"].max()) > 0.01:
        raise SystemExit("the two sides of the comparison do not solve the same problem")
    results = []
    for rates, method, step, limit, repeats in (
        (numpy_rates, "LSODA", 1e-3, 3.0, REPEATS),
        (numpy_rates, "Radau", 1e-3, 40.0, 3),
        (scalar_rates, "LSODA", 0.02, None, REPEATS),
    ):
        times = ratio(partial(theirs, rates(manoeuvre), method, step), lambda: simulate(plant, manoeuvre), repeats)
        style = rates.__name__.removesuffix("_rates")
        results.append(
            Result(
                f"OM5 bump 3 s, recorded: scipy {method}, {style}, steps <= {1000 * step:g} ms / susp_mj",
                times,
                limit,
                "x",
                more=True,
            )
        )
    return results


def command(*arguments: str) -> tuple[float, float]:
    """Wall time [s] and peak memory [MB] of a susp-mj command in a process of its own."""
    program = Path(sys.executable).with_name("susp-mj")
    start = time.perf_counter()
    process = subprocess.Popen([program, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if os.waitstatus_to_exitcode(status) != 0:
        raise SystemExit(f"susp-mj {' '.join(arguments)} failed")
    scale = 2**20 if sys.platform == "darwin" else 2**10
    return time.perf_counter() - start, usage.ru_maxrss / scale


def commands() -> list[Result]:
    """Whole commands: a warm run of the chapter 3 case, the help, peak memory.

    They come first: a process starts with the peak memory of the one that starts it.
    """
    with tempfile.TemporaryDirectory() as folder:
        command("run", "chapter3", "--out", folder)
        runs = [command("run", "chapter3", "--out", folder) for _ in range(5)]
    helps = [command("--help")[0] for _ in range(6)][1:]
    return [
        Result("susp-mj run chapter3, warm, without video", statistics.median(wall for wall, _ in runs), 4.0, "s"),
        Result("susp-mj run chapter3, peak memory", max(memory for _, memory in runs), 400.0, "MB"),
        Result("susp-mj --help", statistics.median(helps), 0.4, "s"),
    ]


def main() -> None:
    """Print every figure beside its limit; exit code 1 if one is not met."""
    missed = 0
    for group in (commands, cars, handling, against_scipy, against_commonroad):
        for result in group():
            print(result, flush=True)
            missed += isinstance(result, Result) and not result.met
    print(f"this process' peak memory: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB")
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
