"""A run starts in equilibrium of its load case, found by statics and kept to the last digit."""

from __future__ import annotations

import numpy as np
import pytest

from manoeuvres import RoadStep
from susp_mj import simulate
from susp_mj.equilibrium import static_equilibrium
from susp_mj.errors import InputError, SimulationError
from vehicles import load_vehicle
from vehicles.mjcf import build

from ..builders.cars import LINEAR_CAR
from .reference_car import Car, Excitation
from .thesis_cars import PLACES, S_CLASS

G = 9.81
MODELS = [("quarter_1dof", "front"), ("quarter_1dof", "rear"), ("quarter_2dof", "front"), ("quarter_2dof", "rear")]
MODELS += [("axle_2dof", "front"), ("axle_2dof", "rear"), ("axle_4dof", "front"), ("axle_4dof", "rear")]
MODELS += [("pitch_2dof", None), ("full_3dof", None), ("full_7dof", None)]
# mass, distance of the centre of gravity behind the front axle
LOADS = {"ko": (1913.0, 1.5572), "empty": (1663.0, 1.5244), "full": (2063.0, 1.6680)}
WHEELBASE, TRACK, UNSPRUNG = 3.081, 1.4, 39.5
NOTHING = RoadStep(height=0.0, duration=1.0)


def carried(model, load, axle):
    """Sprung mass of a model and its wheels, by hand."""
    mass, behind = LOADS[load]
    share = {None: 1.0, "front": 1 - behind / WHEELBASE, "rear": behind / WHEELBASE}[axle]
    sides = 0.5 if model.startswith(("quarter", "pitch")) else 1.0
    wheels = (1 if sides == 0.5 else 2) * (2 if axle is None else 1)
    return mass * share * sides, wheels


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize(("model", "axle"), MODELS)
@pytest.mark.parametrize("name", ["configuration_1", "configuration_4"])
def test_at_rest(name, model, axle, load):
    """No acceleration before anything happens, every wheel load by the lever rule, and nothing moves for a second."""
    plant = build(load_vehicle("s_class", name), model, load=load, axle=axle)
    assert np.abs(static_equilibrium(plant).qacc).max() < 1e-8
    run = simulate(plant, NOTHING)
    for channel in run.channels:
        if channel.endswith("acceleration"):
            assert np.abs(run[channel]).max() < 1e-8, channel
        else:
            scale = 1e-4 if channel.endswith(("_force", "_load", "_moment")) else 1e-8
            assert np.ptp(run[channel]) < scale, channel
    mass, wheels = carried(model, load, axle)
    unsprung = UNSPRUNG if model in ("quarter_2dof", "axle_4dof", "full_7dof") else 0.0
    loads = {name: float(run[name][0]) for name in run.channels if name.endswith("wheel_load")}
    assert len(loads) == wheels
    assert sum(loads.values()) == pytest.approx((mass + wheels * unsprung) * G, abs=1e-4)
    if axle is None:  # moments about the front axle
        rear = sum(value for name, value in loads.items() if name.startswith("r"))
        behind = LOADS[load][1]
        assert rear == pytest.approx((mass * behind / WHEELBASE + wheels / 2 * unsprung) * G, abs=1e-4)
    if "fl_wheel_load" in loads:
        assert loads["fl_wheel_load"] == pytest.approx(loads["fr_wheel_load"], abs=1e-4)


@pytest.mark.parametrize("load", LOADS)
def test_only_the_design_load_stands_in_the_design_position(load):
    """KO springs carry the KO load at zero deflection; full sinks at the rear and empty rises."""
    run = simulate(build(load_vehicle("s_class"), "full_3dof", load=load), NOTHING)
    front, rear = run["fl_suspension_deflection"][0], run["rl_suspension_deflection"][0]
    if load == "ko":
        assert abs(front) < 1e-8
        assert abs(rear) < 1e-8
    elif load == "full":
        assert rear > 0.005
        assert run["pitch_angle"][0] < -0.001
    else:
        assert front < -0.005
        assert rear < -0.005


LEANING = {"loads.ko.cg": [-1.5572, 0.0, 0.3259], "loads.full.cg": [-1.6680, 0.1, 0.3022]}


@pytest.mark.parametrize(("model", "axle"), [each for each in MODELS if each[0].startswith(("axle", "full"))])
def test_a_load_beside_the_middle(model, axle):
    """Centre of gravity 0.1 m to the left: the car leans left; loads about the middle balance, gravity topples by ``m g
    h phi``."""
    car = load_vehicle("s_class", "configuration_3", {**PLACES, **LEANING})
    plant = build(car, model, load="full", axle=axle)
    assert np.abs(static_equilibrium(plant).qacc).max() < 1e-8
    run = simulate(plant, NOTHING)
    roll = run["roll_angle"][0]
    assert np.ptp(run["roll_angle"]) < 1e-8
    assert -0.08 < roll < -0.005
    mass, _ = carried(model, "full", axle)
    behind = LOADS["full"][1]
    axles = {"front": 1 - behind / WHEELBASE, "rear": behind / WHEELBASE}
    height = 0.32 + 0.3022
    topple = sum(
        2063.0 * axles[each] * (height - centre)
        for each, centre in (("front", 0.08), ("rear", 0.12))
        if axle in (None, each)
    )
    moment = sum(
        (run[n][0] if n[1] == "l" else -run[n][0]) * TRACK / 2 for n in run.channels if n.endswith("wheel_load")
    )
    assert moment == pytest.approx(mass * G * 0.1 - topple * G * roll, rel=1e-3)

    data = S_CLASS["configuration_3"]
    loads = {**data.loads, "full": (2063.0, (-1.6680, 0.1, 0.3022), (769.0, 4276.0))}
    reference = Car.of(type(data)(**{**vars(data), "loads": loads}), model, "full", axle or "")
    state = reference.at_rest()
    assert roll == pytest.approx(state[2], rel=1e-3)
    _, expected, _ = reference.rates(state, Excitation({}), 0.0)
    for wheel, value in zip(reference.wheels, expected, strict=True):
        assert run[f"{wheel.station}_wheel_load"][0] == pytest.approx(value, rel=1e-3)


def test_leaning_by_hand():
    """On linear springs at the wheels and no tyres: ``(K - m g h) phi = -m g y`` about the body's middle."""
    run = simulate(build(LINEAR_CAR.vehicle(), "full_3dof", load="one_sided"), NOTHING)
    mass, (x, y, z), _ = LINEAR_CAR.loads["one_sided"]
    axles = ((LINEAR_CAR.front, (2.9 + x) / 2.9), (LINEAR_CAR.rear, -x / 2.9))
    stiffness = sum((axle.rate + axle.bar) * axle.track**2 / 2 for axle, _ in axles)
    topple = sum(mass * G * share * (0.31 + z - axle.roll_centre) for axle, share in axles)
    assert run["roll_angle"][0] == pytest.approx(-mass * G * y / (stiffness - topple), rel=1e-6)


@pytest.mark.parametrize(("model", "axle"), MODELS)
def test_a_load_that_cannot_be_carried(model, axle):
    """One line that names the load, where it would come to rest, and what to change."""
    heavy = {"loads.full.sprung_mass": 4200.0}
    with pytest.raises(InputError) as caught:
        simulate(build(load_vehicle("s_class", "configuration_1", heavy), model, load="full", axle=axle), NOTHING)
    text = str(caught.value)
    assert "\n" not in text
    assert "full" in text
    assert "spring" in text


def test_a_load_that_would_turn_the_car_over():
    """Springs too soft for the height of the centre of gravity: an error in one line, not a start from an unstable
    balance."""
    soft = {"kind": "linear", "rate": 4000.0, "stops": {"rebound": -0.1, "compression": 0.1}}
    changes = {"front.spring": soft, "rear.spring": soft, "front.anti_roll_bar": None, "rear.anti_roll_bar": None}
    assert 2 * 4000 * 2 * (TRACK / 2) ** 2 < 1913 * G * (0.32 + 0.3259 - 0.12)
    car = load_vehicle("s_class", "configuration_4", {**PLACES, **changes, "loads.ko.cg": [-1.5572, 0.05, 0.3259]})
    with pytest.raises((InputError, SimulationError)) as caught:
        simulate(build(car, "full_3dof"), NOTHING)
    assert "\n" not in str(caught.value)
    assert "ko" in str(caught.value)
