"""Every claim of the thesis beside what comes out, as a page and as JSON, with a film of the zuziehen."""

from __future__ import annotations

from pathlib import Path

from evaluation.reproduction import Part, Reproduction
from susp_mj.errors import SuspMjError
from susp_mj.recording import versions
from susp_mj.run import Run

from ..case import load_case
from ..results import staged
from ..running import Report, prepare, run_case, simulated
from .chapter3 import chapter3_claims
from .dampers import dampers
from .roll import roll
from .runs import CAR
from .steps import steps
from .validation import validation
from .zuziehen import Variation, zuziehen

RESULTS = ("reproduce.json", "reproduce.html", "zuziehen.mp4")
MARKER = RESULTS[0]


def reproduce(progress: Report = lambda task, done: None, workers: int | None = None) -> Reproduction:
    """Run everything that the thesis states, and hold each claim against it."""
    parts = [_chapter3(progress, workers)]
    parts += [part(progress, workers) for part in (validation, steps, roll, zuziehen, dampers)]
    return Reproduction(parts, made={"vehicle": CAR, **dict(versions())})


def _chapter3(progress: Report, workers: int | None) -> Part:
    return Part(
        "Chapter 3: ride and handling compromise", chapter3_claims(run_case(*load_case("chapter3"), progress, workers))
    )


def write(
    out: Path, *, video: bool = False, workers: int | None = None, progress: Report = lambda task, done: None
) -> Reproduction:
    """Reproduce, and leave ``reproduce.html``, ``reproduce.json`` and a film of configurations 3 and 4 in the zuziehen
    in `out`.

    Raises:
        InputError: `out` cannot be written.
        SuspMjError: the film cannot be made; the other results are there.
    """
    from evaluation.pages.reproduction import write_reproduction, write_reproduction_json

    no_film: SuspMjError | None = None
    with staged(out, MARKER, RESULTS) as stage:
        found = reproduce(progress, workers)
        films: list[Path] = []
        if video:
            try:
                films.append(_film(stage / "zuziehen.mp4", progress))
            except SuspMjError as error:
                no_film = error
        write_reproduction(found, stage / "reproduce.html", films)
        write_reproduction_json(found, stage / "reproduce.json")
    if no_film is not None:
        raise no_film
    return found


def _film(path: Path, progress: Report) -> Path:
    """Configurations 3 and 4 in the zuziehen at load full, side by side."""
    from evaluation.animation.clip import Clip
    from evaluation.animation.kinds import kind_of
    from evaluation.animation.render import render_video

    clips = [Clip(f"configuration {number}", _driven(number)) for number in ("3", "4")]
    quality = kind_of(clips).quality
    return render_video(clips, path, quality=quality, progress=lambda done: progress("render film", done))


def _driven(number: str) -> Run:
    _, run = simulated(prepare(Variation("").run(number)))
    if isinstance(run, SuspMjError):
        raise run
    return run
