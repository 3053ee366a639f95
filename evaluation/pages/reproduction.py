"""The page of a reproduction: every published claim beside what came out."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from susp_mj.files import write_text

from .page import page_colours, templates, video_of

if TYPE_CHECKING:
    from ..reproduction import Reproduction


def write_reproduction(reproduction: Reproduction, path: str | Path, videos: Sequence[str | Path] = ()) -> Path:
    """Write a reproduction as one self-contained HTML page.

    Args:
        path: of the page; it appears complete or not at all.
        videos: video files, put inside or linked.

    Raises:
        InputError: the place cannot be written, or a video cannot be read.
    """
    path = Path(path)
    page = (
        templates()
        .get_template("reproduction.html.j2")
        .render(
            title="The claims of the thesis, reproduced",
            colours=page_colours(),
            verdict=reproduction.verdict,
            passed=reproduction.passed,
            parts=reproduction.parts,
            videos=[video_of(Path(each), path.parent) for each in videos],
            made=dict(reproduction.made),
        )
    )
    return write_text(path, page)


def write_reproduction_json(reproduction: Reproduction, path: str | Path) -> Path:
    """Write a reproduction as JSON, for other programs.

    Raises:
        InputError: the place cannot be written.
    """
    return write_text(path, json.dumps(reproduction.plain(), indent=2, ensure_ascii=False, allow_nan=False) + "\n")
