"""Vehicle files: those that ship are complete and sourced, and every mistake is one line with file, key, value and
choices."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest

import vehicles
from manoeuvres import Bump
from susp_mj import InputError, simulate
from susp_mj.elements import GRAVITY
from vehicles import available_vehicles, load_vehicle, with_overrides
from vehicles.complete import CompleteCar, handling_needs
from vehicles.mjcf import MODELS, build

FOLDER = Path(vehicles.__file__).parent
FILES = {path.stem: tomllib.loads(path.read_text()) for path in sorted(FOLDER.glob("*.toml"))}
SETS = [(name, chosen) for name, data in FILES.items() for chosen in (data.get("characteristics") or {"": None})]


def values(data, prefix=""):
    """Dotted paths of all values."""
    for key, value in data.items():
        path = f"{prefix}.{key}" if prefix else key
        if isinstance(value, dict):
            yield from values(value, path)
        else:
            yield path


# ---- the cars that ship


def test_the_shipped_cars_are_found():
    assert available_vehicles() == sorted(FILES)
    assert "chapter3" in FILES


@pytest.mark.parametrize(("name", "chosen"), SETS)
def test_every_set_loads(name, chosen):
    vehicle = load_vehicle(name, chosen or None)
    assert vehicle.name == name
    assert vehicle.characteristics == chosen
    assert vehicle.title
    for axle in ("front", "rear"):
        if getattr(vehicle, axle) is not None:
            spring = vehicle.axle(axle).spring
            assert float(spring.force_at(0.0)) == pytest.approx(vehicle.corner_mass(axle, "ko") * GRAVITY, rel=0.05)


@pytest.mark.parametrize("name", FILES)
def test_every_value_has_a_source(name):
    """Longest entry of `sources` that is a value's path or a table around it."""
    data = dict(FILES[name])
    sources = data.pop("sources", {})
    own = {key: value for key, value in data.items() if key not in ("title", "default")}
    for path in values(own):
        if path.split(".")[-1] == "title":
            continue
        covering = [entry for entry in sources if path == entry or path.startswith(entry + ".")]
        assert covering, f"{name}.toml: {path} has no source"
        text = sources[max(covering, key=len)]
        status, _, reference = text.partition(":")
        assert status in ("measured", "cited", "estimated"), text
        assert reference.strip(), f"{path}: {text}"


@pytest.mark.parametrize("name", FILES)
def test_no_source_is_left_over(name):
    """A source that covers nothing is a typing error."""
    data = dict(FILES[name])
    sources = data.pop("sources", {})
    paths = list(values(data))
    for entry in sources:
        assert any(path == entry or path.startswith(entry + ".") for path in paths), (
            f"{name}.toml: source of '{entry}', which is not there"
        )


def test_the_quarter_car_of_chapter_3():
    """Chapter 3 and appendix 1, number by number."""
    axle = load_vehicle("chapter3", "nonlinear").axle("rear")
    assert load_vehicle("chapter3").corner_mass("rear", "ko") == 483.5
    assert axle.unsprung_mass == 39.5
    assert axle.friction.force == 150
    assert axle.tyre.parameters() == pytest.approx((523 * 9.81, 176000))
    assert axle.damper.mount.rate == 400000
    assert axle.damper.friction == 25
    np.testing.assert_allclose(axle.damper.force_at([0.2, -0.2]), [400, -800], rtol=1e-12)
    np.testing.assert_allclose(axle.damper.force_at([1.2, -1.2]), [800, -1600], rtol=1e-12)
    assert float(axle.spring.force_at(0)) == 4743
    assert axle.spring.stops.parameters() == (-0.1, 0.1, 1e7)
    assert float(axle.spring.frequency_at(0.05)) == pytest.approx(1.2, rel=1e-6)


@pytest.mark.parametrize("name", [name for name, data in FILES.items() if "wheelbase" in data])
def test_loads_of_a_whole_car(name):
    """Corner masses add up to the sprung mass, and balance about the centre of gravity."""
    vehicle = load_vehicle(name)
    for load, case in vehicle.loads.items():
        front, rear = (2 * vehicle.corner_mass(axle, load) for axle in ("front", "rear"))
        assert front + rear == pytest.approx(case.sprung_mass, rel=1e-12)
        assert rear * vehicle.wheelbase == pytest.approx(-case.cg[0] * case.sprung_mass, rel=1e-12)


# ---- the handling car

COMPLETE = [name for name, data in FILES.items() if "steering" in data]


def test_several_cars_are_complete_for_handling():
    assert {"s_class", "bmw_320i"} <= set(COMPLETE)


@pytest.mark.parametrize(("name", "chosen"), [each for each in SETS if each[0] in COMPLETE])
def test_a_car_with_a_steering_is_complete(name, chosen):
    """In every set of characteristics; and its tables reach from stop to stop."""
    vehicle = load_vehicle(name, chosen or None)
    assert handling_needs(vehicle) == []
    for load in vehicle.loads:
        assert CompleteCar.of(vehicle, load).cg_height > 0.0
    for axle in (vehicle.front, vehicle.rear):
        assert axle.kinematics.travel[0] <= axle.spring.stops.rebound
        assert axle.kinematics.travel[-1] >= axle.spring.stops.compression


def test_what_a_car_lacks_is_listed(vehicle_file):
    with pytest.raises(InputError) as caught:
        CompleteCar.of(load_vehicle(vehicle_file), "ko")
    assert str(caught.value) == (
        "car.toml: model 'handling' needs what this car does not give: wheelbase, wheel_radius, loads.ko.sprung_mass, "
        "loads.heavy.sprung_mass, front, rear.track, rear.wheel_inertia, rear.kinematics, rear.compliance, "
        "rear.handling_tyre, "
        "steering, powertrain, brakes, aerodynamics"
    )
    car = load_vehicle("s_class", overrides={"brakes": None, "rear.wheel_inertia": None, "rear.compliance": {}})
    assert handling_needs(car) == ["rear.wheel_inertia", "brakes"]


def test_a_tyre_file_lies_beside_the_vehicle_or_ships(vehicle_file):
    """The one beside the vehicle comes first, wherever the program runs."""
    vehicle_file.write_text(
        vehicle_file.read_text() + '[rear.handling_tyre]\nkind = "magic_formula"\nfile = "pac2002_245_40R18.tir"\n'
    )
    assert load_vehicle(vehicle_file).rear.handling_tyre.radius == 0.344
    own = (
        (FOLDER / "tyres" / "pac2002_245_40R18.tir")
        .read_text()
        .replace("UNLOADED_RADIUS = 0.344", "UNLOADED_RADIUS = 0.3")
    )
    (vehicle_file.parent / "pac2002_245_40R18.tir").write_text(own)
    assert load_vehicle(vehicle_file).rear.handling_tyre.radius == 0.3
    (vehicle_file.parent / "pac2002_245_40R18.tir").write_text(own.replace("PDX1 = 1.1739", "PDX1 = -1"))
    with pytest.raises(InputError) as caught:
        load_vehicle(vehicle_file)
    assert caught.value.source == "pac2002_245_40R18.tir"
    assert caught.value.key == "LONGITUDINAL_COEFFICIENTS.PDX1"


def test_an_unknown_tyre_file_is_one_line():
    with pytest.raises(InputError) as caught:
        load_vehicle("s_class", overrides={"rear.handling_tyre.file": "pac2002_24540R18.tir"})
    shipped = ", ".join(sorted(path.name for path in (FOLDER / "tyres").glob("*.tir")))
    assert str(caught.value) == (
        "s_class.toml with overrides: rear.handling_tyre.file: no file 'pac2002_24540R18.tir' beside the vehicle file; "
        f"did you mean 'pac2002_245_40R18.tir'? choose {shipped}, or give the path of a .tir file"
    )


def test_the_bmw_is_that_of_commonroad():
    """Figures of commonroad-vehicle-models 3.0.2, parameters_vehicle2.yaml, converted here a second time."""
    car = load_vehicle("bmw_320i")
    a, b, m_s, m_u = 1.1561957064, 1.4227170936, 965.7108098804363, 63.7921826056784
    assert car.wheelbase == pytest.approx(a + b, rel=1e-4)
    assert car.loads["ko"].sprung_mass + 2 * (car.front.unsprung_mass + car.rear.unsprung_mass) == pytest.approx(
        1093.2952, rel=1e-5
    )
    assert car.cg_height("ko") == pytest.approx(0.61373, abs=1e-4)
    wheels = m_u * (a**2 + b**2) + m_u * ((1.38684 / 2) ** 2 + (1.36398 / 2) ** 2)
    np.testing.assert_allclose(car.loads["ko"].inertia, (207.26525, 1565.81788, 1791.59953 - wheels), rtol=1e-4)
    for name, track, share, spring, damper, torsion, camber in (
        ("front", 1.38684, b, 24453.138, 1786.244, 6914.8817, -0.3937008),
        ("rear", 1.36398, a, 19635.505, 1649.083, 2643.6010, -0.9055118),
    ):
        axle = car.axle(name)
        assert axle.track == track
        assert float(axle.spring.force_at(0)) == pytest.approx(m_s * 9.81 * share / (a + b) / 2, rel=1e-4)
        assert float(axle.spring.rate_at(0.03)) == pytest.approx(spring, rel=1e-4)
        np.testing.assert_allclose(axle.damper.force_at([0.3, -0.3]), [0.3 * damper, -0.3 * damper], rtol=1e-4)
        roll_moment_per_angle = axle.anti_roll_bar.rate * track**2 / 2
        assert roll_moment_per_angle == pytest.approx(torsion, rel=1e-4)
        gain = np.gradient(axle.kinematics.angles("camber")[:, 0], axle.kinematics.travel)
        np.testing.assert_allclose(gain, camber, rtol=1e-4)
        assert axle.tyre.rate == pytest.approx(158294.14, rel=1e-5)
        assert axle.handling_tyre.vertical_stiffness == pytest.approx(158294.14, rel=1e-5)
        assert axle.handling_tyre.radius == 0.344
    assert car.brakes.torque == pytest.approx(1093.2952 * 0.344 * 11.5, rel=1e-3)


# ---- overrides


def test_overrides_come_last():
    vehicle = load_vehicle(
        "chapter3",
        "linear",
        {"rear.damper.rates": [1200], "rear.tyre.rate": "200 N/mm", "loads.ko.corner_mass.rear": 500},
    )
    assert vehicle.rear.damper.rates == (1200,)
    assert vehicle.rear.tyre.rate == 200e3
    assert vehicle.corner_mass("rear", "ko") == 500
    assert load_vehicle("chapter3", "linear").rear.damper.rates == (3000,)


def test_a_list_item_is_addressed_by_number():
    assert load_vehicle("chapter3", "nonlinear", {"rear.damper.rates.1": 700}).rear.damper.rates == (3000, 700)


def test_an_override_may_take_something_away():
    axle = load_vehicle("chapter3", "linear", {"rear.friction": None, "rear.damper.mount": None}).axle("rear")
    assert axle.friction is None
    assert axle.damper.mount is None


@pytest.mark.parametrize(
    ("overrides", "key"),
    [
        ({"rear.damper.rates.7": 1}, "rear.damper.rates.7"),
        ({"title.deeper": 1}, "title.deeper"),
        ({"rear.damper.ratez": [1]}, "rear.damper.ratez"),
        ({"reer.damper.rates": [1]}, "reer"),
    ],
)
def test_an_override_that_leads_nowhere(overrides, key):
    with pytest.raises(InputError) as caught:
        load_vehicle("chapter3", "linear", overrides)
    assert caught.value.key == key
    assert caught.value.source == "chapter3.toml with overrides"


# ---- mistakes

# what to replace, by what, key of the error, words that its line must hold: value and allowed
MISTAKES = {
    "unknown key": (
        "friction = 30.0",
        "frictoin = 30.0",
        "rear.damper.frictoin",
        ["did you mean 'friction'?", "rates"],
    ),
    "unknown key of an axle": (
        "unsprung_mass = 40.0",
        "unsprung_mas = 40.0",
        "rear.unsprung_mas",
        ["did you mean 'unsprung_mass'?"],
    ),
    "unknown section": ("[loads.heavy]", "[lods.heavy]", "lods", ["did you mean 'loads'?"]),
    "unknown kind of spring": (
        'kind = "linear"',
        'kind = "gas"',
        "rear.spring.kind",
        ["'gas' unknown", "constant_frequency", "progressive"],
    ),
    "misspelt kind": ('kind = "linear"', 'kind = "liner"', "rear.spring.kind", ["did you mean 'linear'?"]),
    "no kind": ('kind = "zoned"\n', "", "rear.damper.kind", ["is required", "zoned", "table"]),
    "unknown kind of tyre": ('kind = "spring"', 'kind = "magic"', "rear.tyre.kind", ["'magic' unknown", "spring"]),
    "wrong unit": ('rate = "25 N/mm"', 'rate = "25 Hz"', "rear.spring.rate", ["'25 Hz'", "wrong unit", "N/m"]),
    "unknown unit": ('rate = "25 N/mm"', 'rate = "25 lbf/in"', "rear.spring.rate", ["lbf", "N/m"]),
    "no unit": ('rate = "25 N/mm"', 'rate = "25"', "rear.spring.rate", ["'25'", "no unit", "N/m"]),
    "not a number": ('rate = "25 N/mm"', "rate = [1, 2]", "rear.spring.rate", ["[1, 2]", "N/m"]),
    "wrong sign": ('rate = "25 N/mm"', "rate = -25000.0", "rear.spring.rate", ["-25000.0", "greater than 0"]),
    "zero mass": ("unsprung_mass = 40.0", "unsprung_mass = 0", "rear.unsprung_mass", ["0", "at least"]),
    "NaN": ("rate = 350000.0", "rate = nan", "rear.damper.mount.rate", ["nan", "not a finite number"]),
    "infinite": ("rate = 350000.0", "rate = inf", "rear.damper.mount.rate", ["inf", "not a finite number"]),
    "stop on the wrong side": (
        'rebound = "-90 mm"',
        'rebound = "90 mm"',
        "rear.spring.stops.rebound",
        ["0.09", "below 0"],
    ),
    "stop missing": ('rebound = "-90 mm", ', "", "rear.spring.stops.rebound", ["is required"]),
    "damper without slope": (
        "rates = [2400.0, 800.0]",
        "rates = [2400.0, 0.0]",
        "rear.damper.rates.1",
        ["0.0", "greater than 0"],
    ),
    "falling damper": (
        "rates = [2400.0, 800.0]",
        "rates = [2400.0, -800.0]",
        "rear.damper.rates.1",
        ["-800.0", "greater than 0"],
    ),
    "damper table that falls": (
        'kind = "zoned"\nrates = [2400.0, 800.0]\nlimits = [0.15]\nratio = "1:2"\n',
        'kind = "table"\nspeed = [-1.0, 0.5, 1.0]\nforce = [-900.0, 500.0, 400.0]\n',
        "rear.damper.force.2",
        ["400 follows 500", "increase strictly"],
    ),
    "limits missing": ("limits = [0.15]\n", "", "rear.damper.limits", ["0 limits", "2 rates"]),
    "ratio": ('ratio = "1:2"', 'ratio = "half"', "rear.damper.ratio", ["'1:2'"]),
    "no section": ("[loads.ko]", "[loads.design]", "loads", ["'ko'", "required"]),
    "no axle": (None, 'title = "x"\n[loads.ko]\ncorner_mass = { rear = 400.0 }\n', "front", ["axle is required"]),
    "no spring": (
        None,
        'title = "x"\n[loads.ko]\ncorner_mass = { rear = 400.0 }\n[rear]\n',
        "rear.spring",
        ["is required"],
    ),
    "no loads": (None, 'title = "x"\n', "loads", ["is required"]),
    "a value for a table": ("friction = { force = 120.0 }", "friction = 120.0", "rear.friction", ["120.0", "table"]),
    "source without status": (
        '"rear" = "estimated: a test"',
        '"rear" = "somebody said so"',
        "sources.rear",
        ["somebody", "estimated: …"],
    ),
    "half a load case": (
        'corner_mass = { rear = "460 kg" }',
        'sprung_mass = "1900 kg"',
        "loads.heavy",
        ["sprung_mass, cg and inertia together"],
    ),
    "a name inside the file": ('title = "Car', 'name = "x"\ntitle = "Car', "name", ["named by its file"]),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistakes(vehicle_file, mistake):
    old, new, key, words = MISTAKES[mistake]
    text = vehicle_file.read_text()
    if old is None:
        text = new
    else:
        assert text.count(old) == 1
        text = text.replace(old, new)
    vehicle_file.write_text(text)
    with pytest.raises(InputError) as caught:
        load_vehicle(vehicle_file)
    line = str(caught.value)
    assert "\n" not in line
    assert line.startswith("car.toml: ")
    assert caught.value.key == key
    assert f": {key}: " in line
    for word in words:
        assert word in line


def test_the_file_of_the_mistakes_is_right_otherwise(vehicle_file):
    assert load_vehicle(vehicle_file).loads["heavy"].corner_mass == {"rear": 460.0}


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda path: load_vehicle("chapter4"), ["vehicle", "no vehicle 'chapter4'", "did you mean 'chapter3'?"]),
        (lambda path: load_vehicle(path / "none.toml"), ["none.toml", "no such file"]),
        (
            lambda path: load_vehicle("chapter3", "liner"),
            ["chapter3.toml", "characteristics", "did you mean 'linear'?", "soft_linear"],
        ),
        (lambda path: load_vehicle("chapter3").axle("front"), ["chapter3.toml", "no axle 'front'", "rear"]),
        (lambda path: load_vehicle("chapter3").load("full"), ["chapter3.toml", "no load case 'full'", "ko"]),
        (lambda path: build(load_vehicle("chapter3"), "quarter_3dof"), ["model", "no model 'quarter_3dof'", *MODELS]),
        (
            lambda path: build(load_vehicle("chapter3", "linear", {"rear.tyre": None}), "quarter_2dof"),
            ["chapter3.toml", "rear.tyre", "required"],
        ),
        (
            lambda path: build(load_vehicle("chapter3", "linear", {"rear.unsprung_mass": None}), "quarter_2dof"),
            ["chapter3.toml", "rear.unsprung_mass", "required"],
        ),
    ],
)
def test_wrong_names(tmp_path, call, words):
    with pytest.raises(InputError) as caught:
        call(tmp_path)
    line = str(caught.value)
    assert "\n" not in line
    for word in words:
        assert word in line


def test_a_file_that_is_not_toml(tmp_path):
    path = tmp_path / "car.toml"
    path.write_text("title = \n")
    with pytest.raises(InputError, match=r"car\.toml: is not TOML: .*line 1"):
        load_vehicle(path)
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match=r"car\.toml"):
        load_vehicle(path)


def test_a_folder_is_not_a_vehicle(tmp_path):
    (tmp_path / "car.toml").mkdir()
    with pytest.raises(InputError, match="car"):
        load_vehicle(tmp_path / "car.toml")


def test_preload_and_static_load_follow_from_the_design_load(vehicle_file):
    axle = load_vehicle(vehicle_file).axle("rear")
    assert float(axle.spring.force_at(0.0)) == pytest.approx(400 * 9.81, rel=1e-14)
    assert float(axle.tyre.evaluate(0.0)) == pytest.approx(440 * 9.81, rel=1e-14)


def test_a_progressive_spring_that_does_not_fit_the_design_load(vehicle_file):
    """Found only when the preload is known: still file, key and limit."""
    text = vehicle_file.read_text().replace(
        'kind = "linear"\nrate = "25 N/mm"',
        'kind = "progressive"\nfrequency = "1.2 Hz"\nrebound_force = 5000\ncompression_force = 9000\n'
        "progressive_from = 0.02",
    )
    vehicle_file.write_text(text)
    with pytest.raises(InputError) as caught:
        load_vehicle(vehicle_file).axle("rear")
    assert (caught.value.source, caught.value.key) == ("car.toml", "rear.spring.rebound_force")
    assert "3924 N" in str(caught.value)


# ---- cars changed in Python, and springs told by their rebound rate


@pytest.mark.parametrize("name", ["s_class", "bmw_320i"])
def test_a_car_changed_in_python_is_the_one_with_overrides(name):
    changes = {"rear.spring.preload": 4500.0, "front.friction": None, "rear.damper.friction": "40 N"}
    changed, loaded = with_overrides(load_vehicle(name), changes), load_vehicle(name, None, changes)
    assert changed == loaded
    assert with_overrides(changed, {"rear.damper.friction": 1.0}).source == loaded.source
    with pytest.raises(InputError, match="wrong unit") as caught:
        with_overrides(load_vehicle(name), {"rear.damper.friction": "40 m"})
    assert caught.value.key == "rear.damper.friction"


def test_linkage_friction_of_zero_is_none():
    runs = [
        simulate(build(load_vehicle("chapter3", "linear", {"rear.friction": each}), "quarter_2dof"), Bump(duration=0.8))
        for each in (None, {"force": 0})
    ]
    np.testing.assert_array_equal(runs[0]["body_acceleration"], runs[1]["body_acceleration"])


def test_a_progressive_spring_told_by_its_rebound_rate():
    car = load_vehicle("s_class", "configuration_3")
    spring = car.axle("rear").spring
    force = float(spring.force_at(-0.1))
    rate = (float(spring.force_at(0.0)) - force) / 0.1
    told = {"rear.spring.rebound_force": None, "rear.spring.rebound_rate": rate}
    other = load_vehicle("s_class", "configuration_3", told).axle("rear").spring
    x = np.linspace(-0.12, 0.12, 49)
    np.testing.assert_allclose(other.force_at(x), spring.force_at(x), rtol=1e-12)
    with pytest.raises(InputError, match="exactly one"):
        load_vehicle("s_class", "configuration_3", {"rear.spring.rebound_rate": rate})
    with pytest.raises(InputError, match="would pull at the rebound stop"):
        load_vehicle("s_class", "configuration_3", {**told, "rear.spring.rebound_rate": 60e3}).axle("rear")


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("wheel_radius", 0.45, "the front wheel's centre is 0.317 m above the ground"),
        ("rear.roll_centre_height", 0.3, "the kinematics put the roll centre at"),
    ],
)
def test_one_car_has_one_radius_and_one_roll_centre(key, value, words):
    """Oscillation models read them as told, model handling from tyre and kinematics."""
    car = load_vehicle("s_class", None, {key: value})
    build(car, "full_7dof")
    with pytest.raises(InputError, match=words) as caught:
        build(car, "handling")
    assert caught.value.key == key
