"""A vehicle file opened once: what it tells of itself, and the cars it gives."""

from __future__ import annotations

import pytest

from susp_mj import InputError
from vehicles import VehicleFile, available_vehicles, load_vehicle


@pytest.mark.parametrize("name", available_vehicles())
def test_a_file_opened_once_gives_the_cars_of_a_file_opened_each_time(name):
    file = VehicleFile.open(name)
    for chosen in file.sets or [None]:
        assert file.vehicle(chosen) == load_vehicle(name, chosen)
        assert list(file.vehicle(chosen).loads) == file.loads


def test_a_car_leaves_its_file_as_it_was():
    """Neither overrides nor a set of characteristics stay behind."""
    file = VehicleFile.open("chapter3")
    first = file.vehicle("nonlinear")
    changed = file.vehicle("nonlinear", {"rear.damper.rates.1": 700, "loads.ko.corner_mass.rear": 500})
    assert changed.rear.damper.rates[1] == 700
    assert file.vehicle("linear") == load_vehicle("chapter3", "linear")
    assert file.vehicle("nonlinear") == first


def test_a_file_names_itself(vehicle_file):
    file = VehicleFile.open(vehicle_file)
    assert file.name == "car"
    assert file.title == file.vehicle().title
    assert file.loads == ["ko", "heavy"]
    vehicle_file.write_text("")
    assert (VehicleFile.open(vehicle_file).title, VehicleFile.open(vehicle_file).loads) == ("car", [])


def test_a_default_that_is_no_set_is_the_mistake_of_the_file(vehicle_file):
    vehicle_file.write_text('default = "soft"\n' + vehicle_file.read_text() + '[characteristics.sofft]\ntitle = "x"\n')
    with pytest.raises(InputError) as caught:
        VehicleFile.open(vehicle_file)
    assert str(caught.value) == "car.toml: default: no set 'soft'; did you mean 'sofft'? choose sofft"


def test_one_of_several_sets_has_to_be_chosen(vehicle_file):
    vehicle_file.write_text(vehicle_file.read_text() + "[characteristics.soft]\n[characteristics.hard]\n")
    with pytest.raises(InputError) as caught:
        load_vehicle(vehicle_file)
    assert str(caught.value) == "characteristics: car.toml has several sets; choose soft, hard"


@pytest.mark.parametrize(
    ("ask", "key"),
    [
        (lambda car: load_vehicle("chapter3", "soft"), "characteristics"),
        (lambda car: car.load("empty"), "load"),
        (lambda car: car.axle("front"), "axle"),
    ],
)
def test_a_name_that_the_file_lacks_is_the_mistake_of_who_asks(ask, key):
    """No source of its own: a case file puts its key in front."""
    with pytest.raises(InputError, match="has no ") as caught:
        ask(load_vehicle("chapter3", "linear"))
    assert str(caught.value).startswith(f"{key}: chapter3.toml has no ")
    assert caught.value.source == ""
