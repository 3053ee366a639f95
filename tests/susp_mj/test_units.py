"""Quantities with units: dimensions are checked, numbers are SI, nonsense is refused in words."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from susp_mj.units import readable, to_si, unit_factor

# text, SI unit, value in SI worked out by hand
READ = [
    ("27 N/mm", "N/m", 27000.0),
    ("27000 N/m", "N/m", 27000.0),
    ("0.4 kN/mm", "N/m", 400000.0),
    ("1.2 Hz", "Hz", 1.2),
    ("72 1/min", "Hz", 1.2),
    ("50 km/h", "m/s", 50 / 3.6),
    ("1 m/s", "m/s", 1.0),
    ("3000 N s/m", "N s/m", 3000.0),
    ("3000 Ns/m", "N s/m", 3000.0),
    ("3 kNs/m", "N s/m", 3000.0),
    ("3000 N·s/m", "N s/m", 3000.0),
    ("3000 kg/s", "N s/m", 3000.0),
    ("-100 mm", "m", -0.1),
    ("1e7 N/m", "N/m", 1e7),
    (".5 m", "m", 0.5),
    ("5. cm", "m", 0.05),
    ("1.9 t", "kg", 1900.0),
    ("769 kg m²", "kg m²", 769.0),
    ("769 kg m^2", "kg m²", 769.0),
    ("5 deg", "rad", math.radians(5)),
    ("5 °", "rad", math.radians(5)),
    ("25 deg/s", "rad/s", math.radians(25)),
    ("2.2 bar", "Pa", 220000.0),
    ("30 kW", "W", 30000.0),
    ("250 Nm", "N m", 250.0),
    ("20 ms", "s", 0.02),
    ("4 %", "", 0.04),
    ("7 m/s²", "m/s²", 7.0),
    ("7 m/s^2", "m/s²", 7.0),
    ("0.4 l", "m³", 0.0004),
    ("2", "", 2.0),
    ("3000 1/min", "rad/s", 100 * math.pi),
    ("3000 min^-1", "rad/s", 100 * math.pi),
    ("3000 min⁻¹", "rad/s", 100 * math.pi),
    ("3000 rpm", "rad/s", 100 * math.pi),
    ("18000 deg/s", "rad/s", 100 * math.pi),
    ("0.04 deg/kN", "rad/N", math.radians(0.04) / 1000),
    ("1 deg/(kN m)", "rad/(N m)", math.radians(1) / 1000),
    ("1 deg/kNm", "rad/(N m)", math.radians(1) / 1000),
    ("25 kNm/rad", "N m/rad", 25000.0),
    ("450 Nm/deg", "N m/rad", 450 * 180 / math.pi),
    ("150 N m s/rad", "N m s/rad", 150.0),
    ("0.035 1/deg", "1/rad", 0.035 * 180 / math.pi),
    ("1.225 kg/m³", "kg/m³", 1.225),
]


@pytest.mark.parametrize(("text", "unit", "value"), READ, ids=[text for text, *_ in READ])
def test_texts_are_read(text, unit, value):
    assert to_si(text, unit) == pytest.approx(value, rel=1e-14)


@given(st.floats(-1e15, 1e15))
def test_bare_numbers_are_si(value):
    assert to_si(value, "N/m") == value


@pytest.mark.parametrize("value", [1.1e15, -1e300, 10**400, "2e12 kN"])
def test_what_no_car_has_is_refused(value):
    with pytest.raises(ValueError, match=r"beyond anything a car has|not a finite number"):
        to_si(value, "N")


@given(
    st.floats(-1e12, 1e12),
    st.sampled_from([("mm", "m", 1e-3), ("kN", "N", 1e3), ("km/h", "m/s", 1 / 3.6), ("N/mm", "N/m", 1e3)]),
)
def test_any_number_with_a_unit(value, unit):
    text, si, factor = unit
    assert to_si(f"{value!r} {text}", si) == pytest.approx(value * factor, rel=1e-14)


@pytest.mark.parametrize(
    ("value", "unit", "reason"),
    [
        ("27", "N/m", "no unit"),
        ("27 N", "N/m", "wrong unit"),
        ("27 N/mm", "Hz", "wrong unit"),
        ("5 deg", "", "wrong unit"),
        ("50 1/s", "rad/s", "wrong unit"),
        ("50 Hz", "rad/s", "wrong unit"),
        ("3000 rpm", "Hz", "wrong unit"),
        ("27 parsec", "m", "unknown unit 'parsec'"),
        ("27 N/furlong", "N/m", "unknown unit 'furlong'"),
        ("many N", "N", "not a number"),
        ("", "m", "not a number"),
        ("1,5 m", "m", "unknown unit|not a number|wrong unit"),
        ("nan m", "m", "not a number"),
        ("1e999 m", "m", "not a finite number"),
        (float("nan"), "m", "not a finite number"),
        (float("inf"), "m", "not a finite number"),
        (True, "m", "not a quantity"),
        (None, "m", "not a quantity"),
        ([1.0], "m", "not a quantity"),
    ],
)
def test_nonsense_is_refused(value, unit, reason):
    with pytest.raises(ValueError, match=reason) as caught:
        to_si(value, unit)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("N", "kg m/s^2"),
        ("W", "N m/s"),
        ("Pa", "N/m²"),
        ("Nm", "kg m²/s²"),
        ("Ns", "kgm/s"),
        ("l", "m³"),
        ("Hz", "1/s"),
    ],
)
def test_units_of_the_same_dimension(one, other):
    assert unit_factor(one)[1] == unit_factor(other)[1]


@pytest.mark.parametrize(("one", "other"), [("rad", ""), ("Hz", "rad/s"), ("N", "Nm"), ("Ns/m", "N/m"), ("kg", "N")])
def test_units_of_different_dimensions(one, other):
    assert unit_factor(one)[1] != unit_factor(other)[1]


@given(st.floats(-1e6, 1e6), st.sampled_from(["m", "rad", "m/s", "rad/s", "s", "N", "N s/m", "m/s²", ""]))
def test_what_is_readable_is_read_back(value, unit):
    assert to_si(readable(value, unit), unit) == pytest.approx(value, rel=1e-9, abs=1e-300)


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [(0.08, "m", "80 mm"), (2.0, "m", "2 m"), (20.0, "m/s", "20 m/s"), (80 / 3.6, "m/s", "80 km/h"), (0.3, "", "0.3")],
)
def test_readable_is_short(value, unit, text):
    assert readable(value, unit) == text
