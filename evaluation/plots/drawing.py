"""Plots as SVG text: all configurations on one axis, each in its fixed colour, in engineers' units.

matplotlib is imported when the first plot is drawn. The same input gives the same bytes.
"""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from susp_mj.files import write_text

from ..numbers.runs import drives, on_rig, on_tyres, parameter
from ..numbers.turns import TIGHTENED
from .characteristics import characteristic_plots
from .ground import acceleration_plots, course_plots
from .over_time import axle_load_plots, time_plots, together_plots
from .rig import rig_plots
from .steering import steering_plots
from .sweeps import amplification_plots
from .turns import turn_plots
from .tyres import tyre_plots

if TYPE_CHECKING:
    from ..compare import Comparison, Configuration


def draw(comparison: Comparison) -> dict[str, str]:
    """Every plot of a comparison as SVG text, by name: handling, amplification of sweeps, over time, characteristics.

    Those of the tyres with slip are drawn for the model that rolls on them. Runs of several kinds of manoeuvre have
    nothing in common over time; of runs that are held against a baseline, what all of them recorded is drawn.
    """
    if not comparison.configurations:
        return {}
    sets = {each.name: each.characteristics for each in comparison.configurations}
    rolling = any(on_tyres(each.run) for each in comparison.configurations)
    return {
        **_run_plots(comparison),
        **characteristic_plots(sets),
        **(tyre_plots(sets) if rolling else {}),
    }


def _run_plots(comparison: Comparison) -> dict[str, str]:
    """Plots of what the runs recorded."""
    if len({parameter(each.run, "kind") for each in comparison.configurations}) > 1:
        return {}
    shown = _in_common(comparison) if comparison.baseline else comparison
    return {**handling_plots(shown), **amplification_plots(shown), **time_plots(shown)}


def _in_common(comparison: Comparison) -> Comparison:
    """The comparison with those channels alone that every run has."""
    common = set.intersection(*(set(each.run.channels) for each in comparison.configurations))
    return replace(comparison, outcomes=[_with_channels(each, common) for each in comparison.configurations])


def _with_channels(configuration: Configuration, names: Container[str]) -> Configuration:
    run = configuration.run
    channels = {name: channel for name, channel in run.channels.items() if name in names}
    return replace(configuration, run=replace(run, channels=channels))


def save_plots(comparison: Comparison, folder: str | Path, plots: Mapping[str, str] | None = None) -> list[Path]:
    """Write every plot as ``<name>.svg``.

    Args:
        plots: what `draw` returned, if it was drawn before.

    Raises:
        InputError: the folder cannot be written.
    """
    drawn = draw(comparison) if plots is None else plots
    return [write_text(Path(folder) / f"{name}.svg", svg) for name, svg in drawn.items()]


def handling_plots(comparison: Comparison) -> dict[str, str]:
    """Plots of runs of a car that drives freely or stands on the kinematics rig, as SVG text by name; empty for other
    models."""
    driven = [each for each in comparison.configurations if drives(each.run) or on_rig(each.run)]
    if len(driven) < len(comparison.configurations) or not driven:
        return {}
    if on_rig(driven[0].run):
        return rig_plots(driven)
    return {
        **(turn_plots(driven) if driven[0].run in TIGHTENED else {}),
        **course_plots(driven),
        **steering_plots(driven),
        **together_plots(driven),
        **axle_load_plots(driven),
        **acceleration_plots(driven),
    }
