"""Tables for the terminal: comparisons, claims, characteristic sheets, what there is."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from evaluation.display import quantity_text
from evaluation.numbers.number import Number, Verdict

if TYPE_CHECKING:
    from evaluation.characteristics import Characteristic
    from evaluation.compare import Claim, Comparison
    from evaluation.reproduction import Reproduction
    from evaluation.story import Finding, Story
    from evaluation.validation import Findings
    from susp_mj.linear import Linear, Mode
    from vehicles.reading import VehicleFile


def print_comparison(comparison: Comparison) -> None:
    """Numbers of all configurations side by side; failed criteria in red."""
    table = Table(title=comparison.title, box=SIMPLE_HEAD, title_justify="left")
    table.add_column("number")
    for each in comparison.configurations:
        table.add_column(each.name, justify="right")
    verdicts = [comparison.verdicts(each) for each in comparison.configurations]
    for name in dict.fromkeys(name for each in comparison.configurations for name in each.numbers):
        cells = [
            _cell(each.numbers.get(name), found.get(name))
            for each, found in zip(comparison.configurations, verdicts, strict=True)
        ]
        table.add_row(name, *cells)
    console = _console()
    if comparison.configurations:
        console.print(table)
    _print_differences(comparison, console)
    _print_turning(comparison, console)
    for each, found in zip(comparison.configurations, verdicts, strict=True):
        failed = [_missed(name, verdict) for name, verdict in found.items() if not verdict.passed]
        if found:
            console.print(f"{each.name}: " + (f"fails {', '.join(failed)}" if failed else "meets all criteria"))
    for each in comparison.configurations:
        for note in each.run.meta.get("notes", ()):
            console.print(Text(f"{each.name}: {note}", "dim"))
    for each in comparison.failures:
        console.print(Text(f"{each.name}: no run, {each.reason}", "bold red"))


def _print_differences(comparison: Comparison, console: Console) -> None:
    """Numbers of the others less those of the baseline, in per cent of these."""
    found = {
        each.name: differences for each in comparison.configurations if (differences := comparison.differences(each))
    }
    if not found:
        return
    console.print(Text(comparison.description))
    table = Table(title=f"Difference to {comparison.baseline}", box=SIMPLE_HEAD, title_justify="left")
    table.add_column("number")
    for name in found:
        table.add_column(Text(name), justify="right")
    for number in comparison.differing():
        texts = [differences[number].text if number in differences else "–" for differences in found.values()]
        table.add_row(number, *texts)
    console.print(table)


def _print_turning(comparison: Comparison, console: Console) -> None:
    """Roll and wheel lift of cars that turn."""
    from evaluation.turning import turning_table

    turning = turning_table(comparison)
    if turning is None:
        return
    table = Table(title="Roll and wheel lift", box=SIMPLE_HEAD, title_justify="left")
    table.add_column("")
    for name in turning.names:
        table.add_column(Text(name), justify="right")
    for row in turning.rows:
        table.add_row(*row)
    console.print(table)


def print_findings(findings: Findings, title: str) -> None:
    """What a comparison with measurements found, a row for each channel."""
    from evaluation.validation.table import HEADINGS, remarks, rows

    table = Table(title=f"{title}, beside measurements", box=SIMPLE_HEAD, title_justify="left")
    for heading in HEADINGS:
        table.add_column(heading, justify="left" if heading in ("channel", "") else "right")
    for row in rows(findings):
        *cells, word = row.cells
        table.add_row(*cells, Text(word, "green" if row.inside else "bold red"))
    console = _console()
    console.print(table)
    for word, text in remarks(findings):
        console.print(Text(f"{word}: {text}"))


class CyclePrinter:
    """Tells a design cycle while it goes on: each candidate, and every step with formula, inputs, result and
    verdict."""

    def __init__(self) -> None:
        self._last, self._console = "", _console()

    def __call__(self, name: str, because: str, finding: Finding) -> None:
        """One finding of a candidate."""
        if name != self._last:
            self._last = name
            self._console.print(Text(f"\n{name}: {because}", "bold"))
        mark = Text("  ok  ", "green") if finding.passed else Text("  NO  ", "bold red")
        result = quantity_text(finding.value, finding.unit) + (f" ({finding.note})" if finding.note else "")
        asked = f", asked is {finding.band}" if finding.band else ""
        line = [mark, f"{finding.key}: {result}{asked}"]
        if finding.assumed:
            line.append(" by default")
        inputs = ", ".join(f"{key} = {text}" for key, text in finding.inputs.items())
        source = "; ".join(part for part in (finding.formula, inputs) if part)
        self._console.print(Text.assemble(*line, (f"  [{source}]" if source else "", "dim")))


def print_story(story: Story) -> None:
    """How a cycle ended: candidates and reasons, what moves what was missed, the kept knobs, the verdict."""
    console = _console()
    for attempt in story.attempts:
        console.print(Text(f"\n{attempt.name}: {'kept' if attempt.kept else 'discarded'}", "bold"), end="")
        console.print(Text("" if attempt.kept else f", {attempt.reason}"))
        for each in attempt.influences:
            also = "; ".join(f"{key} {_signed(*moved)}" for key, moved in each.also.items())
            words = f"  {each.knob} {each.change}: {each.target} {_signed(each.moved, each.unit)}"
            console.print(Text(words + (f"; {also}" if also else ""), "dim"))
    if story.kept is not None:
        table = Table(title=f"Kept: {story.kept.name}", box=SIMPLE_HEAD, title_justify="left")
        table.add_column("knob")
        table.add_column("value", justify="right")
        for knob, (value, unit) in story.kept.values.items():
            table.add_row(knob, value if isinstance(value, str) else quantity_text(value, unit))
        console.print(table)
    for trade in story.trade_offs:
        values = ", ".join(
            f"{ratio}: {quantity_text(value, trade.unit)}"
            for ratio, value in zip(trade.ratios, trade.values, strict=True)
        )
        console.print(Text(f"{trade.title}, over compression:rebound: {values}"))
    for note in story.notes:
        console.print(Text(note, "dim"))
    console.print(Text(f"\n{story.verdict}", "bold green" if story.kept is not None else "bold red"))


def _signed(value: float, unit: str) -> str:
    text = quantity_text(value, unit)
    return text if text.startswith("−") else f"+{text}"


def print_claims(title: str, claims: Sequence[Claim]) -> None:
    """Published claims beside results, with the reasons below."""
    table = Table(title=title, box=SIMPLE_HEAD, title_justify="left")
    for column in ("claim", "source", "thesis", "here", ""):
        table.add_column(column)
    for claim in claims:
        style = "green" if claim.holds else "yellow" if claim.known else "bold red"
        texts = (claim.text, claim.source, claim.expected, claim.result)
        table.add_row(*(Text(each) for each in texts), Text(claim.verdict, style))
        if claim.why:
            table.add_row("", "", "", Text(claim.why, "dim"), "")
    _console().print(table)


def print_reproduction(reproduction: Reproduction) -> None:
    """Every claim beside its result, the tables beside them, the verdict."""
    console = _console()
    for part in reproduction.parts:
        print_claims(part.title, part.claims)
        for each in part.tables:
            table = Table(title=each.title, box=SIMPLE_HEAD, title_justify="left")
            for name in each.columns:
                table.add_column(name)
            for row in each.rows:
                table.add_row(*(Text(text) for text in row))
            console.print(table)
            console.print(Text(each.note, "dim"))
    console.print(Text(reproduction.verdict, "bold green" if reproduction.passed else "bold red"))


def print_sheet(car: VehicleFile) -> None:
    """Key values of every set of characteristics of a car."""
    table = Table(title=f"Characteristics of {car.name}, effective at the wheel", box=SIMPLE_HEAD, title_justify="left")
    headings = (
        "set",
        "axle",
        "preload",
        "rate at KO",
        "frequency at KO",
        "travel",
        "damper at ±0.1 m/s",
        "at ±0.5 m/s",
    )
    for column in headings:
        table.add_column(column, justify="left" if column in ("set", "axle") else "right")
    for label, curves in _sets(car).items():
        for i, curve in enumerate(curves):
            table.add_row("" if i else label, curve.title, *_key_values(curve))
    _console().print(table)


def write_car_sheet(car: VehicleFile, path: Path) -> None:
    """Write the characteristic sheet of a car as one HTML file."""
    from evaluation.pages.sheet import write_sheet

    write_sheet(f"Characteristics of {car.title}", _sets(car), path, {"vehicle": car.path.name})


def _sets(car: VehicleFile) -> dict[str, Sequence[Characteristic]]:
    from evaluation.characteristics import characteristic

    result: dict[str, Sequence[Characteristic]] = {}
    for name in car.sets or [None]:
        vehicle = car.vehicle(name)
        axles = [axle for axle in ("front", "rear") if getattr(vehicle, axle) is not None]
        result[name or vehicle.name] = [characteristic(f"{axle} axle", vehicle.axle(axle)) for axle in axles]
    return result


def _key_values(curve: Characteristic) -> list[str]:
    import numpy as np

    def at(x: float, axis: Sequence[float], values: Sequence[float]) -> float:
        return float(np.interp(x, axis, values))

    rate = at(0.0, curve.deflection, curve.spring_rate)
    force = [[at(sign * v, curve.speed, curve.damper_force) for sign in (1, -1)] for v in (0.1, 0.5)]
    frequency = (rate * 9.81 / curve.preload) ** 0.5 / (2 * np.pi)
    travel = curve.deflection[np.isfinite(curve.spring_rate)][[0, -1]]
    return [
        quantity_text(curve.preload, "N"),
        quantity_text(rate, "N/m"),
        quantity_text(frequency, "Hz"),
        f"{1000 * travel[0]:.0f} … {1000 * travel[1]:.0f} mm",
        *(f"{c:.0f} / {r:.0f} N" for c, r in force),
    ]


def print_modes(linear: Linear, title: str) -> None:
    """Modes of a linearised car: frequency, damping ratio, the joints that move."""
    table = Table(title=f"Modes: {title}", box=SIMPLE_HEAD, title_justify="left")
    for column in ("frequency", "damping ratio", "shape (largest = 1, phase where it is not 0 or 180°)"):
        table.add_column(column, justify="left" if column.startswith("shape") else "right")
    for mode in linear.modes():
        if mode.oscillates:
            table.add_row(f"{mode.frequency:.3f} Hz", f"{mode.damping:.3f}", _shape(mode))
    _console().print(table)


def _shape(mode: Mode) -> str:
    """Joints of a mode that move at least 5 % of the largest, with sign or phase."""
    words = []
    for joint, amplitude in mode.shape.items():
        size, phase = abs(amplitude), math.degrees(cmath.phase(amplitude))
        if size < 0.05:
            continue
        if abs(phase) < 10 or abs(phase) > 170:
            words.append(f"{joint} {math.copysign(size, amplitude.real):+.2f}")
        else:
            words.append(f"{joint} {size:.2f} ∠{phase:.0f}°")
    return ", ".join(words)


def print_lists(cycles: Mapping[str, str]) -> None:
    """Everything there is to choose from; `cycles` are names and titles of the targets files."""
    from evaluation.numbers import NUMBERS
    from manoeuvres import MANOEUVRES
    from susp_mj.elements import DAMPERS, SPRINGS, TYRES
    from vehicles.models import MODELS
    from vehicles.reading import VehicleFile, available_vehicles

    from .case import available_cases

    cars = {name: ", ".join(VehicleFile.open(name).sets) for name in available_vehicles()}
    first_lines = {
        name: _first_line(kind) + (f" ({kind.german})" if kind.german else "") for name, kind in MANOEUVRES.items()
    }
    _print_pairs("Cars and their sets of characteristics", cars)
    _print_pairs("Models", MODELS)
    _print_pairs("Manoeuvres (German name)", first_lines)
    _print_matrix()
    _print_pairs("Cases", {name: _case_title(name) for name in available_cases()})
    _print_pairs("Targets of a design cycle", dict(cycles))
    _print_pairs("Elements", {"springs": ", ".join(SPRINGS), "dampers": ", ".join(DAMPERS), "tyres": ", ".join(TYRES)})
    _print_pairs("Evaluation numbers", {name: each.description.replace("`", "") for name, each in NUMBERS.items()})


def _print_matrix() -> None:
    """Which manoeuvre runs on which model: it drives inputs that the model has, on the rig that it needs."""
    from manoeuvres import MANOEUVRES
    from vehicles.models import MODELS

    table = Table(title="Manoeuvre x model", box=SIMPLE_HEAD, title_justify="left", title_style="bold")
    table.add_column("")
    rigs = {manoeuvre.rig for manoeuvre in MANOEUVRES.values()}
    offered = {model: {rig: _inputs(model, rig) for rig in rigs} for model in MODELS}
    for model in MODELS:
        table.add_column(model, justify="center")
    for name, manoeuvre in MANOEUVRES.items():
        table.add_row(name, *("x" if set(manoeuvre.needs) <= offered[model][manoeuvre.rig] else "" for model in MODELS))
    _console().print(table)


def _inputs(model: str, rig: str | None) -> set[str]:
    """Quantities of the inputs of a model on a rig; none if it has no such rig."""
    from susp_mj.errors import InputError
    from vehicles.mjcf import build
    from vehicles.reading import load_vehicle

    try:
        return {place.quantity for place in build(load_vehicle("s_class"), model, rig=rig).meaning.inputs}
    except InputError:
        return set()


def _case_title(name: str) -> str:
    from .case import load_case

    return load_case(name)[0].title


def _print_pairs(title: str, pairs: dict[str, str]) -> None:
    table = Table(title=title, box=None, show_header=False, title_justify="left", title_style="bold", pad_edge=False)
    for name, text in pairs.items():
        table.add_row(name, Text(text))
    console = _console()
    console.print(table)
    console.print()


def _first_line(thing: object) -> str:
    return (thing.__doc__ or "").split("\n")[0].replace("``", "")


def _cell(number: Number | None, verdict: Verdict | None) -> Text:
    if number is None:
        return Text("–")
    style = "" if verdict is None else "green" if verdict.passed else "bold red"
    return Text(quantity_text(number.value, number.unit), style)


def _missed(name: str, verdict: Verdict) -> str:
    return f"{name} ({quantity_text(verdict.number.value, verdict.number.unit)}, allowed {verdict.band})"


def _console() -> Console:
    """Colour on a terminal only; wide enough for a table when piped."""
    console = Console(highlight=False, markup=False)
    return console if console.is_terminal else Console(highlight=False, markup=False, width=160)
