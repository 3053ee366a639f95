"""A user's own element, registered from Python: the hydropneumatic spring of the examples."""

from __future__ import annotations

import ctypes
import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from manoeuvres import Bump
from susp_mj import InputError, Plant, simulate
from susp_mj.compiled import laws as compiled_laws
from susp_mj.elements import LAWS, SPRINGS, register
from vehicles import load_vehicle
from vehicles.mjcf import build, write

from .reference import QuarterCar, bump_road, solve, zoned_damper

EXAMPLE = Path(__file__).parents[2] / "examples" / "hydropneumatic.py"
F0, FREQUENCY, N, G = 4743.0, 1.2, 1.3, 9.81


@pytest.fixture(scope="module")
def example():
    """The example as a module, its element registered for these tests only."""
    spec = importlib.util.spec_from_file_location("hydropneumatic_example", EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    assert "hydropneumatic" not in SPRINGS, "importing registers nothing"
    register(module.HydropneumaticSpring)
    yield module
    del SPRINGS["hydropneumatic"], LAWS[module.HydropneumaticSpring.law.number], sys.modules[spec.name]


@pytest.fixture
def spring(example):
    return load_vehicle("chapter3", "linear", example.ON_GAS).axle("rear").spring


def gas(x):
    """``p V^n = constant`` with a volume and a piston worked out from the frequency at rest."""
    area = 2e-3
    rate = F0 / G * (2 * np.pi * FREQUENCY) ** 2
    volume = N * F0 * area / rate
    pressure = F0 / area * (volume / (volume - area * x)) ** N
    return pressure * area


def test_closed_form(spring):
    x = np.linspace(-0.1, 0.1, 41)
    np.testing.assert_allclose(spring.force_at(x), gas(x), rtol=1e-12)
    assert float(spring.force_at(0.0)) == F0
    assert float(spring.frequency_at(0.0)) == pytest.approx(FREQUENCY, rel=1e-6)
    assert np.diff(spring.rate_at(np.linspace(-0.099, 0.099, 50))).min() > 0, "stiffer with every millimetre"
    np.testing.assert_array_equal(spring.force_at([-0.3, 0.3]), spring.force_at([-0.1, 0.1]))


def test_compiled_is_plain_python(spring):
    law, parameters = spring.active_law, spring.parameters()
    compiled_laws.compile_laws([(law.number, law.role)])
    prototype = ctypes.CFUNCTYPE(ctypes.c_double, *[ctypes.c_double] * 3, ctypes.POINTER(ctypes.c_double))
    machine = prototype(int(compiled_laws.TABLES["force"][law.number]))
    memory = (ctypes.c_double * len(parameters))(*parameters)
    for x in np.linspace(-0.15, 0.15, 101):
        assert machine(x, 0.0, 0.0, memory) == pytest.approx(law.function(x, 0.0, 0.0, parameters), rel=1e-15)


def test_over_the_bump_against_the_stiff_solver(example):
    run = simulate(build(load_vehicle("chapter3", "linear", example.ON_GAS), "quarter_2dof"), Bump())
    expected = solve(QuarterCar(483.5, gas, zoned_damper([3000], [])), bump_road(0.08, 2.0, 50 / 3.6, 0.2), 3.0)
    assert np.abs(run["body_displacement"] - expected.body).max() < 0.05e-3


def test_written_model_runs_the_same(example, tmp_path):
    vehicle = load_vehicle("chapter3", "linear", example.ON_GAS)
    run = simulate(Plant.from_mjcf(write(vehicle, "quarter_2dof", tmp_path / "gas.xml")), Bump(duration=0.6))
    other = simulate(build(vehicle, "quarter_2dof"), Bump(duration=0.6))
    for name in run:
        np.testing.assert_array_equal(run[name], other[name])


@pytest.mark.parametrize(
    ("change", "key"),
    [({"frequency": "2 Hz"}, "stops.compression"), ({"exponent": 2.5}, "exponent"), ({"frequncy": 1}, "frequncy")],
)
def test_impossible_gas_springs(example, change, key):
    """At 2 Hz and n = 1.3 the gas is used up after 80.8 mm, before the stop at 100 mm."""
    fields = {**example.ON_GAS["rear.spring"], **change}
    with pytest.raises(InputError) as caught:
        load_vehicle("chapter3", "linear", {"rear.spring": fields})
    assert caught.value.key == f"rear.spring.{key}"
    if "frequency" in change:
        assert f"{N * G / (2 * np.pi * 2) ** 2:.4f} m" in str(caught.value)


def test_registering_twice_is_harmless(example):
    register(example.HydropneumaticSpring)
    assert SPRINGS["hydropneumatic"] is example.HydropneumaticSpring


def test_the_example_runs_as_a_program(example):
    result = subprocess.run([sys.executable, EXAMPLE], capture_output=True, text=True, timeout=120, check=False)
    assert result.returncode == 0, result.stderr
    printed = dict(re.findall(r"^(steel|gas) *: acceleration +([\d.]+)", result.stdout, re.MULTILINE))
    assert float(printed["steel"]) == pytest.approx(11.24, abs=0.05)
    run = simulate(build(load_vehicle("chapter3", "linear", example.ON_GAS), "quarter_2dof"), Bump())
    assert float(printed["gas"]) == pytest.approx(run["body_acceleration"].max(), abs=0.006)
