"""What the pages share: templates, colours, plots and videos put inside.

Each page is one file and loads nothing from elsewhere. jinja2 is imported when the first page is written. The same
input gives the same bytes.
"""

from __future__ import annotations

import base64
import os
import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from susp_mj.errors import InputError

from ..colours import COLOURS, DARK, LIGHT, on_dark
from .notes import PLOT_NOTES

if TYPE_CHECKING:
    from jinja2 import Environment

LARGEST_VIDEO = 12_000_000
"""A video of fewer bytes is put inside the report; a larger one is linked."""
_MEDIA = {".mp4": "video/mp4", ".webm": "video/webm", ".gif": "image/gif", ".png": "image/png"}


@cache
def templates() -> Environment:
    """Where the pages' templates come from."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    return Environment(
        loader=PackageLoader("evaluation.pages"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        keep_trailing_newline=True,
    )


def page_colours() -> list[dict[str, str]]:
    """Colours of configurations on a light and a dark ground."""
    return [{"light": each, "dark": on_dark(each)} for each in COLOURS]


def figure_of(name: str, svg: str) -> dict[str, Any]:
    """What the page needs of a plot: title, data and size [px]."""
    size = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg)
    width, height = (round(float(size[1]) * 4 / 3), round(float(size[2]) * 4 / 3)) if size else (480, 300)
    return {
        "title": re.sub("_(characteristic|amplification|handling)$", "", name).replace("_", " ").capitalize(),
        "note": PLOT_NOTES.get(name, ""),
        "source": _data_uri(for_page(svg).encode(), "image/svg+xml"),
        "width": width,
        "height": height,
        "wide": width > 560,
    }


def for_page(svg: str) -> str:
    """The same plot for a page with a light and a dark scheme: the colours become variables that follow the scheme."""
    light = {**LIGHT, **{f"c{i}": each for i, each in enumerate(COLOURS)}}
    dark = {**DARK, **{f"c{i}": on_dark(each) for i, each in enumerate(COLOURS)}}
    names = {value: name for name, value in light.items()}
    svg = re.sub(f"((?:fill|stroke): )({'|'.join(names)})", lambda found: f"{found[1]}var(--{names[found[2]]})", svg)
    rules = [
        ":root{" + ";".join(f"--{name}:{value}" for name, value in scheme.items()) + "}" for scheme in (light, dark)
    ]
    style = f"<style>{rules[0]}@media (prefers-color-scheme:dark){{{rules[1]}}}</style>"
    return re.sub(r"(<svg[^>]*>)", lambda found: found[1] + style, svg, count=1)


def _data_uri(content: bytes, kind: str) -> str:
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


def video_of(path: Path, folder: Path) -> dict[str, Any]:
    """A video inside the page, or as a link relative to the page's folder if it is large."""
    try:
        size = path.stat().st_size
        media = _MEDIA.get(path.suffix.lower())
        if media is not None and size < LARGEST_VIDEO:
            return {"kind": media.split("/")[0], "name": path.name, "source": _data_uri(path.read_bytes(), media)}
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror or error}", source=str(path)) from None
    place = os.path.relpath(path.resolve(), folder.resolve())
    return {"kind": "link", "name": path.name, "source": quote(Path(place).as_posix()), "size": f"{size / 1e6:.1f}"}
