"""What is wrong in a targets file is one line with file, key, value and what is allowed, and nothing is left behind."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

from design.cli import app
from design.cycle.targets import available_cycles, load_targets
from susp_mj.errors import InputError

from .conftest import TARGETS

CHECK = """[[check]]
name = "x"
manoeuvre = { kind = "ramp_steer" }
criteria = { wheel_lift_time = { max = 0 } }
[roll]"""
WRONG = {
    "unit": ('"1.2 Hz"', '"1.2 N"', "ride.frequency.front", "unit"),
    "misspelt table": ("[travel]", "[travl]", "travl", "travel"),
    "no frequency": ('front = "1.2 Hz", ', "", "ride.frequency", "give front and rear"),
    "share": ("front_share = 0.6", "front_share = 1.5", "roll.front_share", "less than 1"),
    "negative angle": ('"5 deg"', '"-5 deg"', "roll.angle", "greater than 0"),
    "vehicle": ('"s_class"', '"s_clas"', "vehicle", "s_class"),
    "set": ('"configuration_4"', '"configuration_9"', "characteristics", "configuration_4"),
    "load": ('"full"]', '"fuller"]', "loads", "full"),
    "load of the roll": ("front_share", "load = 'half'\nfront_share", "roll.load", "no load case 'half'"),
    "trade-off": (
        "[roll]",
        "[[trade_off.response]]\ntitle = 'x'\nload = 'half'\nmanoeuvre = { kind = 'bump' }\n"
        "number = 'overshoot'\n[roll]",
        "trade_off.response.0.load",
        "choose ko",
    ),
    "names alike": (
        "[roll]",
        "[[candidate]]\nname='a b'\n[[candidate]]\nname='a_b'\n[roll]",
        "candidate.1.name",
        "taken",
    ),
    "named like a step": ("[roll]", CHECK.replace('"x"', '"steps"'), "check.0.name", "taken"),
    "empty band": (
        "[roll]",
        CHECK.replace("{ max = 0 }", "{}"),
        "check.0.criteria.wheel_lift_time",
        "give 'min', 'max'",
    ),
    "set of a candidate": ("[ride]", "[[candidate]]\ncharacteristics = 'nope'\n[ride]", "candidate.0", "no set 'nope'"),
    "knob": ("[ride]", "[hold]\n'front.frequncy' = true\n[ride]", "hold.front.frequncy", "front.frequency"),
    "held value": ("[ride]", "[hold]\n'front.bar' = '3 Hz'\n[ride]", "hold.front.bar", "N/m"),
    "no manoeuvre": (
        "[roll]",
        CHECK.replace("ramp_steer", "ramp_ster"),
        "manoeuvre",
        "ramp_steer",
    ),
    "number": (
        "[roll]",
        CHECK.replace("wheel_lift_time", "wheel_lift"),
        "check.0.criteria",
        "wheel_lift_time",
    ),
    "band of another unit": (
        "[roll]",
        CHECK.replace("max = 0", "max = '1 m'"),
        "check.0.criteria.wheel_lift_time.max",
        "s",
    ),
    "repair": (
        "[roll]",
        CHECK.replace("name", "repair = 'softer'\nname"),
        "check.0.repair",
        "softer_rebound",
    ),
    "parent": ("[ride]", "[[candidate]]\nparent = 'Z'\n[ride]", "candidate.0.parent", "no earlier candidate"),
    "ratio": ("[ride]", "[dampers]\ncompression_to_rebound = '1-2'\n[ride]", "dampers.compression_to_rebound", "'1:2'"),
}


@pytest.mark.parametrize("case", WRONG)
def test_bad_input_is_one_line(tmp_path, case):
    old, new, key, words = WRONG[case]
    assert old in TARGETS
    file, out = tmp_path / "mine.toml", tmp_path / "out"
    file.write_text(TARGETS.replace(old, new), encoding="utf-8")
    done = CliRunner().invoke(app, ["design", str(file), "--out", str(out)])
    error = done.exception
    assert isinstance(error, InputError), done.output
    assert str(error).startswith("mine.toml: ") and "\n" not in str(error)
    assert key in str(error) and words in str(error)
    assert not out.exists() or not any(out.rglob("*.html"))


def test_shipped_cycles_load():
    for name in available_cycles():
        targets, path = load_targets(name)
        assert targets.title and path.stem == name


def test_nothing_to_resume(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(TARGETS, encoding="utf-8")
    done = CliRunner().invoke(app, ["design", str(file), "--resume", "--out", str(tmp_path / "out")])
    assert "nothing to resume" in str(done.exception)
    done = CliRunner().invoke(app, ["design", str(file), "--change", "front.bar=3 N/m"])
    assert "--change: needs --from" in str(done.exception)
