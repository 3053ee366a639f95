"""Carrying a case out: results, plots, report and video in a folder, all at once or nothing."""

from __future__ import annotations

import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from evaluation.compare import Claim, Comparison
from evaluation.saving import SAVED, Saved, save
from susp_mj.errors import InputError, SuspMjError
from susp_mj.plugins import blamed
from susp_mj.recording import versions

from .case import Case, Film
from .running import Report, run_case


def carry_out(
    case: Case,
    path: Path,
    out: Path,
    *,
    video: bool = False,
    workers: int | None = None,
    claims: Callable[[Comparison], Sequence[Claim]] | None = None,
    progress: Report = lambda task, done: None,
) -> Comparison:
    """Run a case and leave ``summary.json``, ``comparison.json``, ``runs/*.nc``, ``plots/*.svg``, ``report.html`` and a
    video in `out`.

    The folder receives everything at once at the end; after an error it is as it was. Only a video that fails leaves
    the other results there, and its error is raised after them. A run that diverged is kept up to there.

    Args:
        workers: as those of `run_case`.
        claims: published statements to hold against the results.

    Raises:
        InputError: as `run_case`; or `out` cannot be written.
        SuspMjError: the video cannot be made.
    """
    started = time.perf_counter()
    no_video: SuspMjError | None = None
    with staged(out) as stage:
        comparison = run_case(case, path, progress, workers)
        if claims is not None:
            comparison = replace(comparison, claims=tuple(claims(comparison)))
        simulated = time.perf_counter() - started
        if video and comparison.configurations:
            try:
                comparison = replace(comparison, videos=(make_video(case.film, comparison, stage, progress),))
            except SuspMjError as error:
                no_video = error
        write_results(Saved(comparison, case.film.model_dump()), stage, {"simulate_s": round(simulated, 3)}, progress)
    if no_video is not None:
        raise no_video
    return comparison


def make_video(film: Film, comparison: Comparison, folder: Path, progress: Report) -> str:
    """Draw the video of a comparison into a folder; returns the name of the file.

    Raises:
        InputError: runs of several kinds of car, or too many.
        SuspMjError: the video cannot be made.
    """
    from evaluation.animation.clip import Clip
    from evaluation.animation.kinds import kind_of
    from evaluation.animation.render import render_video

    clips = [Clip(each.name, each.run) for each in comparison.configurations]
    how = film.model_dump()
    how["quality"] = how["quality"] or kind_of(clips).quality
    return render_video(clips, folder / "video.mp4", **how, progress=lambda done: progress("render video", done)).name


def write_results(saved: Saved, stage: Path, timings: dict[str, float], progress: Report) -> None:
    """Write all but the video of results into a folder.

    Raises:
        InputError: the folder cannot be written.
    """
    from evaluation.pages.report import write_report
    from evaluation.pages.summary import write_summary
    from evaluation.plots.drawing import draw, save_plots

    started, comparison = time.perf_counter(), saved.comparison
    progress("write results", 0.0)
    save(saved, stage)
    progress("write results", 0.2)
    plots = draw(comparison)
    progress("write results", 0.8)
    save_plots(comparison, stage / "plots", plots)
    write_report(comparison, stage / "report.html", plots=plots)
    timings = {**timings, "report_s": round(time.perf_counter() - started, 3)}
    write_summary(comparison, stage / "summary.json", {"versions": dict(versions()), "timings": timings})
    progress("write results", 1.0)


MARKER = "summary.json"
RESULTS = (MARKER, SAVED, "report.html", "video.mp4", "runs/*.nc", "plots/*.svg")


@contextmanager
def staged(out: Path, marker: str = MARKER, patterns: Sequence[str] = RESULTS) -> Iterator[Path]:
    """A folder to write into; on success its contents replace earlier results in `out`, on any error nothing of it
    remains.

    Args:
        marker: file by which earlier results are known.
        patterns: of their files, which are taken away.

    Raises:
        InputError: `out` cannot be written.
    """
    created: list[Path] = []
    stage: Path | None = None
    try:
        try:
            created = [folder for folder in (out, *out.parents) if not folder.exists()]
            out.mkdir(parents=True, exist_ok=True)
            stage = Path(tempfile.mkdtemp(prefix=".unfinished-", dir=out))
        except OSError as error:
            raise InputError(f"cannot be written: {error.strerror}", source=str(out)) from None
        yield stage
        _clear(out, marker, patterns)
        for item in sorted(stage.rglob("*")):
            if item.is_file():
                target = out / item.relative_to(stage)
                target.parent.mkdir(parents=True, exist_ok=True)
                item.replace(target)
        created = []
    except OSError as error:
        if blamed(error):
            raise
        raise InputError(f"cannot be written: {error.strerror or error}", source=str(out)) from None
    finally:
        if stage is not None:
            shutil.rmtree(stage, ignore_errors=True)
        for folder in created:
            if folder.is_dir() and not any(folder.iterdir()):
                folder.rmdir()


def _clear(out: Path, marker: str, patterns: Sequence[str]) -> None:
    """Take the results of an earlier run away, and nothing else."""
    if (out / marker).is_file():
        for pattern in patterns:
            for file in out.glob(pattern):
                file.unlink()
