"""Carrying a cycle out: its state and its results in a folder."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from evaluation.numbers import drives
from evaluation.story import Story
from susp_mj.errors import InputError, SuspMjError
from susp_mj.files import file_name, write_text

from ..results import staged
from ..running import Report
from .candidate import Layout
from .car_file import write_car, write_cases
from .components import write_components
from .cycling import Branch, Heard, Outcome, cycle, kept_of
from .ledger import Ledger
from .targets import Targets
from .telling import story

STATE = "state"
"""Folder in the results that a cycle is resumed from: runs that are done, and branches."""
STATES = ("runs.jsonl", "branches.json")
WRITTEN = ("verdict.html", "verdict.json", "film.mp4", "cases/*.toml", "runs/*.nc", "components/*.csv")
"""Results, but for the car's file, which is called like the car's own."""


def lay_out(
    targets: Targets,
    path: Path,
    out: Path,
    *,
    resume: bool = False,
    branch: Branch | None = None,
    video: bool = False,
    workers: int | None = None,
    heard: Heard = lambda candidate, finding: None,
    progress: Report = lambda task, done: None,
) -> Story:
    """Go through a cycle and leave ``verdict.html``, ``verdict.json``, the car's file with every candidate as a set,
    ``cases/*.toml`` that hold the kept one against its targets again, ``runs/*.nc`` and a film in `out`.

    Every run is kept in ``state/`` as soon as it is done.

    Args:
        resume: take the runs and branches that are there; else the cycle begins anew.
        branch: a further line from an earlier candidate, kept for the next time; asks for `resume`.
        heard: called with each finding as it is made.

    Raises:
        InputError: the targets do not fit the car, nothing is there to resume, or `out` cannot be written.
    """
    layout = Layout.open(targets, path)
    for kind, file in (("targets", path), ("car", layout.file.path)):
        if file.parent.resolve() == out.resolve():
            raise InputError(f"holds the file of the {kind}, which results could replace; choose another", key=str(out))
    state = _state(out, resume=resume or branch is not None)
    before = _read_branches(state)
    branches = before if branch is None or branch in before else [*before, branch]
    _write_branches(state, branches)
    ledger = Ledger(state / "runs.jsonl", path, workers)
    try:
        outcomes = cycle(layout, lambda asked: ledger.ask(asked, progress), heard, branches)
    except InputError:
        _write_branches(state, before)
        raise
    told = story(layout, outcomes, ledger, progress)
    with staged(out, marker="verdict.json", patterns=(*WRITTEN, layout.file.path.name)) as stage:
        no_film = _write(layout, outcomes, told, stage, video=video, progress=progress)
    if no_film is not None:
        raise no_film
    return told


def _state(out: Path, *, resume: bool) -> Path:
    """Folder of the state, empty for a cycle that begins anew."""
    state = out / STATE
    if resume and not (state / "runs.jsonl").is_file():
        raise InputError(f"there is nothing to resume in {out}", key="resume")
    try:
        state.mkdir(parents=True, exist_ok=True)
        if not resume:
            for name in STATES:
                (state / name).unlink(missing_ok=True)
        (state / "runs.jsonl").touch()
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", source=str(out)) from None
    return state


def _read_branches(state: Path) -> list[Branch]:
    file = state / "branches.json"
    if not file.is_file():
        return []
    return [Branch(**each) for each in json.loads(file.read_text(encoding="utf-8"))]


def _write_branches(state: Path, branches: Sequence[Branch]) -> None:
    if branches or (state / "branches.json").exists():
        plain = [{"parent": b.parent, "change": dict(b.change), "because": b.because} for b in branches]
        write_text(state / "branches.json", json.dumps(plain, indent=2, ensure_ascii=False) + "\n")


def _write(
    layout: Layout, outcomes: Sequence[Outcome], told: Story, stage: Path, *, video: bool, progress: Report
) -> SuspMjError | None:
    """Write everything; returns why there is no film, which leaves the other results there."""
    from evaluation.pages.verdict import write_verdict, write_verdict_json

    car = write_car(layout, outcomes, stage)
    kept = kept_of(outcomes)
    if kept is not None:
        write_cases(layout, kept, car, stage / "cases")
        write_components(layout.vehicle(kept.candidate), layout.targets, stage / "components")
    progress("write runs", 0.0)
    for check, places in told.runs.items():
        for place, runs in places.items():
            for name, run in runs.items():
                run.save(stage / "runs" / f"{file_name(f'{check}, {place}, {name}')}.nc")
    progress("write the verdict", 0.0)
    write_verdict_json(told, stage / "verdict.json")
    film, failed = None, None
    if video:
        try:
            film = _film(told, stage / "film.mp4", progress)
        except SuspMjError as error:
            failed = error
    write_verdict(told, stage / "verdict.html", [] if film is None else [film])
    return failed


def _film(told: Story, path: Path, progress: Report) -> Path:
    """Ghost film of the last discarded against the kept candidate on the first check that both drove.

    Raises:
        SuspMjError: it cannot be rendered, or there are no two candidates to show.
    """
    from evaluation.animation.clip import Clip
    from evaluation.animation.kinds import kind_of
    from evaluation.animation.render import render_video

    places = (runs for check in told.runs.values() for runs in check.values())
    driven = next((runs for runs in places if len(runs) == 2 and all(map(drives, runs.values()))), None)
    if driven is None:
        raise InputError("there is nothing to film: no discarded candidate drove what the kept one did", key="--video")
    clips = [Clip(name, run) for name, run in driven.items()]
    return render_video(
        clips,
        path,
        layout="ghost",
        quality=kind_of(clips).quality,
        progress=lambda done: progress("render film", done),
    )
