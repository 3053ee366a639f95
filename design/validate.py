"""Holding measurements against a run of a case: `susp-mj validate`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from evaluation.validation import Findings, Validation, judge
from susp_mj.description import validate
from susp_mj.errors import InputError, SimulationError, choices
from susp_mj.signals import read_signals
from vehicles.reading import read_toml

from .case import Case
from .results import staged
from .running import Job, Report, jobs_of, prepare, simulated


@dataclass(frozen=True)
class Asked:
    """One configuration to hold measurements against, and how."""

    title: str
    job: Job
    settings: Validation
    source: str


def asked(case: Case, path: Path, mapping: Path | None = None, configuration: str | None = None) -> Asked:
    """What a command line asks for.

    Args:
        path: the case file.
        mapping: a file with the table ``[validation]``; None takes the case's.
        configuration: name of one; None takes the only one.

    Raises:
        InputError: no such configuration, several and none named, or a mapping that is wrong.
    """
    jobs = {job.setting.name: job for job in jobs_of(case, path)}
    if configuration is None and len(jobs) > 1:
        raise InputError(f"{path.name} has several; {choices(jobs)}", key="--configuration")
    name = next(iter(jobs)) if configuration is None else configuration
    if name not in jobs:
        raise InputError(f"no configuration '{name}'; {choices(jobs, name)}", key="--configuration")
    settings, source = case.validation, path.name
    if mapping is not None:
        tables = read_toml(mapping)
        settings, source = validate(Validation, tables.get("validation", tables), source=mapping.name), mapping.name
    return Asked(f"{case.title}: {name}", jobs[name], settings, source)


def validated(
    what: Asked, measurements: Sequence[Path], out: Path, progress: Report = lambda task, done: None
) -> Findings:
    """Simulate a configuration, judge it by measurements and leave page, numbers, run and plots in `out`.

    Raises:
        InputError: a measurement cannot be read, lacks a column or does not suit the run; or `out` cannot be written.
        SimulationError: there is no run to the end.
    """
    read = [read_signals(each) for each in measurements]
    prepared, run = simulated(prepare(what.job), lambda done: progress(f"simulate {what.job.setting.name}", done))
    if isinstance(run, SimulationError):
        raise run
    try:
        findings = judge(run, read, what.settings)
    except InputError as error:
        raise _in_file(error, what.source) from None
    facts = {"run": prepared.title, **prepared.facts, "measurements": ", ".join(each.source for each in read)}
    with staged(out) as stage:
        _write(what.title, facts, findings, stage)
        run.save(stage / "run.nc")
    return findings


def _in_file(error: InputError, source: str) -> InputError:
    """An error of the settings, with the file and the table that hold them."""
    if error.source not in ("validation", "run", ""):
        return error
    key = ".".join(part for part in ("validation", error.key) if part)
    return InputError(error.message, key=key, source=source)


def _write(title: str, facts: dict[str, str], findings: Findings, stage: Path) -> None:
    from evaluation.pages.summary import write_json
    from evaluation.pages.validation import write_validation
    from evaluation.plots.validation import validation_plots
    from evaluation.validation.table import summary
    from susp_mj.files import write_text

    plots = validation_plots(findings)
    for name, svg in plots.items():
        write_text(stage / "plots" / f"{name}.svg", svg)
    write_validation(title, facts, findings, plots, stage / "validation.html")
    write_json({"title": title, **facts, **summary(findings)}, stage / "validation.json")
