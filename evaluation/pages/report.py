"""The HTML report of a comparison."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from susp_mj.files import write_text

from ..display import band_text, number_text, quantity_text, shown
from ..plots.drawing import draw
from ..turning import turning_table
from .notes import GLOSSARY, elements_used, overrides, settings, station_words
from .page import figure_of, page_colours, templates, video_of

if TYPE_CHECKING:
    from ..compare import Comparison


@dataclass(frozen=True)
class _Cell:
    """One value in a table: its text, a note, and the mark of a footnote."""

    text: str
    note: str = ""
    mark: str = ""
    passed: bool = True


def write_report(
    comparison: Comparison, path: str | Path, videos: Sequence[str | Path] = (), plots: Mapping[str, str] | None = None
) -> Path:
    """Write the report of a comparison as one self-contained HTML page.

    Args:
        path: of the page; it appears complete or not at all.
        videos: video files; without any, those that the comparison names, beside the page.
        plots: what `plots.draw` returned, if it was drawn before.

    Raises:
        InputError: the place cannot be written, or a video cannot be read.
    """
    path = Path(path)
    films = [Path(each) for each in videos] or [path.parent / each for each in comparison.videos]
    drawn = draw(comparison) if plots is None else plots
    footnotes: dict[str, str] = {}
    elements = elements_used(comparison)
    page = (
        templates()
        .get_template("report.html.j2")
        .render(
            title=comparison.title,
            description=comparison.description,
            colours=page_colours(),
            verdict=list(_verdict(comparison)),
            configurations=[
                {"name": each.name, "title": each.title, "set": overrides(each.asked), **each.facts}
                for each in comparison.configurations
            ],
            failures=[
                {
                    "name": each.name,
                    "title": each.title,
                    "set": overrides(each.asked),
                    "reason": each.reason,
                    **each.facts,
                }
                for each in comparison.failures
            ],
            claims=comparison.claims,
            criteria=_criteria_rows(comparison),
            turning=turning_table(comparison),
            numbers=_number_rows(comparison, footnotes),
            baseline=comparison.baseline,
            differences=_difference_rows(comparison),
            modes=_mode_rows(comparison),
            footnotes=[(mark, note) for note, mark in footnotes.items()],
            videos=[video_of(each, path.parent) for each in films],
            sections=list(_sections(drawn)),
            elements=elements,
            mounted=any(each["role"] == "mount" for each in elements),
            glossary=[*GLOSSARY, *station_words(comparison)],
            settings=list(settings(comparison)),
        )
    )
    return write_text(path, page)


def _verdict(comparison: Comparison) -> Iterator[dict[str, str]]:
    """Lines that say how it went: configurations without a run, claims, then criteria."""
    for each in comparison.failures:
        yield {"mark": "bad", "word": f"✗ {each.name} has no run.", "text": each.reason}
    claims = comparison.claims
    if claims:
        failed = sum(not each.holds for each in claims)
        text = (
            f"{len(claims) - failed} of {_count(len(claims), 'published statement')} "
            f"hold{'s' if len(claims) - failed == 1 else ''}."
        )
        yield {
            "mark": "bad" if failed else "good",
            "word": "✗ Not reproduced." if failed else "✓ Reproduced.",
            "text": text,
        }
    if comparison.criteria:
        failing = {
            c.name: sum(not v.passed for v in comparison.verdicts(c).values()) for c in comparison.configurations
        }
        said = "; ".join(
            f"{name} fails {count} of {len(comparison.criteria)}" if count else f"{name} meets all"
            for name, count in failing.items()
        )
        said = "; ".join([said] * bool(failing) + [f"{each.name} has no run" for each in comparison.failures])
        passed = comparison.passed
        text = (
            f"Every configuration meets {_count(len(comparison.criteria), 'criterion', 'criteria')}."
            if passed
            else f"{said}."
        )
        yield {
            "mark": "good" if passed else "bad",
            "word": "✓ Criteria met." if passed else "✗ Criteria not met.",
            "text": text,
        }
    if not claims and not comparison.criteria:
        yield {
            "mark": "",
            "word": "No verdict.",
            "text": "The case sets no criteria; the numbers stand for themselves.",
        }


def _count(number: int, one: str, many: str = "") -> str:
    return f"{number} {one if number == 1 else many or one + 's'}"


def _label(comparison: Comparison, name: str) -> str:
    """What a number means: the first sentence of its description, without unit and formula."""
    first = re.split(r": ``|(?<=\S)\. |\.$|;", comparison.description_of(name), maxsplit=1)[0]
    text = re.sub(r"\s*\[[^\]]*\]", "", first).replace("`", "")
    return text.strip().rstrip(".") or name.replace("_", " ")


def _number_rows(comparison: Comparison, footnotes: dict[str, str]) -> list[dict[str, Any]]:
    """Rows of the comparison table; notes of missing values are gathered in `footnotes`, note -> mark."""
    names = list(dict.fromkeys(name for each in comparison.configurations for name in each.numbers))
    rows = []
    for name in names:
        numbers = [each.numbers.get(name) for each in comparison.configurations]
        unit = next(n.unit for n in numbers if n is not None)
        cells = []
        for number in numbers:
            missing = number is None or number.value is None or not math.isfinite(number.value)
            note = "not evaluated" if number is None else number.note
            mark = footnotes.setdefault(note, _mark(len(footnotes))) if missing and note else ""
            cells.append(_Cell(number_text(number.value if number else None, unit), note, mark))
        rows.append({"name": name, "label": _label(comparison, name), "unit": shown(unit).unit or "–", "cells": cells})
    return rows


def _difference_rows(comparison: Comparison) -> list[dict[str, Any]]:
    """Rows of the differences to the baseline, under its own column its value; none without a baseline."""
    found = {each.name: comparison.differences(each) for each in comparison.configurations}
    rows = []
    for name in comparison.differing():
        cells = [
            _Cell(quantity_text(each.numbers[name].value, each.numbers[name].unit))
            if each.name == comparison.baseline
            else _Cell(found[each.name][name].text if name in found[each.name] else "–")
            for each in comparison.configurations
        ]
        rows.append({"name": name, "label": _label(comparison, name), "cells": cells})
    return rows


def _mark(order: int) -> str:
    """Mark of a footnote: a to z, then aa."""
    letter = chr(ord("a") + order % 26)
    return letter * (order // 26 + 1)


def _criteria_rows(comparison: Comparison) -> list[dict[str, Any]]:
    verdicts = [comparison.verdicts(each) for each in comparison.configurations]
    rows = []
    for name, criterion in comparison.criteria.items():
        found = [each[name] for each in verdicts]
        cells = [_Cell(quantity_text(each.number.value, each.number.unit), passed=each.passed) for each in found]
        band = found[0].band if found else band_text(criterion.minimum, criterion.maximum, "")
        rows.append({"name": name, "label": _label(comparison, name), "band": band, "cells": cells})
    return rows


def _mode_rows(comparison: Comparison) -> list[dict[str, Any]]:
    """Oscillating modes, one row a mode, one cell a configuration; empty where a configuration has fewer."""
    found = [[mode for mode in each.modes if mode.oscillates] for each in comparison.configurations]
    longest = max((len(modes) for modes in found), default=0)
    rows = []
    for i in range(longest):
        cells = [
            f"{modes[i].frequency:.2f} Hz, D = {modes[i].damping:.2f}" if i < len(modes) else "–" for modes in found
        ]
        largest = next(modes[i] for modes in found if i < len(modes))
        moving = [joint.replace("_", " ") for joint, amplitude in largest.shape.items() if abs(amplitude) > 0.3]
        rows.append({"label": ", ".join(moving), "cells": cells})
    return rows


def _sections(plots: Mapping[str, str]) -> Iterator[dict[str, Any]]:
    """Plots in their sections, in the order drawn."""
    kinds = {
        "_handling": "Handling",
        "_amplification": "Amplification over frequency",
        "": "Over time",
        "_characteristic": "Characteristics",
    }
    for ending, title in kinds.items():
        others = tuple(each for each in kinds if each and each != ending)
        names = [name for name in plots if name.endswith(ending) and not (ending == "" and name.endswith(others))]
        if names:
            yield {"title": title, "plots": [figure_of(name, plots[name]) for name in names]}
