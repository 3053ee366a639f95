"""Folders of a cycle: they hold what was found, run again as they say, and survive being stopped at any moment."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import tomlkit

from design.cycle.cycling import Branch, cycle
from design.cycle.output import lay_out
from design.cycle.targets import load_targets
from susp_mj.errors import InputError
from vehicles import VehicleFile, load_vehicle

from ..test_plugins import call
from .conftest import TARGETS

ROOT = Path(__file__).parents[3]
RATIOS = """
set = { "rear.spring_ratio" = 0.8, "rear.damper_ratio" = 0.9 }
coil = { rear = { wire_diameter = "14 mm", coil_diameter = "110 mm" } }
piston = { rear = { piston_diameter = "36 mm", rod_diameter = "22 mm" } }
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Results of the targets of these tests, with motion ratios."""
    here = tmp_path_factory.mktemp("cycle")
    (here / "mine.toml").write_text(TARGETS.replace("[ride]", f"{RATIOS}\n[ride]", 1), encoding="utf-8")
    targets, path = load_targets(here / "mine.toml")
    lay_out(targets, path, here / "out")
    return here


def test_everything_is_there_and_nothing_half_written(folder):
    out = folder / "out"
    assert {"verdict.html", "verdict.json", "s_class.toml", "cases", "components", "runs", "state"} == {
        each.name for each in out.iterdir()
    }
    assert not list(out.rglob("*.part")) and not list(out.glob(".unfinished*"))
    verdict = json.loads((out / "verdict.json").read_text(encoding="utf-8"))
    assert verdict["kept"] == "B" and [each["name"] for each in verdict["attempts"]] == ["A", "B"]
    assert "active turns" in (out / "verdict.html").read_text(encoding="utf-8")


def test_the_car_file_holds_every_candidate_and_the_file_it_came_from(folder):
    car = folder / "out" / "s_class.toml"
    file, own = VehicleFile.open(car), VehicleFile.open("s_class")
    assert file.default == "B" and set(file.sets) == {*own.sets, "A", "B"}
    assert own.path.read_text(encoding="utf-8").splitlines()[0] == car.read_text(encoding="utf-8").splitlines()[0]
    for name in own.sets:
        assert file.vehicle(name).front == own.vehicle(name, {"rear.spring_ratio": 0.8}).front
    verdict = json.loads((folder / "out" / "verdict.json").read_text(encoding="utf-8"))
    for attempt in verdict["attempts"]:
        vehicle = file.vehicle(attempt["name"])
        rate = attempt["values"]["rear.damping"]["value"]
        assert float(vehicle.axle("rear").damper.force_at(0.1)) == pytest.approx(0.1 * rate * 2 / 3)


@pytest.mark.parametrize("case", ["step of 70.0 mm", "roll"])
def test_the_kept_car_meets_its_targets_when_it_is_run_again(folder, case):
    file = folder / "out" / "cases" / f"{case.replace(' ', '_')}.toml"
    done = call("run", str(file), "--strict", "--out", str(folder / "again" / case), cwd=folder)
    assert done.returncode == 0, done.stderr + done.stdout


def test_assessing_the_written_car_keeps_it(folder):
    text = (folder / "mine.toml").read_text(encoding="utf-8")
    text = text.replace('"s_class"', '"out/s_class.toml"').replace('characteristics = "configuration_4"', "")
    (folder / "assess.toml").write_text('start = "car"\n' + text, encoding="utf-8")
    targets, path = load_targets(folder / "assess.toml")
    story = lay_out(targets, path, folder / "assessed")
    assert len(story.attempts) == 1 and story.kept is not None


def test_curves_at_the_component_do_the_same_work(folder):
    lines = (folder / "out" / "components" / "rear_spring.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0] == "travel [m],force [N]"
    rows = [tuple(map(float, line.split(","))) for line in lines[1:]]
    spring = VehicleFile.open(folder / "out" / "s_class.toml").vehicle().axle("rear").spring
    for s, force in rows[:: len(rows) // 20]:
        assert force * 0.8 == pytest.approx(float(spring.force_at(s / 0.8)), rel=1e-4)


def test_a_resumed_cycle_simulates_nothing_and_says_the_same(folder):
    out = folder / "out"
    before = (out / "verdict.json").read_bytes(), (out / "state" / "runs.jsonl").read_bytes()
    targets, path = load_targets(folder / "mine.toml")
    lay_out(targets, path, out, resume=True)
    assert ((out / "verdict.json").read_bytes(), (out / "state" / "runs.jsonl").read_bytes()) == before


def test_a_candidate_named_like_a_set_leaves_the_set_alone(tmp_path):
    by_hand = "[[candidate]]\nname = 'configuration_4'\nchange = { 'rear.damping' = '1700 N s/m' }\n"
    (tmp_path / "mine.toml").write_text(TARGETS + by_hand, encoding="utf-8")
    targets, path = load_targets(tmp_path / "mine.toml")
    story = lay_out(targets, path, tmp_path / "out")
    file, own = VehicleFile.open(tmp_path / "out" / "s_class.toml"), VehicleFile.open("s_class")
    assert story.kept.name == "configuration_4" and file.default == "configuration_4_candidate"
    assert file.vehicle("configuration_4").rear == own.vehicle("configuration_4").rear
    assert file.vehicle().rear != own.vehicle("configuration_4").rear


def test_branches_stay(folder):
    targets, path = load_targets(folder / "mine.toml")
    out = folder / "branched"
    lay_out(targets, path, out)
    story = lay_out(targets, path, out, branch=Branch("A", {"rear.damping": 2500.0}))
    assert [each.name for each in story.attempts] == ["A", "B", "C"] and story.attempts[2].parent == "A"
    assert story.kept.values["rear.damping"] == (2500.0, "N s/m")
    again = lay_out(targets, path, out, resume=True)
    assert [each.name for each in again.attempts] == ["A", "B", "C"]
    with pytest.raises(InputError, match="no candidate 'Z'"):
        lay_out(targets, path, out, branch=Branch("Z", {}))
    assert [each.name for each in lay_out(targets, path, out, resume=True).attempts] == ["A", "B", "C"]


def test_stopped_at_any_moment_and_resumed_it_says_the_same(folder):
    """kill -9 in the middle of the runs, three times in a row, then resumed to the end."""
    out = folder / "killed"
    command = [sys.executable, "-m", "design.cli", "design", str(folder / "mine.toml"), "--out", str(out)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    moment = random.Random(7)
    ledger = out / "state" / "runs.jsonl"
    for attempt in range(3):
        process = subprocess.Popen(
            [*command, *(["--resume"] if attempt else [])],
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        wanted = (ledger.read_bytes().count(b"\n") if ledger.is_file() else 0) + moment.randint(1, 8)
        while process.poll() is None and (not ledger.is_file() or ledger.read_bytes().count(b"\n") < wanted):
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        process.wait()
        assert not (out / "verdict.json").exists() or attempt
    done = subprocess.run(
        [*command, "--resume"], env=environment, capture_output=True, text=True, timeout=300, check=False
    )
    assert done.returncode == 0, done.stderr
    assert (out / "verdict.json").read_bytes() == (folder / "out" / "verdict.json").read_bytes()


def test_every_knob_makes_another_car(bench):
    """A run is looked up by all that its car is; no two cars may be taken for one."""
    layout = bench().layout
    first = layout.proposed("A")
    cars = [layout.vehicle(first)]
    for knob, value in layout.values(first).items():
        new = "1:1.7" if isinstance(value, str) else 1.001 * value + 1e-3
        cars.append(layout.vehicle(first.turn("B", "", {knob: new})))
    assert len({layout.hash_of(car) for car in cars}) == len(cars) == 11


def test_a_line_that_was_cut_off_is_left_out(bench):
    table = bench()
    outcomes = cycle(table.layout, table.ledger.ask)
    whole = table.ledger.path.read_bytes()
    table.ledger.path.write_bytes(whole + b'{"key": "abc", "fai')
    again = bench().ledger
    assert again.path.read_bytes() == whole and len(again.known) == len(table.ledger.known)
    repeated = cycle(table.layout, again.ask)
    assert again.simulated == 0
    assert [each.findings for each in repeated] == [each.findings for each in outcomes]


def test_a_car_of_one_set_beside_its_tyre(tmp_path):
    """A user's own file without sets: the candidates become its sets, what lies beside it comes along."""
    source = VehicleFile.open("s_class")
    document = tomlkit.parse(source.path.read_text(encoding="utf-8"))
    chosen = document.pop("characteristics")["configuration_4"]
    document.pop("default")
    document.pop("sources")
    for axle in ("front", "rear"):
        document[axle].update(chosen[axle])
        tyre = load_vehicle("s_class")
        file = Path(document[axle]["handling_tyre"]["file"]).name
        document[axle]["handling_tyre"]["file"] = f"my_{file}"
        (tmp_path / f"my_{file}").write_bytes((source.path.parent / "tyres" / file).read_bytes())
    assert tyre.name == "s_class"
    (tmp_path / "own.toml").write_text(tomlkit.dumps(document), encoding="utf-8")
    text = TARGETS.replace('"s_class"', '"own.toml"').replace('characteristics = "configuration_4"', "")
    (tmp_path / "mine.toml").write_text(text, encoding="utf-8")
    targets, path = load_targets(tmp_path / "mine.toml")
    lay_out(targets, path, tmp_path / "out")
    file = VehicleFile.open(tmp_path / "out" / "own.toml")
    assert file.default == "B" and set(file.sets) == {"A", "B"}
    assert list((tmp_path / "out").glob("my_*.tir"))


def test_a_set_of_more_than_springs_and_a_plugin_come_along(tmp_path):
    """Track and friction of a set, an element of a plugin, a tyre in a folder of its own: the written car is the one
    that was tried."""
    source = VehicleFile.open("s_class")
    text = source.path.read_text(encoding="utf-8")
    document = tomlkit.parse(text)
    document["characteristics"]["configuration_4"]["front"].update({"friction": {"force": 300.0}, "track": 1.5})
    document["plugins"] = ["plugin.py"]
    (tmp_path / "plugin.py").write_text("import numpy\n", encoding="utf-8")
    (tmp_path / "mine").mkdir()
    for axle in ("front", "rear"):
        file = Path(document[axle]["handling_tyre"]["file"]).name
        document[axle]["handling_tyre"]["file"] = f"mine/{file}"
        (tmp_path / "mine" / file).write_bytes((source.path.parent / "tyres" / file).read_bytes())
    (tmp_path / "s_class.toml").write_text(tomlkit.dumps(document), encoding="utf-8")
    (tmp_path / "mine.toml").write_text(TARGETS.replace('"s_class"', '"s_class.toml"'), encoding="utf-8")
    targets, path = load_targets(tmp_path / "mine.toml")
    story = lay_out(targets, path, tmp_path / "out")
    car = VehicleFile.open(tmp_path / "out" / "s_class.toml").vehicle(story.kept.name)
    assert (car.front.track, car.front.friction.force) == (1.5, 300.0)


def test_results_never_replace_what_they_come_from(tmp_path):
    (tmp_path / "mine.toml").write_text(TARGETS, encoding="utf-8")
    (tmp_path / "state").mkdir()
    (tmp_path / "state" / "diary.txt").write_text("mine", encoding="utf-8")
    targets, path = load_targets(tmp_path / "mine.toml")
    with pytest.raises(InputError, match="holds the file of the targets"):
        lay_out(targets, path, tmp_path)
    assert (tmp_path / "state" / "diary.txt").is_file() and (tmp_path / "mine.toml").is_file()


def test_of_two_kept_candidates_all_speak_of_the_same(tmp_path):
    by_hand = "".join(
        f"[[candidate]]\nname = '{name}'\nchange = {{ 'rear.damping' = '{rate} N s/m' }}\n"
        for name, rate in (("P", 1700), ("Q", 1900))
    )
    (tmp_path / "mine.toml").write_text(TARGETS + by_hand, encoding="utf-8")
    targets, path = load_targets(tmp_path / "mine.toml")
    story = lay_out(targets, path, tmp_path / "out")
    assert story.kept.name == VehicleFile.open(tmp_path / "out" / "s_class.toml").default == "Q"
    assert story.verdict.startswith("Q is kept")


def test_a_damaged_ledger_is_one_line(bench):
    table = bench()
    table.ledger.path.write_bytes(b"not json\n")
    with pytest.raises(InputError, match="line 1 is damaged"):
        bench()


def test_a_film_that_cannot_be_made_leaves_the_results(tmp_path):
    """These targets ask for no manoeuvre of a driving car: there is nothing to film."""
    (tmp_path / "mine.toml").write_text(TARGETS, encoding="utf-8")
    targets, path = load_targets(tmp_path / "mine.toml")
    with pytest.raises(InputError, match="nothing to film"):
        lay_out(targets, path, tmp_path / "out", video=True)
    assert (tmp_path / "out" / "verdict.html").is_file()


def test_the_last_discarded_car_is_filmed_beside_the_kept_one(tmp_path, monkeypatch):
    """The clips and the place of the film; what it shows is tested where films are."""
    filmed = {}

    def render(clips, path, *, layout, quality, progress):
        filmed.update(names=[clip.label for clip in clips], layout=layout)
        path.write_bytes(b"film")
        return path

    monkeypatch.setattr("evaluation.animation.render.render_video", render)
    check = """
[[check]]
name = "step steer"
manoeuvre = { kind = "step_steer", duration = 2.0 }
loads = ["ko"]
criteria = { lateral_acceleration_max = { max = "%s m/s²" } }
"""
    by_hand = "[[candidate]]\nname = 'P'\nchange = { 'rear.damping' = '1700 N s/m' }\nrepair = false\n"
    (tmp_path / "mine.toml").write_text(TARGETS + check % 0.1 + by_hand, encoding="utf-8")
    targets, path = load_targets(tmp_path / "mine.toml")
    with pytest.raises(InputError, match="nothing to film"):
        lay_out(targets, path, tmp_path / "out", video=True)
    more = "[[candidate]]\nname = 'Q'\nchange = { 'rear.damping' = '1750 N s/m' }\n"
    (tmp_path / "mine.toml").write_text(TARGETS + check % 0.1 + by_hand + more, encoding="utf-8")
    targets, path = load_targets(tmp_path / "mine.toml")
    monkeypatch.setattr("design.cycle.telling._compared", lambda outcomes: outcomes)
    lay_out(targets, path, tmp_path / "out", video=True)
    assert filmed == {"names": ["P", "Q"], "layout": "ghost"}
    assert "film.mp4" in (tmp_path / "out" / "verdict.html").read_text(encoding="utf-8") or "data:video" in (
        tmp_path / "out" / "verdict.html"
    ).read_text(encoding="utf-8")
