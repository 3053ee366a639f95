"""The characteristic sheet of a car: plots and key values of all its sets."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from susp_mj.elements import GRAVITY
from susp_mj.files import write_text

from ..display import number_text, shown
from ..plots.characteristics import characteristic_plots
from ..plots.tyres import tyre_plots
from .page import figure_of, page_colours, templates

if TYPE_CHECKING:
    from ..characteristics import Characteristic


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
        templates()
        .get_template("sheet.html.j2")
        .render(
            title=title,
            facts=[(word, str(meaning)) for word, meaning in (facts or {}).items()],
            colours=page_colours(),
            names=list(sets),
            groups=[{"title": each, "rows": _key_rows(each, sets)} for each in titles],
            plots=[figure_of(name, svg) for name, svg in (characteristic_plots(sets) | tyre_plots(sets)).items()],
        )
    )
    return write_text(path, page)


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
