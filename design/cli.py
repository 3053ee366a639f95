"""The command line: `susp-mj`. Exit codes: 0 done, 1 a configuration without a run, criteria or claims not met, a run
outside of what was measured, 2 bad input."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from evaluation.animation.cameras import offered
from susp_mj.errors import InputError, SuspMjError
from susp_mj.hiding import explained
from susp_mj.plugins import blamed

if TYPE_CHECKING:
    from .case import Case
    from .cycle.cycling import Branch
    from .running import Report

app = typer.Typer(
    help="Lay out vehicle springs, dampers and anti-roll bars: simulate, evaluate, compare, animate.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

Out = Annotated[Path, typer.Option("--out", "-o", help="Folder for the results; made if it is not there.")]
Video = Annotated[
    bool, typer.Option("--video", help="Also render an animation (needs EGL and ffmpeg, see 'susp-mj doctor').")
]
Camera = Annotated[str | None, typer.Option(help=f"Of a driving car: {offered()}.")]
Ghost = Annotated[bool, typer.Option("--ghost", help="Two driving cars in one scene, the second translucent.")]
Fine = Annotated[bool, typer.Option("--fine", help="Finer pictures of driving cars, in about half again the time.")]
Workers = Annotated[
    int | None, typer.Option("--workers", help="Configurations at a time; default: as many as there are cores.")
]
Characteristics = Annotated[
    str | None, typer.Option("--characteristics", "-c", help="Which of the car's sets of characteristics.")
]
Load = Annotated[str | None, typer.Option("--load", help="Load case; default: the design position.")]
Axle = Annotated[str | None, typer.Option("--axle", help="front or rear, for models of one axle.")]


@app.command()
def demo(
    out: Out = Path("out/demo"), video: Annotated[bool, typer.Option(help="Render the animation.")] = True
) -> None:
    """Reproduce chapter 3 of the thesis: claims beside results, report and video."""
    from .case import load_case
    from .claims.chapter3 import chapter3_claims
    from .results import carry_out
    from .terminal import print_claims, print_comparison

    case, path = load_case("chapter3")
    with _progress() as progress:
        comparison = carry_out(
            case, path, out, video=video and _can_make_video(), claims=chapter3_claims, progress=progress
        )
    print_comparison(comparison)
    print_claims("Claims of chapter 3", comparison.claims)
    _say_where(out)
    if not all(claim.holds for claim in comparison.claims):
        raise typer.Exit(1)


@app.command()
def reproduce(
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder for the results; made if it is not there.")] = Path(
        "out/reproduce"
    ),
    video: Annotated[bool, typer.Option(help="Film the zuziehen of configurations 3 and 4.")] = True,
    workers: Workers = None,
) -> None:
    """Hold every claim of the thesis against what comes out; 1 if one does not agree that is not known not to."""
    from .claims.reproducing import write
    from .terminal import print_reproduction

    _without_log()
    with _progress() as progress:
        found = write(out, video=video and _can_make_video(), workers=workers, progress=progress)
    print_reproduction(found)
    typer.echo(f"results in {out}: reproduce.html, reproduce.json")
    if not found.passed:
        raise typer.Exit(1)


@app.command()
def run(
    case: Annotated[str, typer.Argument(help="Case file, or the name of a shipped case ('susp-mj list').")],
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for the results; default out/CASE.")] = None,
    video: Video = False,
    camera: Camera = None,
    ghost: Ghost = False,
    fine: Fine = False,
    strict: Annotated[bool, typer.Option("--strict", help="Exit with 1 if a criterion is not met.")] = False,
    workers: Workers = None,
) -> None:
    """Run a case file: simulate every configuration, evaluate, compare, report."""
    from .case import load_case, with_film

    loaded, path = load_case(case)
    loaded = with_film(loaded, camera, ghost=ghost, fine=fine)
    _run(loaded, path, out or Path("out") / path.stem, video=video, strict=strict, workers=workers)


@app.command()
def validate(
    case: Annotated[str, typer.Argument(help="Case file, or the name of a shipped case ('susp-mj list').")],
    measurement: Annotated[
        list[Path], typer.Argument(help="CSV with units, NetCDF or MDF4; several are several test runs.")
    ],
    mapping: Annotated[
        Path | None, typer.Option("--map", help="TOML file with the table [validation], instead of the case's.")
    ] = None,
    configuration: Annotated[
        str | None, typer.Option("--configuration", "-c", help="Which of the case's; default its only one.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Folder for the results; default out/CASE_validation.")
    ] = None,
) -> None:
    """Hold measurements against a run: errors, band of tolerance, inside (exit code 0) or outside (1)."""
    from .case import load_case
    from .terminal import print_findings
    from .validate import asked, validated

    loaded, path = load_case(case)
    folder = out or Path("out") / f"{path.stem}_validation"
    with _progress() as progress:
        findings = validated(asked(loaded, path, mapping, configuration), measurement, folder, progress)
    print_findings(findings, loaded.title)
    typer.echo(f"results in {folder}: validation.html, validation.json, run.nc, plots/")
    if not findings.inside:
        raise typer.Exit(1)


@app.command()
def design(
    targets: Annotated[str, typer.Argument(help="Targets file, or the name of a shipped one ('susp-mj list').")],
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Results; default out/TARGETS.")] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Go on with the runs that are in the folder.")] = False,
    branch: Annotated[
        str | None, typer.Option("--from", help="Go on from this candidate of the folder, with --change.")
    ] = None,
    change: Annotated[
        list[str] | None, typer.Option("--change", help="KNOB=VALUE for --from, e.g. front.rebound_rate='32 N/mm'.")
    ] = None,
    video: Annotated[
        bool, typer.Option("--video", help="Also film the last discarded car as a ghost beside the kept one.")
    ] = False,
    workers: Workers = None,
) -> None:
    """Lay out springs, dampers and bars from targets: candidates, reasons, repairs, verdict."""
    from .cycle.output import lay_out
    from .cycle.targets import load_targets
    from .terminal import CyclePrinter, print_story

    loaded, path = load_targets(targets)
    if video:
        _require_video()
    _without_log()
    printer, folder = CyclePrinter(), out or Path("out") / path.stem
    with _progress() as progress:
        story = lay_out(
            loaded,
            path,
            folder,
            resume=resume,
            branch=_branch(branch, change or []),
            video=video,
            workers=workers,
            heard=lambda candidate, finding: printer(candidate.name, candidate.because, finding),
            progress=progress,
        )
    print_story(story)
    typer.echo(f"results in {folder}: verdict.html, verdict.json, {story.made['vehicle']}, cases/, runs/")
    if story.kept is None:
        raise typer.Exit(1)


def _branch(parent: str | None, changes: Sequence[str]) -> Branch | None:
    """A branch as the command line asks for it."""
    from .cycle.cycling import Branch
    from .cycle.targets import knobs_from_texts

    if parent is None:
        if changes:
            raise InputError("needs --from, the candidate that is changed", key="--change")
        return None
    return Branch(parent, knobs_from_texts(changes))


@app.command(context_settings={"allow_extra_args": True, "ignore_unknown_options": True, "help_option_names": []})
def drive(
    context: typer.Context, manoeuvre: Annotated[str, typer.Argument(help="Manoeuvre, see 'susp-mj list'.")]
) -> None:
    """Drive one manoeuvre on named configurations: susp-mj drive bump --help."""
    _drive(manoeuvre, context.args)


@app.command()
def compare(
    folders: Annotated[
        list[Path] | None, typer.Argument(help="Folders with results of 'run', 'drive' or 'compare'.")
    ] = None,
    baseline: Annotated[
        str, typer.Option(help="Configuration that the others are held against; default: the first.")
    ] = "",
    out: Out = Path("out/compare"),
    video: Video = False,
) -> None:
    """Put results side by side without simulating: numbers in % of a baseline, criteria, plots on one axis."""
    from .saved import compare_folders
    from .terminal import print_comparison

    with _progress() as progress:
        comparison = compare_folders(folders or (), out, baseline=baseline, video=video, progress=progress)
    print_comparison(comparison)
    _say_where(out)


@app.command()
def report(folder: Annotated[Path, typer.Argument(help="Folder with results.")]) -> None:
    """Write report.html anew from saved results, without simulating."""
    from .saved import renew_report

    typer.echo(f"report: {renew_report(folder)}")


@app.command()
def film(
    folder: Annotated[Path, typer.Argument(help="Folder with results.")],
    camera: Camera = None,
    ghost: Ghost = False,
    fine: Fine = False,
    plugin: Annotated[list[Path] | None, typer.Option(help="Python file that brings a camera, repeatable.")] = None,
) -> None:
    """Render the film of saved results, without simulating, and put it into their report."""
    from susp_mj.plugins import load_installed, load_plugin

    from .case import film_asked
    from .saved import renew_film

    load_installed()
    for each in plugin or ():
        load_plugin(each)
    with _progress() as progress:
        path = renew_film(folder, film_asked(camera, ghost=ghost, fine=fine), progress)
    typer.echo(f"film: {path}")


@app.command()
def show(
    car: Annotated[str, typer.Argument(help="Shipped car or vehicle file.")],
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Also write the characteristic sheet to this HTML file.")
    ] = None,
) -> None:
    """Show a car's characteristics: key values here, curves in the sheet."""
    from vehicles.reading import VehicleFile

    from .terminal import print_sheet, write_car_sheet

    file = VehicleFile.open(car)
    print_sheet(file)
    if out is not None:
        write_car_sheet(file, out)
        typer.echo(f"sheet: {out}")


@app.command()
def build(
    car: Annotated[str, typer.Argument(help="Shipped car or vehicle file.")],
    model: Annotated[str, typer.Option("--model", "-m", help="Topology, see 'susp-mj list'.")],
    characteristics: Characteristics = None,
    load: Load = None,
    axle: Axle = None,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="File to write; default CAR_MODEL.xml.")] = None,
) -> None:
    """Write a model as a self-contained MJCF file."""
    from vehicles.mjcf import write
    from vehicles.reading import load_vehicle
    from vehicles.vehicle import DESIGN_LOAD

    load = DESIGN_LOAD if load is None else load
    vehicle = load_vehicle(car, characteristics)
    folder = Path("vehicles/mjcf") if Path("vehicles/mjcf").is_dir() else Path()
    typer.echo(write(vehicle, model, out or folder / f"{vehicle.name}_{model}.xml", load, axle))


@app.command()
def modes(
    car: Annotated[str, typer.Argument(help="Shipped car or vehicle file.")],
    model: Annotated[str, typer.Option("--model", "-m", help="Topology, see 'susp-mj list'.")] = "full_7dof",
    characteristics: Characteristics = None,
    load: Load = None,
    axle: Axle = None,
) -> None:
    """Natural frequencies, damping ratios and mode shapes at static equilibrium, friction left out."""
    from susp_mj.linear import linearise
    from vehicles.mjcf import build
    from vehicles.reading import load_vehicle
    from vehicles.vehicle import DESIGN_LOAD

    from .terminal import print_modes

    load = DESIGN_LOAD if load is None else load
    vehicle = load_vehicle(car, characteristics)
    title = ", ".join(part for part in (vehicle.title, vehicle.characteristics, model, f"load {load}") if part)
    print_modes(linearise(build(vehicle.without_friction(), model, load, axle)), title)


@app.command("list")
def list_() -> None:
    """List cars, models, manoeuvres, cases, elements and evaluation numbers."""
    from susp_mj.plugins import load_installed

    from .cycle.targets import available_cycles, load_targets
    from .terminal import print_lists

    load_installed()
    print_lists({name: load_targets(name)[0].title for name in available_cycles()})


@app.command()
def new(car: Annotated[str, typer.Argument(help="Name of the car; writes CAR.toml here.")]) -> None:
    """Start a vehicle file of your own from a commented template."""
    path = Path(car if car.endswith(".toml") else f"{car}.toml")
    template = Path(__file__).parent / "templates" / "vehicle.toml"
    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(template.read_text(encoding="utf-8"))
    except FileExistsError:
        raise InputError("exists already; choose another name", source=str(path)) from None
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", source=str(path)) from None
    typer.echo(f"{path}: edit it, then: susp-mj show {path}")


@app.command()
def doctor() -> None:
    """Check what susp_mj needs on this machine, with the fix for what is missing."""
    from .doctor import examine

    findings = examine()
    for finding in findings:
        mark = typer.style("ok  ", fg="green") if finding.fix is None else typer.style("FIX ", fg="red")
        typer.echo(f"{mark}{finding.name}: {finding.found}" + ("" if finding.fix is None else f"\n    {finding.fix}"))
    if any(finding.fix is not None for finding in findings):
        raise typer.Exit(1)


def manoeuvre_script(kind: str) -> None:
    """Foot of a manoeuvre module: run it as a script on configurations named on its command line."""
    _guarded(lambda: _drive(kind, sys.argv[1:]))


def main() -> None:
    """Entry point of `susp-mj`."""
    _guarded(app)


def _drive(manoeuvre: str, arguments: Sequence[str]) -> None:
    from .blame import on_command_line
    from .script import case_from_arguments

    try:
        asked = case_from_arguments(manoeuvre, arguments)
        _run(asked.case, asked.path, asked.out, video=asked.video, workers=asked.workers)
    except InputError as error:
        raise on_command_line(error) from None


def _run(case: Case, path: Path, out: Path, *, video: bool, strict: bool = False, workers: int | None = None) -> None:
    from .results import carry_out
    from .terminal import print_comparison

    _without_log()
    if video:
        _require_video()
    with _progress() as progress:
        comparison = carry_out(case, path, out, video=video, workers=workers, progress=progress)
    print_comparison(comparison)
    _say_where(out)
    if comparison.failures or (strict and not comparison.passed):
        raise typer.Exit(1)


def _without_log() -> None:
    """Else MuJoCo writes a file MUJOCO_LOG.TXT into this folder; what it says ends a run in one line."""
    import mujoco

    mujoco.set_mju_user_warning(lambda _: None)


def _guarded(command: Callable[[], object]) -> None:
    """Run a command; an error whose reason is known becomes one line and exit code 2, never a traceback.

    MuJoCo cannot be imported under a MUJOCO_GL that does not work, and only rendering needs it: it is kept for that.
    """
    os.environ.setdefault("SUSP_MJ_GL", os.environ.pop("MUJOCO_GL", ""))
    os.environ.pop("MPLBACKEND", None)  # plots choose their own
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    try:
        command()
    except typer.Exit as leave:
        sys.exit(leave.exit_code)
    except KeyboardInterrupt:
        typer.echo("stopped", err=True)
        sys.exit(130)
    except BrokenPipeError:
        sys.stderr.close()
        sys.exit(0)
    except (Exception, SystemExit) as error:
        reason = _reason(error)
        if reason is None:
            raise
        typer.echo(f"{typer.style('error:', fg='red')} {reason}", err=True)
        sys.exit(2)


def _reason(error: BaseException) -> str | None:
    """What an error says to the user, in one line; None of one that only tells us something."""
    reason = blamed(error) or explained(error)
    if reason is None and isinstance(error, OSError):
        return error.strerror or str(error)
    return str(error) if reason is None and isinstance(error, SuspMjError) else reason


@contextmanager
def _progress() -> Iterator[Report]:
    """A progress bar on a terminal, silence elsewhere."""
    if not sys.stderr.isatty():
        yield lambda task, done: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (
        TextColumn("{task.description:<24}"),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f} %"),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda name, done: bar.update(task, description=name, completed=done)


def _can_make_video() -> bool:
    """Whether a video can be made here; says what to install if not."""
    reason = _video_obstacle()
    if reason is not None:
        typer.echo(f"no video: {reason}", err=True)
    return reason is None


def _require_video() -> None:
    reason = _video_obstacle()
    if reason is not None:
        raise InputError(reason, key="--video")


def _video_obstacle() -> str | None:
    from evaluation.animation.render import can_render

    return can_render()


def _say_where(out: Path) -> None:
    written = [name for name in ("plots/", "runs/", "video.mp4") if (out / name).exists()]
    typer.echo(f"results in {out}: {', '.join(('report.html', 'summary.json', *written))}")


if __name__ == "__main__":
    main()
