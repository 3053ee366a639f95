"""What a comparison with measurements found, as text for terminal and page."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from ..display import quantity_text, shown
from .findings import Findings, Judgement
from .standards import Allowed

HEADINGS = (
    "channel",
    "error at the peaks",
    "of the larger",
    "of the whole",
    "rms",
    "worst place",
    "s − m",
    "allowed",
    "",
)
FORMULAS = (
    ("s, m", "simulated value, mean of the measurements"),
    (
        "band",
        "|s − m| ≤ offset + gain |m| + along |ds/dx| + t σ/√k, k measurements; over time gain is of the largest |m|",
    ),
    (
        "error at the peaks",
        "smallest and largest |s − m| at the highest and lowest peaks, or at the points, of each one",
    ),
    ("of the larger", "100 |s − m|/|m| at the larger measured peak, largest of all measurements"),
    ("of the whole", "100 max |s − m|/max |m|, both at the same place"),
    ("rms", "√(mean (s − m)²)"),
)
"""Word and formula of every column, for the reader."""


@dataclass(frozen=True)
class Row:
    """A channel's texts, in the order of `HEADINGS`."""

    cells: tuple[str, ...]
    inside: bool


def rows(findings: Findings) -> list[Row]:
    """A row for each channel."""
    return [_row(each, findings.over_unit) for each in findings.judgements]


def _row(each: Judgement, over_unit: str) -> Row:
    errors, at = each.errors, each.worst
    off = each.simulated[at] - each.mean[at]
    return Row(
        (
            each.channel,
            f"{_figure(errors.smallest, errors.unit)} … {_figure(errors.largest, errors.unit)} {_unit(errors.unit)}",
            _percent(errors.of_peak),
            _percent(errors.of_any),
            f"{_figure(errors.rms, each.unit)} {_unit(each.unit)}",
            quantity_text(float(each.abscissa[at]), over_unit),
            f"{_figure(off, each.unit)} {_unit(each.unit)}",
            f"±{_figure(each.half[at], each.unit)} {_unit(each.unit)}",
            "inside" if each.inside else "OUTSIDE",
        ),
        each.inside,
    )


def _figure(value: float, unit: str) -> str:
    """An error in the unit that its channel is shown in, with two significant digits."""
    return f"{float(value) * shown(unit).factor:.2g}".replace("-", "−")


def _unit(unit: str) -> str:
    return shown(unit).unit


def _percent(value: float) -> str:
    return f"{value:.1f} %" if math.isfinite(value) else "–"


def remarks(findings: Findings) -> list[tuple[str, str]]:
    """How it was compared, and what must be known beside it: word and text."""
    said = [("compared by", findings.standard.title), ("compared", _range(findings)), ("filter", findings.filter)]
    for each in findings.shifts:
        how = "as given" if each.correlation is None else f"by correlation, {each.correlation:.4f}"
        text = f"{each.seconds:+.4f} s on its time, {how}" + (f"; {each.note}" if each.note else "")
        said.append((each.measurement, text))
    said += [("attention", note) for note in findings.notes]
    for each in findings.judgements:
        text = "; ".join((tolerance_text(each.allowed, each.unit, findings.over_unit), *each.notes))
        said.append((f"tolerance of {each.channel}", text + _scatter(each)))
    return said


def _range(findings: Findings) -> str:
    """From where to where, and at how many values of the abscissa."""
    abscissa = findings.judgements[0].abscissa
    low, high = (quantity_text(float(each), findings.over_unit) for each in abscissa[[0, -1]])
    return f"{low} to {high} of {findings.over.replace('_', ' ') or 'the run'}, {len(abscissa)} values"


def _scatter(each: Judgement) -> str:
    """What the measurements' own scatter adds to the band."""
    if len(each.measured) < 2:
        return "; one measurement, so no confidence interval"
    share = float(each.confidence[each.worst] / each.half[each.worst]) if each.half[each.worst] > 0 else 0.0
    words = f"; {100 * share:.0f} % of the band at the worst place is confidence interval"
    return words + (": the measurements scatter more than the tolerance allows" if share > 0.5 else "")


def tolerance_text(allowed: Allowed, unit: str, over_unit: str) -> str:
    """A tolerance in words."""
    parts = [
        f"{_figure(allowed.offset, unit)} {_unit(unit)}" if allowed.offset else "",
        f"{100 * allowed.gain:g} %" if allowed.gain else "",
        f"{quantity_text(allowed.along, over_unit)} along" if allowed.along else "",
    ]
    return " + ".join(part for part in parts if part) or "0"


def summary(findings: Findings) -> dict[str, Any]:
    """The same in SI units, for other programs."""
    return {
        "inside": findings.inside,
        "standard": findings.standard.title,
        "over": findings.over or "time",
        "filter": findings.filter,
        "shifts": [vars(each) for each in findings.shifts],
        "notes": findings.notes,
        "channels": [_summary(each) for each in findings.judgements],
    }


def _summary(each: Judgement) -> dict[str, Any]:
    at = each.worst
    return {
        "channel": each.channel,
        "unit": each.unit,
        "inside": each.inside,
        "measurements": len(each.measured),
        "worst": {
            "at": each.abscissa[at],
            "simulated": each.simulated[at],
            "mean": each.mean[at],
            "half_band": each.half[at],
            "confidence": each.confidence[at],
        },
        "errors": vars(each.errors),
        "tolerance": vars(each.allowed),
        "notes": each.notes,
    }
