"""Numbers that follow on paper from the linear quarter car, and from the thesis' formulas: see closed_forms.json."""

from __future__ import annotations

import json
from pathlib import Path

import mujoco
import numpy as np
import pytest
from scipy.linalg import solve_continuous_lyapunov

from manoeuvres import Bump, RoadStep
from susp_mj import simulate
from susp_mj.compiled import attach_input, install
from susp_mj.elements import ConstantFrequencySpring, LinkageFriction, Stops
from susp_mj.equilibrium import static_equilibrium
from vehicles.mjcf import build

from ..builders.cars import LinearQuarterCar
from ..builders.manoeuvres import SteadySine

FORMS = {entry["id"]: entry for entry in json.loads(Path(__file__).with_name("closed_forms.json").read_text())}
MS, MU, K, KT = (FORMS["qc_eig"]["inputs"][name] for name in ("ms", "mu", "k", "kt"))
STOPS = {"rebound": -0.2, "compression": 0.2}


def linear_car(damping=1200.0, **overrides):
    """The plant of the closed forms' linear quarter car."""
    return build(LinearQuarterCar(MS, MU, K, damping, KT).vehicle(overrides), "quarter_2dof")


class Accelerations:
    """d(qacc) over departures of (heave, travel, their speeds, road height) from rest, by central differences."""

    def __init__(self, plant):
        install(plant.laws)
        self.model, self.data = plant.model, static_equilibrium(plant)
        attach_input(self.data, None)
        self.tyre = self.model.actuator("tyre").id
        self.rest = self.data.qpos.copy()

    def at(self, departure):
        self.data.qpos[:] = self.rest + departure[:2]
        self.data.qvel[:] = departure[2:4]
        self.data.ctrl[self.tyre] = departure[4]
        mujoco.mj_forward(self.model, self.data)
        return self.data.qacc.copy()

    def derivative(self):
        return np.column_stack([(self.at(d) - self.at(-d)) / 2e-2 for d in 1e-2 * np.eye(5)])


def test_natural_frequencies_of_the_plant():
    derivative = Accelerations(linear_car()).derivative()
    squares = np.sort(np.linalg.eigvals(-derivative[:, :2]).real)
    np.testing.assert_allclose(np.sqrt(squares) / (2 * np.pi), FORMS["qc_eig"]["expected"]["f_hz"], rtol=1e-9)


def test_natural_frequencies_in_time():
    """Ringing after a step, without damping: the two peaks of the spectrum."""
    run = simulate(linear_car(damping=1e-6), RoadStep(height=0.005, duration=80.0, start=0.0))
    values = (
        run["body_displacement"]
        - run["body_displacement"].mean()
        + 30 * (run["wheel_displacement"] - run["wheel_displacement"].mean())
    )
    spectrum = np.abs(np.fft.rfft(values * np.hanning(len(values)), 8 * len(values)))
    frequency = np.fft.rfftfreq(8 * len(values), run.step)
    for low, high, expected in zip((0.5, 8.0), (3.0, 15.0), FORMS["qc_eig"]["expected"]["f_hz"], strict=True):
        band = (frequency > low) & (frequency < high)
        found = frequency[band][np.argmax(spectrum[band])]
        assert found == pytest.approx(expected, rel=0.005)


def test_variances_on_a_white_noise_road():
    """Covariance of the plant's own linearisation under a road whose rate is white noise of unit intensity."""
    form = FORMS["qc_white_noise_c1200"]["expected"]
    d = Accelerations(linear_car(damping=form["c"])).derivative()
    heave, travel, heave_speed, travel_speed, road = d.T
    # A shift of car and road together changes nothing, so travel, body speed, tyre deflection and travel speed suffice;
    # travel at constant tyre deflection takes the road along.
    np.testing.assert_allclose(heave + road, 0, atol=1e-6)
    rows = np.array([travel + road, heave_speed, road, travel_speed]).T
    matrix = np.array([[0, 0, 0, 1], rows[0], [0, -1, 0, -1], rows[1]])
    noise = np.array([[0.0], [0.0], [1.0], [0.0]])
    covariance = solve_continuous_lyapunov(matrix, -noise @ noise.T)
    acceleration = rows[0] @ covariance @ rows[0]
    assert acceleration == pytest.approx(form["acc_formula"], rel=1e-8)
    assert covariance[0, 0] == pytest.approx(form["susp_formula"], rel=1e-8)
    assert covariance[2, 2] == pytest.approx(form["tyre_formula"], rel=1e-8)
    assert KT**2 * covariance[2, 2] == pytest.approx(form["dynload_var_per_W"], rel=1e-8)


def first_harmonic(time: np.ndarray, values: np.ndarray, frequency: float, periods: int) -> complex:
    """Complex amplitude over the last whole `periods`, by least squares with the higher harmonics beside it."""
    last = time >= time[-1] - periods / frequency
    t = time[last]
    columns = [np.ones_like(t)]
    for harmonic in range(1, 6):
        columns += [np.cos(2 * np.pi * harmonic * frequency * t), np.sin(2 * np.pi * harmonic * frequency * t)]
    found = np.linalg.lstsq(np.column_stack(columns), values[last], rcond=None)[0]
    return complex(found[1], -found[2])


SUSPENSIONS = {
    "soft, weak": {
        "rear.spring": {"kind": "linear", "rate": 15e3, "stops": STOPS},
        "rear.damper": {"kind": "zoned", "rates": [900]},
    },
    "stiff, strong": {
        "rear.spring": {"kind": "linear", "rate": 60e3, "stops": STOPS},
        "rear.damper": {"kind": "zoned", "rates": [4000]},
    },
    "digressive with mount and friction": {
        "rear.damper": {
            "kind": "zoned",
            "rates": [3000, 600],
            "limits": [0.05],
            "ratio": "1:2",
            "friction": 25,
            "mount": {"rate": 4e5},
        },
        "rear.friction": {"force": 100},
    },
}


@pytest.mark.parametrize("name", SUSPENSIONS)
def test_invariant_of_the_body_acceleration(name):
    """At sqrt(kt/mu) the wheel's mass and the tyre cancel: the body's acceleration is mu/ms of the road's, whatever
    lies between."""
    form = FORMS["qc_invariant_accel"]
    frequency = form["inputs"]["f"]
    assert frequency == pytest.approx(np.sqrt(KT / MU) / (2 * np.pi), rel=1e-12)
    sine = SteadySine(frequency=frequency, duration=8.0, amplitude=0.004)
    run = simulate(linear_car(**SUSPENSIONS[name]), sine)
    assert run["wheel_load"].min() > 0.0
    body, road = (first_harmonic(run.time, run[c], frequency, 20) for c in ("body_acceleration", "road_height"))
    ratio = body / (-((2 * np.pi * frequency) ** 2) * road)
    assert abs(ratio) == pytest.approx(form["expected"]["abs_zs_over_zr"], rel=0.01)
    assert ratio.real < 0, "in opposite phase"


@pytest.mark.parametrize("name", SUSPENSIONS)
def test_invariant_of_the_suspension_travel(name):
    """At sqrt(kt/(ms+mu)) the travel is (ms+mu)/ms of the road's amplitude, whatever the suspension."""
    frequency = np.sqrt(KT / (MS + MU)) / (2 * np.pi)
    sine = SteadySine(frequency=frequency, duration=20.0, amplitude=0.01)
    run = simulate(linear_car(**SUSPENSIONS[name]), sine)
    assert run["wheel_load"].min() > 0.0
    travel, road = (first_harmonic(run.time, run[c], frequency, 10) for c in ("suspension_deflection", "road_height"))
    assert abs(travel / road) == pytest.approx((MS + MU) / MS, rel=0.01)


def test_bump_on_the_linear_car():
    """Extremes over the cosine bump, from the matrix exponential."""
    form = FORMS["qc_bump_linear_c1200"]
    inputs, expected = form["inputs"], form["expected"]
    bump = Bump(height=inputs["h"], length=inputs["L"], speed=inputs["v"], duration=inputs["T"], start=0.0)
    run = simulate(linear_car(damping=expected["c"]), bump, step=2e-4)

    def extreme(values, pick):
        """Top of the parabola through the extreme sample and its neighbours: (instant, value)."""
        at = int(pick(values))
        bend, slope, top = np.polyfit([-1, 0, 1], values[at - 1 : at + 2], 2)
        return run.time[at] - slope / (2 * bend) * run.step, top - slope**2 / (4 * bend)

    acceleration, load, travel = (run[c] for c in ("body_acceleration", "wheel_load", "suspension_deflection"))
    for name, values, pick in (
        ("acc_max", acceleration, np.argmax),
        ("acc_min", acceleration, np.argmin),
        ("Fz_max", load, np.argmax),
        ("Fz_min", load, np.argmin),
    ):
        instant, value = extreme(values, pick)
        assert value == pytest.approx(expected[name], rel=0.002), name
        assert instant == pytest.approx(expected[f"t_{name}"], rel=0.002), name
    assert extreme(travel, np.argmax)[1] == pytest.approx(expected["travel_max"], rel=0.002)
    assert extreme(travel, np.argmin)[1] == pytest.approx(expected["travel_min"], rel=0.002)
    assert extreme(run["body_displacement"], np.argmax)[1] == pytest.approx(expected["zs_max"], rel=0.002)


@pytest.mark.parametrize("point", FORMS["const_freq_spring"]["expected"], ids=lambda p: f"{p['x']} m")
def test_constant_frequency_spring(point):
    inputs = FORMS["const_freq_spring"]["inputs"]
    spring = ConstantFrequencySpring(
        preload=inputs["F0"], frequency=inputs["fn"], stops=Stops(rebound=-0.1001, compression=0.1001)
    )
    assert float(spring.force_at(point["x"])) == pytest.approx(point["F"], rel=1e-12)
    assert float(spring.rate_at(point["x"])) == pytest.approx(point["k"], rel=1e-6)
    assert float(spring.frequency_at(point["x"])) == pytest.approx(inputs["fn"], rel=1e-6)


def test_linkage_friction():
    form = FORMS["linkage_friction"]
    force = LinkageFriction(force=150.0).evaluate(speed=form["inputs"]["v"])
    assert float(force) / 150.0 == pytest.approx(form["expected"]["ratio"], rel=1e-12)
