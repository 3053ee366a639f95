"""Measured signals: every format gives the same numbers, units are those of the file, damage is one line."""

from __future__ import annotations

import sys
from types import SimpleNamespace

import numpy as np
import pytest

from susp_mj import InputError
from susp_mj.signals import STANDARD_GRAVITY, Signal, read_signals

from ..builders.runs import run_of

TIME = np.array([0.0, 0.1, 0.25, 0.4])
HEIGHT = np.array([0.0, 0.01, -0.02, 0.005])


def written(tmp_path, text, name="measured.csv", encoding="utf-8"):
    path = tmp_path / name
    path.write_text(text, encoding=encoding)
    return path


def table(separator=",", point=".", head=("time [s]", "fl [mm]", "a [g]")):
    rows = [[f"{t:.3f}", f"{1e3 * z:.3f}", f"{z:.4f}"] for t, z in zip(TIME, HEIGHT, strict=True)]
    return "\n".join(separator.join(row).replace(".", point) for row in [list(head), *rows]) + "\n"


@pytest.mark.parametrize(
    ("text", "encoding"),
    [
        (table(), "utf-8"),
        (table(), "utf-8-sig"),
        (table(), "utf-16"),
        (table(";", ","), "cp1252"),
        (table("\t"), "utf-8"),
        ("# a comment\n\n" + table(), "utf-8"),
        (table(head=("Zeit (s)", "fl (mm)", "a (g)")), "utf-8"),
        (table(head=("t", "fl", "a")).replace("t,fl,a\n", "t,fl,a\ns,mm,g\n"), "utf-8"),
    ],
)
def test_every_spelling_of_a_table_gives_the_same(tmp_path, text, encoding):
    signals = read_signals(written(tmp_path, text, encoding=encoding))
    assert list(signals) == ["fl", "a"]
    np.testing.assert_allclose(signals["fl"].time, TIME)
    np.testing.assert_allclose(signals.si("fl", "m"), HEIGHT)
    np.testing.assert_allclose(signals.si("a", "m/s²"), HEIGHT * STANDARD_GRAVITY, atol=1e-3)


def test_time_has_its_unit_too(tmp_path):
    signals = read_signals(written(tmp_path, "time [ms],x [m]\n0,1\n20,2\n"))
    np.testing.assert_allclose(signals["x"].time, [0.0, 0.02])


def test_a_gram_is_a_gram_where_a_mass_is_measured():
    np.testing.assert_allclose(Signal(TIME, HEIGHT, "g").si("kg"), HEIGHT * 1e-3)


@pytest.mark.parametrize(
    ("unit", "wanted", "written", "said"),
    [
        ("", "m", None, "has no unit; expected one like m"),
        ("N", "m", None, "wrong unit 'N'"),
        ("furlong", "m", None, "unknown unit 'furlong'"),
        ("mm", "1", None, "expected none"),
    ],
)
def test_units_that_do_not_fit(unit, wanted, written, said):
    with pytest.raises(ValueError, match=said):
        Signal(TIME, HEIGHT, unit).si(wanted, written)


def test_a_unit_that_is_given_holds():
    np.testing.assert_allclose(Signal(TIME, HEIGHT, "N").si("m", "mm"), HEIGHT * 1e-3)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "no line of names"),
        ("time [s],x [m]\n", "no line of names"),
        ("time [s],x [m]\n0,1\n0.1\n", "line 3: has 1 values, the line of names 2"),
        ("time [s],x [m]\n0,1\n0.1,much\n", "line 3: 'much' is not a number"),
        ("time [s],x [m]\n0,1\n0.1,\n", "x: has 1 values that are no numbers, the first at 0.1 s"),
        ("time [s],x [m]\n0,1\n0.2,1\n0.1,2\n", r"time must increase, but 0.1 s follows 0.2 s \(sample 3\)"),
        ("time [s],x [m]\n0,1\n0,2\n", "time must increase"),
        ("time [s],x [m]\n0,1\n", "has 1 samples"),
        ("time [m],x [m]\n0,1\n1,1\n", "time has the wrong unit 'm'"),
        ("distance [m],x [m]\n0,1\n1,1\n", "no column of time"),
        ("time [s],x [m],x [m]\n0,1,1\n1,1,1\n", "two columns are called 'x'"),
        ("time [s]\n0\n1\n", "holds no signal"),
    ],
)
def test_a_damaged_table_is_one_line(tmp_path, text, said):
    with pytest.raises(InputError, match=said) as caught:
        read_signals(written(tmp_path, text))
    assert str(caught.value).startswith("measured.csv: ") and "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "said"),
    [("a.csv", "is not a text file"), ("a.nc", "is not NetCDF"), ("a.xls", r"by its ending '.xls'; choose .csv")],
)
def test_other_damage_is_one_line(tmp_path, name, said):
    path = tmp_path / name
    path.write_bytes(b"\0\1\2" * 50)
    with pytest.raises(InputError, match=said) as caught:
        read_signals(path)
    assert "\n" not in str(caught.value)


def test_no_such_file(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        read_signals(tmp_path / "gone.csv")


def test_a_saved_run_is_read_with_its_units(tmp_path):
    run = run_of(TIME, {"fl_wheel_load": 1e3 + HEIGHT, "roll_angle": HEIGHT})
    signals = read_signals(run.save(tmp_path / "run.nc"))
    assert list(signals) == ["fl_wheel_load", "roll_angle"]
    np.testing.assert_array_equal(signals.si("roll_angle", "rad"), HEIGHT)


def test_mdf_says_what_it_needs(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "asammdf", None)
    path = tmp_path / "measured.mf4"
    path.write_bytes(b"MDF     4.10")
    with pytest.raises(InputError, match=r"needs the package asammdf: pip install 'susp_mj\[mdf\]'"):
        read_signals(path)


class FakeMDF:
    """Two channels of one name at different rates, and a text."""

    def __init__(self, path):
        if path.name == "bad.mf4":
            raise RuntimeError("no block ##HD")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        return None

    def iter_channels(self, *, skip_master):
        assert skip_master
        yield SimpleNamespace(name="fl", group_index=0, samples=1e3 * HEIGHT, timestamps=TIME, unit="mm")
        yield SimpleNamespace(name="fl", group_index=1, samples=np.arange(3), timestamps=np.arange(3), unit=None)
        yield SimpleNamespace(name="note", group_index=2, samples=np.array(["a"]), timestamps=np.zeros(1), unit="")


def test_mdf_channels_keep_their_own_time(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "asammdf", SimpleNamespace(MDF=FakeMDF))
    for name in ("measured.mf4", "bad.mf4"):
        (tmp_path / name).write_bytes(b"MDF     4.10")
    signals = read_signals(tmp_path / "measured.mf4")
    assert list(signals) == ["fl", "fl (1)"] and len(signals["fl (1)"].time) == 3
    np.testing.assert_allclose(signals.si("fl", "m"), HEIGHT)
    with pytest.raises(InputError, match=r"bad.mf4: is not MDF4: 'no block ##HD'"):
        read_signals(tmp_path / "bad.mf4")


def test_mdf_as_asammdf_writes_it(tmp_path):
    asammdf = pytest.importorskip("asammdf")
    path = tmp_path / "measured.mf4"
    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal(1e3 * HEIGHT, TIME, unit="mm", name="fl")])
        file.save(path)
    np.testing.assert_allclose(read_signals(path).si("fl", "m"), HEIGHT)
