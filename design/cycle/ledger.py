"""Ledger: every run of a cycle with its numbers, on disk as soon as it is done, so that nothing is simulated twice."""

from __future__ import annotations

import hashlib
import json
import os
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from evaluation.numbers import Number, evaluate
from susp_mj.batch import side_by_side
from susp_mj.errors import InputError, SimulationError
from susp_mj.manoeuvre import Manoeuvre
from susp_mj.plant import Plant
from susp_mj.plugins import plugin_files
from susp_mj.recording import Diverged, versions
from susp_mj.run import Run
from susp_mj.simulation import simulate
from vehicles.mjcf import build
from vehicles.vehicle import Vehicle

from ..case import read_manoeuvre
from ..running import Report

ROOT = Path(__file__).parent.parent.parent
PACKAGES = ("susp_mj", "vehicles", "manoeuvres", "evaluation")
"""Whose sources decide about a number."""
SOURCES = (".py", ".csv")


@dataclass(frozen=True)
class Asked:
    """One run that a step asks for.

    Attributes:
        label: in words, for progress.
        key: what asks for it in the targets file, for errors.
        car: the candidate's.
        car_hash: of all that the car is.
        model, load, axle: of the plant.
        manoeuvre: its table.
        numbers: names of the evaluation numbers.
        step: integration step [s]; None is the default.
    """

    label: str
    key: str
    car: Vehicle
    car_hash: str
    model: str
    load: str
    axle: str | None
    manoeuvre: Mapping[str, Any]
    numbers: Sequence[str]
    step: float | None = None


@dataclass(frozen=True)
class _Prepared:
    asked: Asked
    manoeuvre: Manoeuvre
    plant: Plant


@dataclass(frozen=True)
class Answered:
    """What a run gave.

    Attributes:
        numbers: by name; empty if there is no run to the end.
        failed: why there is none, one line; empty if there is.
    """

    numbers: Mapping[str, Number]
    failed: str = ""


class Ledger:
    """Runs that are done, in memory and in a file of one line each; what is asked again is looked up.

    A line is written whole or, if the machine stops there, left out at the next start. The key of a run is a hash of
    all that it depends on: car file, overrides, model, manoeuvre, sources and versions.
    """

    def __init__(self, path: Path, file: Path, workers: int | None = None) -> None:
        """Open the ledger `path` for the targets `file`."""
        self.path, self.file, self.workers = path, file, workers
        self.known: dict[str, Answered] = {}
        self.simulated = 0
        self._lock = threading.Lock()
        if path.is_file():
            self._read()

    def _read(self) -> None:
        content = self.path.read_bytes()
        whole = content.rfind(b"\n") + 1  # what follows the last line end was cut off
        for i, line in enumerate(content[:whole].splitlines()):
            try:
                entry = json.loads(line)
                numbers = {name: Number(**number) for name, number in entry["numbers"].items()}
                self.known[entry["key"]] = Answered(numbers, entry["failed"])
            except (ValueError, KeyError, TypeError):
                text = f"line {i + 1} is damaged; take it out, or begin anew without --resume"
                raise InputError(text, source=str(self.path)) from None
        if whole < len(content):
            os.truncate(self.path, whole)

    def ask(self, asked: Sequence[Asked], progress: Report = lambda name, done: None) -> list[Answered]:
        """Answers to all of these, side by side where they are not known.

        Raises:
            InputError: something asked for does not exist or does not fit.
        """
        keys = [self._key(each) for each in asked]
        new = {key: each for key, each in zip(keys, asked, strict=True) if key not in self.known}

        jobs = list(new.items())
        side_by_side(
            jobs,
            lambda job: (job[0], self._prepared(job[1])),
            lambda ready, done: self._write(ready[0], _answer(ready[1].asked, self._simulated(ready[1], done))),
            lambda written: written,
            workers=self.workers,
            progress=lambda place, done: progress(jobs[place][1].label, done),
        )
        return [self.known[key] for key in keys]

    def _write(self, key: str, answered: Answered) -> None:
        """Keep an answer, on disk before anything else; called by the threads that have them."""
        numbers = {
            name: {"value": each.value, "unit": each.unit, "note": each.note, "applies": each.applies}
            for name, each in answered.numbers.items()
        }
        line = json.dumps({"key": key, "failed": answered.failed, "numbers": numbers}, ensure_ascii=False)
        with self._lock, self.path.open("ab") as file:
            file.write(line.encode() + b"\n")
            file.flush()
            os.fsync(file.fileno())
            self.known[key] = answered
            self.simulated += 1

    def runs(self, asked: Sequence[Asked], progress: Report = lambda name, done: None) -> list[Run | None]:
        """The runs themselves, with their records; up to where they end if they do not come to their end.

        Raises:
            InputError: as `ask`.
        """
        return side_by_side(
            asked,
            self._prepared,
            self._simulated,
            lambda run: run if isinstance(run, Run) else run.run if isinstance(run, Diverged) else None,
            workers=self.workers,
            progress=lambda place, done: progress(f"figures: {asked[place].label}", done),
        )

    def _prepared(self, asked: Asked) -> _Prepared:
        manoeuvre = read_manoeuvre(asked.manoeuvre, self.file)
        try:
            return _Prepared(asked, manoeuvre, build(asked.car, asked.model, asked.load, asked.axle, manoeuvre.rig))
        except InputError as error:
            raise error.within(key="" if error.source else asked.key, source=self.file.name) from None

    def _simulated(self, prepared: _Prepared, done: Callable[[float], None]) -> Run | SimulationError:
        try:
            return simulate(prepared.plant, prepared.manoeuvre, step=prepared.asked.step, progress=done)
        except SimulationError as error:
            return error
        except InputError as error:
            raise error.within(key="" if error.source else prepared.asked.key, source=self.file.name) from None

    def _key(self, asked: Asked) -> str:
        what = {
            "car": asked.car_hash,
            "model": asked.model,
            "load": asked.load,
            "axle": asked.axle,
            "manoeuvre": asked.manoeuvre,
            "files": [_content(self.file.parent / each) for each in asked.manoeuvre.values() if isinstance(each, str)],
            "numbers": list(asked.numbers),
            "step": asked.step,
            "with": self._sources,
        }
        return hashlib.sha256(json.dumps(what, sort_keys=True, default=str).encode()).hexdigest()

    @cached_property
    def _sources(self) -> str:
        """Hash of everything else that a number depends on: our sources, plugins and the versions of packages."""
        digest = hashlib.sha256(json.dumps(dict(versions()), sort_keys=True).encode())
        ours = [each for name in PACKAGES for each in sorted((ROOT / name).rglob("*")) if each.suffix in SOURCES]
        for path in (*plugin_files(), *ours):
            digest.update(path.read_bytes())
        return digest.hexdigest()


def _content(path: Path) -> str:
    """Hash of a file that a manoeuvre may name; empty if it is none."""
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""


def _answer(asked: Asked, run: Run | SimulationError) -> Answered:
    """The numbers of a run, or why it did not come to its end."""
    if isinstance(run, SimulationError):
        return Answered({}, str(run))
    try:
        numbers = evaluate(run, tuple(asked.numbers))
    except SimulationError as error:
        return Answered({}, str(error))
    return Answered(
        {
            name: Number(None if each.value is None else float(each.value), each.unit, each.note, each.applies)
            for name, each in numbers.items()
        }
    )
