"""The HTML report of a comparison, its summary as JSON, and the characteristic sheet of a car.

Each page is one file: plots and videos are inside, nothing is loaded from elsewhere. jinja2 is imported when the first
page is written. The same input gives the same bytes.
"""

from __future__ import annotations

import base64
import json
import math
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import numpy as np

from susp_mj.errors import InputError
from susp_mj.files import write_text

from . import NUMBERS
from .colours import COLOURS
from .display import number_text, quantity_text, shown
from .handling_plots import STEERED
from .number import Criterion
from .plots import HANDLING, STATIONS, characteristic_plots, draw, for_page, on_dark
from .turning import turning_table
from .tyre_plots import tyre_plots

if TYPE_CHECKING:
    from jinja2 import Environment

    from .compare import Characteristic, Comparison

LARGEST_VIDEO = 12_000_000
"""A video of fewer bytes is put inside the report; a larger one is linked."""
GRAVITY = 9.81

_MEDIA = {".mp4": "video/mp4", ".webm": "video/webm", ".gif": "image/gif", ".png": "image/png"}
_PLOT_NOTES = {
    **dict.fromkeys(
        ("body_displacement_amplification", "body_acceleration_amplification", "suspension_deflection_amplification"),
        "solid: read from the sweep; dotted: linearised, friction left out",
    ),
    "wheel_load_amplification": "solid: read from the sweep; dotted: linearised, friction left out",
    "pitch_angle": "positive nose down",
    "roll_angle": "positive left side up",
    "wheel_load": "at zero the wheel leaves the road; lost contact is shaded",
    "suspension_deflection": "positive in compression, from the design position",
    "suspension_speed": "positive in compression",
    "element_forces": "at the wheel, positive in compression; a massless wheel off the road shows none",
    "seat_acceleration": "at the driver's seat, positive upwards",
    "body_acceleration": "positive upwards",
    "body_displacement": "positive upwards, from the design position",
    "wheel_lift_handling": (
        "up to the largest lateral acceleration; a ring marks a wheel that leaves the road, with the acceleration there"
    ),
    "self_steering_handling": "positive into the turn; dotted: the angle of slip-free rolling on the same circle",
    "wheel_travel_handling": (
        "up to the largest lateral acceleration; positive in compression, from the design position"
    ),
    "course_handling": (
        "way of the centre of gravity; thin: the corners of the car between cones, its front wheels on slippery ground"
    ),
    "kinematics_handling": "of the left wheel, or the mean of both",
    "over_time_handling": "positive to the left, roll left side up, pitch nose down",
    **dict.fromkeys(
        (f"{quantity}_over_frequency_handling" for quantity in STEERED),
        "per steering wheel angle; the coherence is 1 where the car answers linearly",
    ),
    "spring_force_characteristic": "the dot is the preload in the design position; dashed lines are the stops",
    "spring_rate_characteristic": "between the stops",
    "natural_frequency_characteristic": "of the mass that the spring carries",
    "damper_force_characteristic": "hydraulic force, without mount and friction",
    "component_spring_force_characteristic": "over its own travel between the stops; the dot is the design position",
    "component_damper_force_characteristic": "over its own speed, the wheel in the design position",
    "tyre_longitudinal_force_characteristic": (
        "at 0.5, 1, 1.5 and 2 times the wheel load in the design position; positive driven"
    ),
    "tyre_lateral_force_characteristic": "at the same loads; a tyre that drifts to the left is pushed to the right",
    "tyre_aligning_moment_characteristic": "at the same loads; positive to the left",
    "tyre_combined_slip_characteristic": (
        "lines of one slip angle at the wheel load in the design position; dotted: the friction ellipse"
    ),
}
_GLOSSARY = (
    ("body motion", "vertical, positive upwards; zero is the design position"),
    ("suspension deflection", "positive in compression (bump), zero in the design position; negative is rebound"),
    (
        "spring, damper, friction force",
        "effective at the wheel, positive when it pushes wheel and body apart or resists compression",
    ),
    ("wheel load", "vertical force of the road on the tyre; zero means that the wheel has left the road"),
    ("KO", "design position (Konstruktionslage), in which the spring carries its preload F₀"),
    ("dashed line", "in a plot: lies on the line of an earlier configuration"),
    ("1:2", "compression to rebound ratio of a damper: rebound has twice the rate"),
)


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
    elements = _elements(comparison)
    page = (
        _templates()
        .get_template("report.html.j2")
        .render(
            title=comparison.title,
            description=comparison.description,
            colours=_colours(),
            verdict=list(_verdict(comparison)),
            configurations=[
                {"name": each.name, "title": each.title, **each.facts} for each in comparison.configurations
            ],
            claims=comparison.claims,
            criteria=_criteria_rows(comparison),
            turning=turning_table(comparison),
            numbers=_number_rows(comparison, footnotes),
            modes=_mode_rows(comparison),
            footnotes=[(mark, note) for note, mark in footnotes.items()],
            videos=[_video(each, path.parent) for each in films],
            sections=list(_sections(drawn)),
            elements=elements,
            mounted=any(each["role"] == "mount" for each in elements),
            glossary=[*_GLOSSARY, *_station_words(comparison)],
            settings=list(_settings(comparison)),
        )
    )
    return write_text(path, page)


def write_summary(comparison: Comparison, path: str | Path, extra: Mapping[str, Any] | None = None) -> Path:
    """Write ``{"title", "configurations", "claims", "passed", **extra}`` as strict JSON; what is not finite becomes
    null.

    Raises:
        InputError: the place cannot be written.
    """
    summary = {
        "title": comparison.title,
        "configurations": comparison.summary(),
        "claims": [
            {"text": c.text, "expected": c.expected, "result": c.result, "holds": bool(c.holds)}
            for c in comparison.claims
        ],
        "passed": comparison.passed,
        **(extra or {}),
    }
    return write_text(path, json.dumps(_plain(summary), indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def write_sheet(
    title: str, sets: Mapping[str, Sequence[Characteristic]], path: str | Path, facts: Mapping[str, Any] | None = None
) -> Path:
    """Write the characteristic sheet of a car: plots and key values of all its sets, as one self-contained page.

    Args:
        sets: characteristics of the axles, by name of the set.
        facts: what stands below the title, by word.

    Raises:
        InputError: the place cannot be written.
    """
    titles = dict.fromkeys(each.title for characteristics in sets.values() for each in characteristics)
    page = (
        _templates()
        .get_template("sheet.html.j2")
        .render(
            title=title,
            facts=[(word, str(meaning)) for word, meaning in (facts or {}).items()],
            colours=_colours(),
            names=list(sets),
            groups=[{"title": each, "rows": _key_rows(each, sets)} for each in titles],
            plots=[_plot(name, svg) for name, svg in (characteristic_plots(sets) | tyre_plots(sets)).items()],
        )
    )
    return write_text(path, page)


@cache
def _templates() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    return Environment(
        loader=PackageLoader("evaluation"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        keep_trailing_newline=True,
    )


def _colours() -> list[dict[str, str]]:
    return [{"light": each, "dark": on_dark(each)} for each in COLOURS]


def _verdict(comparison: Comparison) -> Iterator[dict[str, str]]:
    """Lines that say how it went: claims, then criteria."""
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
            c.name: sum(not v["passed"] for v in comparison.verdicts(c).values()) for c in comparison.configurations
        }
        said = "; ".join(
            f"{name} fails {count} of {len(comparison.criteria)}" if count else f"{name} meets all"
            for name, count in failing.items()
        )
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


def _label(name: str) -> str:
    """What a number means, from the first sentence of its function, without unit and formula."""
    doc = (NUMBERS[name].__doc__ or "").strip() if name in NUMBERS else ""
    first = re.split(r": ``|\n\s*\n|(?<=\S)\. |\.$|;", doc, maxsplit=1)[0]
    text = re.sub(r"\s*\[[^\]]*\]", "", first).replace("`", "")
    return " ".join(text.split()).rstrip(".") or name.replace("_", " ")


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
        rows.append({"name": name, "label": _label(name), "unit": shown(unit).unit or "–", "cells": cells})
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
        cells = [_Cell(quantity_text(each["value"], each["unit"]), passed=each["passed"]) for each in found]
        rows.append(
            {
                "name": name,
                "label": _label(name),
                "band": _band(criterion, found[0]["unit"] if found else ""),
                "cells": cells,
            }
        )
    return rows


def _band(criterion: Criterion, unit: str) -> str:
    low, high = criterion.minimum, criterion.maximum
    if low is not None and high is not None:
        return f"{number_text(low, unit)} to {quantity_text(high, unit)}"
    if low is not None:
        return f"at least {quantity_text(low, unit)}"
    return f"at most {quantity_text(high, unit)}" if high is not None else "any value"


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
            yield {"title": title, "plots": [_plot(name, plots[name]) for name in names]}


def _plot(name: str, svg: str) -> dict[str, Any]:
    """What the page needs of a plot: title, data and size [px]."""
    size = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg)
    width, height = (round(float(size[1]) * 4 / 3), round(float(size[2]) * 4 / 3)) if size else (480, 300)
    return {
        "title": re.sub("_(characteristic|amplification|handling)$", "", name).replace("_", " ").capitalize(),
        "note": _PLOT_NOTES.get(name, ""),
        "source": _data_uri(for_page(svg).encode(), "image/svg+xml"),
        "width": width,
        "height": height,
        "wide": width > 560,
    }


def _data_uri(content: bytes, kind: str) -> str:
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


def _video(path: Path, folder: Path) -> dict[str, Any]:
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


def _elements(comparison: Comparison) -> list[dict[str, Any]]:
    """Each law that the suspensions follow, once, springs first."""
    notes = {
        (note.role, note.kind): note
        for each in comparison.configurations
        for c in each.characteristics
        for note in c.elements
        if note.role != ("tyre" if each.run.meta.get("model") == HANDLING else "handling_tyre")
    }
    order = list(dict.fromkeys(role for role, _ in notes))
    return [
        {"role": note.role, "kind": note.kind, "lines": _paragraphs(note.text)}
        for note in sorted(notes.values(), key=lambda note: order.index(note.role))
    ]


def _paragraphs(doc: str) -> list[str]:
    """Opening paragraphs of an element's docstring, up to its attributes."""
    text = re.split(r"\n\s*(?:Attributes|Args|Raises):", doc)[0].replace("`", "")
    return [" ".join(each.split()) for each in text.split("\n\n") if each.strip()]


def _station_words(comparison: Comparison) -> Iterator[tuple[str, str]]:
    used = dict.fromkeys(c.station for each in comparison.configurations for c in each.run.channels.values())
    for station in used:
        if station in STATIONS:
            yield station, STATIONS[station]


def _settings(comparison: Comparison) -> Iterator[tuple[str, str]]:
    """Manoeuvre, step, integrator and versions of the runs; where they differ, each with its configurations."""
    names_of: dict[tuple[str, str], list[str]] = {}
    for each in comparison.configurations:
        for word, text in _run_settings(each.run.meta):
            names_of.setdefault((word, text), []).append(each.name)
    for (word, text), names in sorted(names_of.items(), key=lambda item: _SETTINGS.index(item[0][0])):
        everywhere = len(names) == len(comparison.configurations)
        yield word, text if everywhere else f"{text} ({', '.join(names)})"


_SETTINGS: tuple[str, ...] = ("manoeuvre", "masses", "integration", "versions")


def _run_settings(meta: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    manoeuvre = dict(meta.get("manoeuvre", {}))
    kind = manoeuvre.pop("kind", "")
    yield (
        "manoeuvre",
        f"{kind}, SI units: " + ", ".join(f"{key} {_plain_text(value)}" for key, value in manoeuvre.items()),
    )
    if meta.get("facts"):
        masses = {key.replace("_", " "): value for key, value in meta["facts"].items() if "mass" in key}
        yield "masses", ", ".join(f"{name} {_plain_text(value)} kg" for name, value in masses.items())
    if "step" in meta:
        yield "integration", f"{meta.get('integrator', '')}, step {1e3 * meta['step']:g} ms".lstrip(", ")
    if meta.get("versions"):
        yield "versions", ", ".join(f"{package} {version}" for package, version in meta["versions"].items())


def _plain_text(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _plain(value: Any) -> Any:
    """The same as plain JSON values; numpy numbers become numbers, what is not finite None."""
    if isinstance(value, Mapping):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    if isinstance(value, (np.generic, np.ndarray)):
        return _plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if isinstance(value, (str, int, float, bool, type(None))) else str(value)


def _key_rows(title: str, sets: Mapping[str, Sequence[Characteristic]]) -> list[dict[str, Any]]:
    """Key values of one axle, a column for each set."""
    columns = [
        next((_key_values(each) for each in characteristics if each.title == title), {})
        for characteristics in sets.values()
    ]
    labels = dict.fromkeys(key for column in columns for key in column)
    return [
        {
            "label": label,
            "unit": shown(unit).unit or "–",
            "cells": [number_text(column.get((label, unit)), unit) for column in columns],
        }
        for label, unit in labels
    ]


def _key_values(each: Characteristic) -> dict[tuple[str, str], float]:
    """Values of a characteristic, by label and SI unit."""
    rebound, compression = each.stops

    def at(values: Any, deflection: float) -> float:
        return float(np.interp(deflection, each.deflection, values))

    def damping(speed: float) -> float:
        return float(np.interp(speed, each.speed, each.damper_force)) / speed

    rate = at(each.spring_rate, 0.0)
    mean_damping = (damping(0.05) + damping(-0.05)) / 2
    return {
        ("preload at KO", "N"): each.preload,
        ("spring rate at KO", "N/m"): rate,
        ("natural frequency at KO", "Hz"): at(each.spring_frequency, 0.0),
        ("rebound stop", "m"): rebound,
        ("compression stop", "m"): compression,
        ("spring rate at the rebound stop", "N/m"): at(each.spring_rate, rebound),
        ("spring rate at the compression stop", "N/m"): at(each.spring_rate, compression),
        ("spring force at the rebound stop", "N"): at(each.spring_force, rebound),
        ("spring force at the compression stop", "N"): at(each.spring_force, compression),
        ("damper rate F/v at 0.05 m/s, compression", "N s/m"): damping(0.05),
        ("damper rate F/v at 0.05 m/s, rebound", "N s/m"): damping(-0.05),
        ("damper rate F/v at 1 m/s, compression", "N s/m"): damping(1.0),
        ("damper rate F/v at 1 m/s, rebound", "N s/m"): damping(-1.0),
        ("damping ratio at KO", "1"): mean_damping / (2 * math.sqrt(rate * each.preload / GRAVITY)),
        **_component_values(each),
    }


def _component_values(each: Characteristic) -> dict[tuple[str, str], float]:
    """Values of the spring and the damper themselves, where their motion ratios are known."""
    values: dict[tuple[str, str], float] = {}
    if (spring := each.component_spring) is not None:
        values |= {
            ("spring ratio i at KO, component travel / wheel travel", "1"): spring.ratio,
            ("force of the spring itself at KO", "N"): each.preload / spring.ratio,
            ("rate of the spring itself at KO", "N/m"): float(np.interp(0.0, spring.travel, spring.rate)),
            ("travel of the spring itself to the rebound stop", "m"): float(spring.travel[0]),
            ("travel of the spring itself to the compression stop", "m"): float(spring.travel[-1]),
        }
    if (damper := each.component_damper) is not None:
        force = np.interp([0.1, -0.1], damper.speed, damper.force)
        values |= {
            ("damper ratio i at KO, component travel / wheel travel", "1"): damper.ratio,
            ("rate F/v of the damper itself at 0.1 m/s, compression", "N s/m"): float(force[0]) / 0.1,
            ("rate F/v of the damper itself at 0.1 m/s, rebound", "N s/m"): float(-force[1]) / 0.1,
        }
    return values
