"""A comparison in a folder, and back: the runs as NetCDF, everything else that a report shows as strict JSON."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from susp_mj.errors import InputError
from susp_mj.files import file_name, write_text
from susp_mj.linear import Mode
from susp_mj.run import Run

from .characteristics import Characteristic, ComponentDamper, ComponentSpring, ElementNote
from .compare import Claim, Comparison, Configuration, Failure, Outcome
from .numbers.number import Criterion, Number
from .plain import plain
from .tyre_curves import TyreCurves

SAVED = "comparison.json"
FORMAT = 1
"""Of what `save` writes; another one is not read."""


@dataclass(frozen=True)
class Saved:
    """What a folder of results holds.

    Attributes:
        comparison: as it was when it was saved, float by float; of its videos those that are there.
        film: how its video is drawn, plain values.
    """

    comparison: Comparison
    film: Mapping[str, Any]


def save(saved: Saved, folder: Path) -> None:
    """Write ``runs/*.nc`` and ``comparison.json``.

    Raises:
        InputError: the folder cannot be written.
    """
    for each in saved.comparison.outcomes:
        if each.run is not None:
            each.run.save(folder / _run_file(each.name))
    save_beside_runs(saved, folder)


def save_beside_runs(saved: Saved, folder: Path) -> None:
    """Write ``comparison.json`` to a folder that has the runs already.

    Raises:
        InputError: the folder cannot be written.
    """
    comparison = saved.comparison
    names = {name for each in comparison.configurations for name in each.numbers} | set(comparison.criteria)
    content = {
        "format": FORMAT,
        "title": comparison.title,
        "description": comparison.description,
        "baseline": comparison.baseline,
        "outcomes": [_outcome(each, folder) for each in comparison.outcomes],
        "criteria": comparison.criteria,
        "claims": comparison.claims,
        "videos": comparison.videos,
        "descriptions": {name: comparison.description_of(name) for name in sorted(names)},
        "film": saved.film,
    }
    write_text(folder / SAVED, json.dumps(plain(content), ensure_ascii=False, allow_nan=False) + "\n")


def load(folder: Path) -> Saved:
    """Read what `save` wrote.

    Raises:
        InputError: no such folder, no results in it, or a file of them is missing or damaged.
    """
    path = folder / SAVED
    if not folder.is_dir():
        raise InputError("no such folder", source=str(folder))
    if not path.is_file():
        raise InputError(f"holds no results with {SAVED}; run its case once more", source=str(folder))
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if content["format"] != FORMAT:
            raise InputError(f"is of another version ({content['format']!r}); run its case once more", source=str(path))
        return Saved(_comparison(content, folder), dict(content["film"]))
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror or error}", source=str(path)) from None
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        reason = f"{type(error).__name__}: {error}"
        raise InputError(f"is damaged ({' '.join(reason.split())}); run its case once more", source=str(path)) from None


def _run_file(name: str) -> str:
    return f"runs/{file_name(name)}.nc"


def _digest(path: Path) -> str:
    """SHA-256 of a file. A damaged NetCDF file is known by it before a library is given it that may crash on it."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _outcome(outcome: Outcome, folder: Path) -> dict[str, Any]:
    """An outcome with the file of its run in place of the run."""
    beside = {each.name: getattr(outcome, each.name) for each in fields(outcome) if each.name != "run"}
    file = _run_file(outcome.name)
    run = None if outcome.run is None else {"file": file, "sha256": _digest(folder / file)}
    return {"failed": isinstance(outcome, Failure), "run": run, **beside}


def _comparison(content: Mapping[str, Any], folder: Path) -> Comparison:
    return Comparison(
        title=content["title"],
        description=content["description"],
        outcomes=[_outcome_from(each, folder) for each in content["outcomes"]],
        criteria={name: Criterion(**each) for name, each in content["criteria"].items()},
        claims=tuple(Claim(**each) for each in content["claims"]),
        videos=tuple(name for name in content["videos"] if (folder / name).is_file()),
        baseline=content["baseline"],
        descriptions=content["descriptions"],
    )


def _outcome_from(content: Mapping[str, Any], folder: Path) -> Outcome:
    given = dict(content)
    failed, recorded = given.pop("failed"), given.pop("run")
    run = None if recorded is None else _run(folder / recorded["file"], recorded["sha256"])
    if failed:
        return Failure(**given, run=run)
    assert run is not None
    given["numbers"] = {name: Number(**each) for name, each in given["numbers"].items()}
    given["characteristics"] = [_characteristic(each) for each in given["characteristics"]]
    given["modes"] = [_mode(each) for each in given["modes"]]
    given["transfer"] = {
        channel: (np.array(frequency), _complex(ratio)) for channel, (frequency, ratio) in given["transfer"].items()
    }
    return Configuration(**given, run=run)


def _run(path: Path, digest: str) -> Run:
    if path.is_file() and _digest(path) != digest:
        raise InputError("is damaged, or not the run that was saved here; run its case once more", source=str(path))
    return Run.load(path)


def _mode(content: Mapping[str, Any]) -> Mode:
    return Mode(**{**content, "shape": {joint: complex(*parts) for joint, parts in content["shape"].items()}})


def _complex(pairs: list[list[float]]) -> np.ndarray:
    return np.array([complex(*parts) for parts in pairs])


def _characteristic(content: Mapping[str, Any]) -> Characteristic:
    spring, damper, tyre = (content[name] for name in ("component_spring", "component_damper", "tyre"))
    parts = {
        "elements": tuple(ElementNote(**each) for each in content["elements"]),
        "component_spring": spring and ComponentSpring(**_arrays(spring)),
        "component_damper": damper and ComponentDamper(**_arrays(damper)),
        "tyre": tyre and TyreCurves(**{**_arrays(tyre), "friction": tyre["friction"] and tuple(tyre["friction"])}),
    }
    return Characteristic(**_arrays({**content, **dict.fromkeys(parts)}) | parts)


def _arrays(content: Mapping[str, Any]) -> dict[str, Any]:
    """The same with lists as arrays; None in one is not a number."""
    return {name: np.array(each, float) if isinstance(each, list) else each for name, each in content.items()}
