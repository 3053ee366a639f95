"""The page of a comparison with measurements."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from susp_mj.files import write_text

from ..validation import Findings
from ..validation.table import FORMULAS, HEADINGS, remarks, rows
from .page import figure_of, page_colours, templates

NOTE = "shaded: the band; thin: each measurement; ring: the worst place"


def write_validation(
    title: str, facts: Mapping[str, str], findings: Findings, plots: Mapping[str, str], path: str | Path
) -> Path:
    """Write the findings as one self-contained HTML page.

    Args:
        facts: what was run and measured, by word.
        plots: as `plots.validation.validation_plots` gives them.

    Raises:
        InputError: the place cannot be written.
    """
    outside = [each.channel for each in findings.judgements if not each.inside]
    page = (
        templates()
        .get_template("validation.html.j2")
        .render(
            title=title,
            colours=page_colours(),
            inside=findings.inside,
            outside=", ".join(outside),
            facts=[*facts.items(), *remarks(findings)],
            headings=HEADINGS,
            rows=rows(findings),
            plots=[{**figure_of(name, svg), "note": NOTE} for name, svg in plots.items()],
            formulas=FORMULAS,
        )
    )
    return write_text(path, page)
