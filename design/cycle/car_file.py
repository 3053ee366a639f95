"""Files of a cycle: the car's own with the candidates as further sets, and cases that hold the kept one against its
targets again."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from copy import deepcopy
from pathlib import Path
from typing import Any

import tomlkit

from evaluation.display import quantity_text
from evaluation.story import Finding
from susp_mj.errors import SuspMjError
from susp_mj.files import file_name, write_text
from susp_mj.names import AXLES
from vehicles.reading import VehicleFile, override

from .candidate import Candidate, Layout
from .characteristics import ONE_MASS, ROLLING, lateral_force_of, place_name, step_of
from .checks import places_of
from .cycling import Outcome, kept_of

PARTS = ("spring", "damper", "anti_roll_bar")
"""Of an axle, what a set of characteristics holds."""


def write_car(layout: Layout, outcomes: Sequence[Outcome], folder: Path) -> Path:
    """The vehicle file of the cycle: every candidate a set of its own name, the kept or else the last one the default.

    Comments and sources of the file stay; a tyre file that lies beside it is copied.

    Raises:
        SuspMjError: a set that is read back is not the candidate; that would be a fault of this program.
    """
    document = tomlkit.parse(layout.file.path.read_text(encoding="utf-8"))
    for path, value in layout.targets.set.items():
        override(document, path, value, layout.path.name)
    possible = [each for each in outcomes if each.possible]
    chosen = kept_of(outcomes) or (possible[-1] if possible else None)
    sets = document.setdefault("characteristics", tomlkit.table(is_super_table=True))
    for outcome in possible:
        sets[set_name(layout, outcome.candidate)] = _set(layout, outcome)
    if chosen is not None:
        _set_default(document, set_name(layout, chosen.candidate))
    if "sources" in document:
        for outcome in possible:
            key = f"characteristics.{set_name(layout, outcome.candidate)}"
            document["sources"][key] = f"estimated: laid out by susp_mj from {layout.path.name}"
    _bring_files(layout.file, document, folder)
    path = write_text(folder / layout.file.path.name, tomlkit.dumps(document))
    _check(layout, possible, path)
    return path


def set_name(layout: Layout, candidate: Candidate) -> str:
    """Name of a candidate's set of characteristics; the sets that the file has stay what they are."""
    name = file_name(candidate.name).replace(".", "_")
    return f"{name}_candidate" if name in layout.file.sets else name


def _set(layout: Layout, outcome: Outcome) -> dict[str, Any]:
    """The set that the candidate began with, its springs, dampers and bars in the candidate's place."""
    car, file = layout.vehicle(outcome.candidate), layout.file
    table = deepcopy(dict(file.sets.get(outcome.candidate.characteristics or file.default, {})))
    table["title"] = f"{'kept' if outcome.kept else 'discarded'}: {outcome.candidate.because}"
    for name in AXLES:
        axle = table.setdefault(name, {})
        for part in PARTS:
            value = getattr(getattr(car, name), part)
            axle.pop(part, None)
            if value is not None:
                axle[part] = value.model_dump(mode="json", exclude_none=True)
    return table


def _set_default(document: tomlkit.TOMLDocument, name: str) -> None:
    """Set `default`, above the first table if it is new."""
    if "default" in document:
        document["default"] = name
        return
    text = tomlkit.dumps(document)
    document.clear()
    document.update(tomlkit.parse(f'default = "{name}"\n{text}'))


def _bring_files(file: VehicleFile, document: tomlkit.TOMLDocument, folder: Path) -> None:
    """Copy the tyre files that lie beside the car's file, and name its plugins where they are."""
    here = file.path.parent
    for tables in (document, *document.get("characteristics", {}).values()):
        for axle in AXLES:
            tyre = tables.get(axle, {}).get("handling_tyre", {})
            source = here / str(tyre.get("file", ""))
            if tyre.get("file") and not Path(str(tyre["file"])).is_absolute() and source.is_file():
                folder.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source, folder / source.name)
                tyre["file"] = source.name
    if "plugins" in document:
        document["plugins"] = [str((here / str(each)).resolve()) for each in document["plugins"]]


def _check(layout: Layout, outcomes: Sequence[Outcome], path: Path) -> None:
    """Refuse a file whose sets are not the candidates that were tried."""
    written = VehicleFile.open(path)
    named = {"name": "", "source": "", "title": "", "characteristics": "", "sources": {}}
    for outcome in outcomes:
        wanted, found = layout.vehicle(outcome.candidate), written.vehicle(set_name(layout, outcome.candidate))
        if wanted.model_copy(update=named) != found.model_copy(update=named):
            raise SuspMjError(f"{path.name}: candidate {outcome.candidate.name} was not written as it is")


def write_cases(layout: Layout, kept: Outcome, car: Path, folder: Path) -> list[Path]:
    """A case for every check, for every step of the road and for the roll, with the targets as criteria."""
    cases = [*_step_cases(layout, kept, car), *_roll_case(layout, kept, car), *_check_cases(layout, kept, car)]
    return [write_text(folder / f"{file_name(case['title'])}.toml", tomlkit.dumps(case)) for case in cases]


def _case(layout: Layout, title: str, model: str, manoeuvre: dict[str, Any]) -> dict[str, Any]:
    description = f"Target of {layout.path.name}, held against the kept characteristics."
    case: dict[str, Any] = {"title": title, "description": description, "model": model}
    if layout.targets.plugins:
        case["plugins"] = [str((layout.path.parent / each).resolve()) for each in layout.targets.plugins]
    return {**case, "manoeuvre": {key: _beside(layout, value) for key, value in manoeuvre.items()}}


def _beside(layout: Layout, value: Any) -> Any:
    """A value of a manoeuvre; a file that lies beside the targets by its whole path."""
    path = layout.path.parent / value if isinstance(value, str) else None
    return str(path.resolve()) if path is not None and path.is_file() else value


def _configurations(
    layout: Layout, kept: Outcome, car: Path, places: Sequence[tuple[str, str | None]]
) -> list[dict[str, Any]]:
    characteristics = set_name(layout, kept.candidate)
    return [
        {
            "name": f"{kept.candidate.name}, {place_name(load, axle)}",
            "vehicle": f"../{car.name}",
            "characteristics": characteristics,
            "load": load,
            **({"axle": axle} if axle else {}),
        }
        for load, axle in places
    ]


def _step_cases(layout: Layout, kept: Outcome, car: Path) -> list[dict[str, Any]]:
    targets = layout.targets
    criteria: dict[str, Any] = {"stop_hits": {"max": 0}}
    if targets.travel.overshoot is not None:
        criteria["overshoot"] = {"max": targets.travel.overshoot}
    places = [(load, axle) for axle in AXLES for load in targets.loads]
    return [
        {
            **_case(layout, f"step of {quantity_text(height, 'm')}", ONE_MASS, step_of(height)),
            "criteria": criteria,
            "configuration": _configurations(layout, kept, car, places),
        }
        for height in targets.travel.steps
    ]


def _roll_case(layout: Layout, kept: Outcome, car: Path) -> list[dict[str, Any]]:
    roll = layout.targets.roll
    found: Finding | None = next((each for each in kept.findings if each.step == "roll"), None)
    if roll is None or found is None or found.minimum is None or found.maximum is None:
        return []
    return [
        {
            **_case(layout, "roll", ROLLING, lateral_force_of(roll)),
            "criteria": {"roll_angle_final": {"min": found.minimum, "max": found.maximum}},
            "configuration": _configurations(layout, kept, car, [(roll.load, None)]),
        }
    ]


def _check_cases(layout: Layout, kept: Outcome, car: Path) -> list[dict[str, Any]]:
    return [
        {
            **_case(layout, check.name, check.model, check.manoeuvre),
            **({"step": check.step} if check.step is not None else {}),
            "criteria": {name: band.model_dump(exclude_none=True) for name, band in check.criteria.items()},
            "configuration": _configurations(layout, kept, car, places_of(layout, check)),
        }
        for check in layout.targets.check
    ]
