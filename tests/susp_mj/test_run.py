"""Run: names, units, and a file that comes back the same."""

from __future__ import annotations

import json

import netCDF4
import numpy as np
import pytest

from susp_mj import Channel, InputError, Run
from susp_mj.run import described


@pytest.fixture
def run():
    time = np.arange(50) * 0.01
    channels = {
        "body_acceleration": described("body_acceleration", np.sin(time) / 3),
        "fl_wheel_load": described("wheel_load", 4000 + 1e-9 * time, "fl"),
        "fr_wheel_load": described("wheel_load", 4000 - time, "fr"),
    }
    return Run(time, channels, {"title": "a run", "travel": {"fl": [-0.1, 0.08]}, "step": 0.001})


def test_access(run):
    np.testing.assert_array_equal(run["fr_wheel_load"], 4000 - run.time)
    assert "fl_wheel_load" in run
    assert "wheel_load" not in run
    assert list(run) == ["body_acceleration", "fl_wheel_load", "fr_wheel_load"]
    assert run.step == pytest.approx(0.01, rel=1e-12)
    assert list(run.stations("wheel_load")) == ["fl", "fr"]
    assert run.stations("body_velocity") == {}


def test_an_unknown_channel_lists_the_choices(run):
    with pytest.raises(InputError) as caught:
        run["fl_weel_load"]
    text = str(caught.value)
    assert "did you mean 'fl_wheel_load'?" in text
    assert all(name in text for name in run)


def test_save_and_load(run, tmp_path):
    path = run.save(tmp_path / "deep" / "run.nc")
    assert [each.name for each in path.parent.iterdir()] == ["run.nc"]
    again = Run.load(path)
    np.testing.assert_array_equal(again.time, run.time)
    assert list(again) == list(run)
    for name, channel in run.channels.items():
        np.testing.assert_array_equal(again[name], channel.values)
        for attribute in ("quantity", "station", "unit", "frame", "description"):
            assert getattr(again.channels[name], attribute) == getattr(channel, attribute)
    assert again.meta == run.meta


def test_the_file_explains_itself(run, tmp_path):
    with netCDF4.Dataset(run.save(tmp_path / "run.nc")) as file:
        assert file["time"].units == "s"
        assert file["fl_wheel_load"].units == "N"
        assert file["body_acceleration"].units == "m/s²"
        assert json.loads(file.meta)["title"] == "a run"
        assert file["fl_wheel_load"].dtype == np.float64


def test_saving_over_an_older_file(run, tmp_path):
    path = tmp_path / "run.nc"
    path.write_text("old")
    assert "body_acceleration" in Run.load(run.save(path))


def test_an_unwritable_place_leaves_nothing(run, tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(InputError, match="cannot be written"):
        run.save(tmp_path / "file" / "run.nc")
    assert [each.name for each in tmp_path.iterdir()] == ["file"]
    (tmp_path / "folder.nc").mkdir()
    with pytest.raises(InputError, match="cannot be written"):
        run.save(tmp_path / "folder.nc")
    assert sorted(each.name for each in tmp_path.iterdir()) == ["file", "folder.nc"]
    assert list((tmp_path / "folder.nc").iterdir()) == []


def test_loading_something_else(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        Run.load(tmp_path / "none.nc")
    (tmp_path / "text.nc").write_text("hello")
    with pytest.raises(InputError, match="is not a run"):
        Run.load(tmp_path / "text.nc")
    with netCDF4.Dataset(tmp_path / "other.nc", "w") as file:
        file.createDimension("x", 3)
    with pytest.raises(InputError, match="is not a run"):
        Run.load(tmp_path / "other.nc")


def test_to_xarray(run):
    pytest.importorskip("xarray")
    data = run.to_xarray()
    assert dict(data.sizes) == {"time": 50}
    np.testing.assert_array_equal(data["fr_wheel_load"].values, run["fr_wheel_load"])
    assert data["fr_wheel_load"].attrs["units"] == "N"
    assert data["time"].attrs["units"] == "s"
    assert float(data["body_acceleration"].sel(time=0.1, method="nearest")) == run["body_acceleration"][10]


def test_a_known_quantity_brings_its_unit():
    channel = described("suspension_deflection", np.zeros(3), "rl")
    assert (channel.unit, channel.station, channel.quantity) == ("m", "rl", "suspension_deflection")
    assert isinstance(channel, Channel)
