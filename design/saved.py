"""Results that are saved already: report and film anew, folders side by side, all without simulating."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from evaluation.compare import Comparison
from evaluation.joining import joined
from evaluation.saving import Saved, load, save_beside_runs
from susp_mj.description import validate
from susp_mj.errors import InputError

from .case import Film
from .results import make_video, staged, write_results
from .running import Report


def renew_report(folder: Path) -> Path:
    """Write ``report.html`` anew from what a folder holds; the same results give the same bytes.

    Raises:
        InputError: as `load`; or the folder cannot be written.
    """
    from evaluation.pages.report import write_report

    return write_report(load(folder).comparison, folder / "report.html")


def renew_film(folder: Path, asked: Mapping[str, Any], progress: Report = lambda task, done: None) -> Path:
    """Render ``video.mp4`` from what a folder holds, and put it into the report.

    Args:
        asked: how it is drawn, where that is to be otherwise than before (`Film`).

    Raises:
        InputError: as `load`; a value that is not allowed; nothing to show.
        SuspMjError: the video cannot be made.
    """
    saved = load(folder)
    film = validate(Film, {**saved.film, **asked}, source="video")
    if not saved.comparison.configurations:
        raise InputError("has no run to show", source=str(folder))
    name = make_video(film, saved.comparison, folder, progress)
    comparison = replace(saved.comparison, videos=tuple(dict.fromkeys((*saved.comparison.videos, name))))
    save_beside_runs(Saved(comparison, film.model_dump()), folder)
    renew_report(folder)
    return folder / name


def compare_folders(
    folders: Sequence[Path],
    out: Path,
    *,
    baseline: str = "",
    video: bool = False,
    progress: Report = lambda task, done: None,
) -> Comparison:
    """Put the configurations of several folders side by side and leave results in `out`, as a case does.

    Args:
        baseline: name of the configuration that the others are held against; empty takes the first.

    Raises:
        InputError: as `load` and `joined`; no folder, or one that is given twice or is `out`.
        SuspMjError: the video cannot be made.
    """
    comparison = joined(_loaded(folders, out), baseline)
    film = Film()
    with staged(out) as stage:
        if video:
            comparison = replace(comparison, videos=(make_video(film, comparison, stage, progress),))
        write_results(Saved(comparison, film.model_dump()), stage, {}, progress)
    return comparison


def _loaded(folders: Sequence[Path], out: Path) -> dict[str, Comparison]:
    """What the folders hold, by the label of each."""
    if not folders:
        raise InputError("give one or more folders with results", key="compare")
    places = [folder.resolve() for folder in folders]
    for i, (folder, place) in enumerate(zip(folders, places, strict=True)):
        if place in places[:i]:
            raise InputError("is given twice", source=str(folder))
        if place == out.resolve():
            raise InputError("is one of the folders that are compared; choose another for the results", key="--out")
    return {label: load(folder).comparison for label, folder in zip(_labels(places), folders, strict=True)}


def _labels(places: Sequence[Path]) -> list[str]:
    """The shortest ends of paths that tell them apart."""
    longest = max((len(place.parts) for place in places), default=0)
    for length in range(1, longest + 1):
        labels = ["/".join(place.parts[-length:]) for place in places]
        if len(set(labels)) == len(labels):
            return labels
    return [str(place) for place in places]
