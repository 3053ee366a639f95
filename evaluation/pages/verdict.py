"""The page and the file of a design cycle: what was tried, held against the targets, discarded and kept."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

from susp_mj.files import write_text

from ..display import quantity_text
from ..plots.candidates import Cast, Plot
from ..plots.cycle import characteristic_plots, trade_off_plots
from ..plots.cycle_runs import run_plots
from ..story import Attempt, Finding, Story
from .effects import change_text, influence_row, knob_words, known_bands
from .page import figure_of, page_colours, templates, video_of
from .summary import write_json

_MANY = 8
"""With more candidates than these, paper shows signs without values; the values stand with each candidate."""
_NO_BAND = "any value"


def write_verdict(story: Story, path: str | Path, videos: Sequence[str | Path] = ()) -> Path:
    """Write the story of a design cycle as one self-contained HTML page.

    Args:
        path: of the page; it appears complete or not at all.
        videos: video files, put inside or linked.

    Raises:
        InputError: the place cannot be written, or a video cannot be read.
    """
    path, cast = Path(path), Cast.of(story)
    page = (
        templates()
        .get_template("verdict.html.j2")
        .render(
            title=story.title,
            description=story.description,
            colours=page_colours(),
            verdict=story.verdict,
            kept=None if story.kept is None else {"name": story.kept.name, **_knob_table(story.kept)},
            vehicle=story.vehicle,
            made=story.made,
            notes=story.notes,
            columns=[_heading(story, cast, each) for each in story.attempts],
            many=len(story.attempts) > _MANY,
            groups=list(_groups(story)),
            attempts=[_attempt(story, cast, each) for each in story.attempts],
            characteristics=_figures(characteristic_plots(story, cast)),
            components=story.components,
            sections={title: _figures(plots) for title, plots in run_plots(story, cast).items()},
            trade_offs=_figures(trade_off_plots(story, cast)),
            videos=[video_of(Path(each), path.parent) for each in videos],
        )
    )
    return write_text(path, page)


def _figures(plots: Iterator[Plot] | Sequence[Plot]) -> list[dict[str, Any]]:
    return [{**figure_of("", each.svg), "title": each.title, "note": each.caption} for each in plots]


# ---- candidates


def _heading(story: Story, cast: Cast, attempt: Attempt) -> dict[str, Any]:
    """A candidate as headings name it, with its place in the order of colours if any figure shows it."""
    missed = attempt.missed
    status = "kept" if attempt.kept else f"discarded at {missed[0].step}" if missed else "discarded"
    return {
        "name": attempt.name,
        "anchor": f"candidate-{story.attempts.index(attempt) + 1}",
        "order": cast.order(attempt.name) if attempt.name in cast.names else None,
        "kept": attempt.kept,
        "status": status,
    }


def _knob_table(attempt: Attempt) -> dict[str, Any]:
    """Values of all knobs, a row for each and a column for each axle."""
    parts = {name: name.rpartition(".") for name in attempt.values}
    axles = list(dict.fromkeys(axle for axle, _, _ in parts.values()))
    names = list(dict.fromkeys(knob for _, _, knob in parts.values()))
    texts = {(axle, knob): _knob_text(attempt, name) for name, (axle, _, knob) in parts.items()}
    rows = [{"knob": knob_words(knob), "cells": [texts.get((axle, knob), "–") for axle in axles]} for knob in names]
    return {"axles": axles, "rows": rows}


def _knob_text(attempt: Attempt, name: str) -> str:
    value, unit = attempt.values[name]
    return value if isinstance(value, str) else quantity_text(value, unit)


def _attempt(story: Story, cast: Cast, attempt: Attempt) -> dict[str, Any]:
    """A candidate's part of the story."""
    parent = next((each for each in story.attempts if each.name == attempt.parent), None)
    known = known_bands(story, attempt)
    return {
        **_heading(story, cast, attempt),
        "because": attempt.because,
        "parent": attempt.parent,
        "changes": [_change(name, attempt, parent) for name in attempt.changed if name in attempt.values],
        "follows": [_change(name, attempt, parent) for name in _following(attempt, parent)],
        "reason": attempt.reason,
        "missed": [
            {
                "target": each.target,
                "where": each.where,
                **_shown(each),
                "knobs": [influence_row(knob, each, known) for knob in attempt.influences if knob.target == each.key],
            }
            for each in attempt.missed
        ],
        "steps": [_step(title, list(found)) for title, found in groupby(attempt.findings, lambda each: each.step)],
    }


def _change(name: str, attempt: Attempt, parent: Attempt | None) -> dict[str, str]:
    old = _knob_text(parent, name) if parent is not None and name in parent.values else ""
    return {"knob": knob_words(name), "old": old, "new": _knob_text(attempt, name)}


def _following(attempt: Attempt, parent: Attempt | None) -> list[str]:
    """Knobs that differ from the parent's without having been turned: bars that are laid out anew."""
    if parent is None:
        return []
    return [
        name
        for name in attempt.values
        if name not in attempt.changed and name in parent.values and attempt.values[name] != parent.values[name]
    ]


def _step(title: str, findings: Sequence[Finding]) -> dict[str, Any]:
    """One step with its findings."""
    missed = sum(not each.passed for each in findings)
    return {
        "title": title,
        "passed": not missed,
        "said": _met_text(missed, len(findings)),
        "rows": [
            {
                "target": each.target,
                "where": each.where,
                "formula": each.formula,
                "inputs": each.inputs,
                "note": each.note,
                **_shown(each),
            }
            for each in findings
        ],
    }


def _met_text(missed: int, count: int) -> str:
    if count == 1:
        return "missed" if missed else "met"
    return f"{missed} of {count} missed" if missed else f"all {count} met"


def _shown(finding: Finding) -> dict[str, Any]:
    """A finding in engineers' units."""
    return {
        "passed": finding.passed,
        "value": "no value" if finding.value is None else quantity_text(finding.value, finding.unit),
        "band": finding.band or _NO_BAND,
        "assumed": finding.assumed,
        "margin": "" if finding.margin is None else _margin_text(finding.margin, finding.unit),
    }


def _margin_text(margin: float, unit: str) -> str:
    """Distance to the nearer bound with its sign; one too small to be seen is none."""
    text = change_text(margin, unit)
    return text if text[0] in "+−" else f"{'+' if margin > 0 else '−'}{quantity_text(0.0, unit)}"


# ---- candidates x criteria


def _groups(story: Story) -> Iterator[dict[str, Any]]:
    """Rows of the table of candidates, grouped by step."""
    found = [{each.key: each for each in attempt.findings} for attempt in story.attempts]
    sample = {key: next(each[key] for each in found if key in each) for key in story.rows}
    for step in dict.fromkeys(each.step for each in sample.values()):
        rows = [
            {
                "target": each.target,
                "where": each.where,
                "assumed": each.assumed,
                "band": _common_band([of_one[key] for of_one in found if key in of_one]),
                "cells": [_light(of_one.get(key)) for of_one in found],
            }
            for key, each in sample.items()
            if each.step == step
        ]
        yield {"title": step, "rows": rows}


def _common_band(findings: Sequence[Finding]) -> str:
    """Band of a target; where it depends on the candidate, that is said."""
    bands = list(dict.fromkeys(each.band or _NO_BAND for each in findings))
    return bands[0] if len(bands) == 1 else f"{bands[0]}, and others"


def _light(finding: Finding | None) -> dict[str, str]:
    """A cell: colour, sign and word say the same."""
    if finding is None:
        return {"mark": "skipped", "sign": "–", "word": "not reached", "text": "", "margin": "", "title": "not reached"}
    what = _shown(finding)
    word = "met" if finding.passed else "missed"
    told = [f"asked: {what['band']}", finding.note or ("" if finding.passed else finding.words)]
    return {
        "mark": "good" if finding.passed else "bad",
        "sign": "✓" if finding.passed else "✗",
        "word": word,
        "text": what["value"],
        "margin": what["margin"],
        "title": "; ".join([word, *filter(None, told)]),
    }


# ---- for other programs


def write_verdict_json(story: Story, path: str | Path) -> Path:
    """Write the story, but for curves and runs, as strict JSON in SI units; the same story gives the same bytes.

    Raises:
        InputError: the place cannot be written.
    """
    return write_json(
        {
            "title": story.title,
            "description": story.description,
            "vehicle": story.vehicle,
            "verdict": story.verdict,
            "kept": None if story.kept is None else story.kept.name,
            "attempts": [_plain_attempt(each) for each in story.attempts],
            "trade_offs": [vars(each) for each in story.trade_offs],
            "static": story.static,
            "components": story.components,
            "notes": story.notes,
            "made": story.made,
        },
        path,
    )


def _plain_attempt(attempt: Attempt) -> dict[str, Any]:
    return {
        **vars(attempt),
        "values": {name: _with_unit(*each) for name, each in attempt.values.items()},
        "findings": [_plain_finding(each) for each in attempt.findings],
        "influences": [
            {**vars(each), "also": {key: _with_unit(*moved) for key, moved in each.also.items()}}
            for each in attempt.influences
        ],
    }


def _plain_finding(finding: Finding) -> dict[str, Any]:
    """A finding with what follows from it; what to say of a missed target is left out where it is met."""
    follows = {"key": finding.key, "passed": finding.passed, "margin": finding.margin}
    return {**vars(finding), **follows, "words": "" if finding.passed else finding.words}


def _with_unit(value: float | str, unit: str) -> Mapping[str, Any]:
    return {"value": value, "unit": unit}
