"""Plots of amplification over frequency, of vertical sine sweeps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from susp_mj.names import QUANTITIES, channel_name

from ..numbers.frequency import amplification
from .channels import stands_still, station_name, stations_with
from .figure import colour, draw_line, draw_svg, label_axes, make_panels

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ..compare import Comparison, Configuration

SWEEP_QUANTITIES = (
    "body_displacement",
    "body_acceleration",
    "pitch_angle",
    "roll_angle",
    "suspension_deflection",
    "wheel_load",
)


def amplification_plots(comparison: Comparison) -> dict[str, str]:
    """Amplification over frequency for each quantity; empty unless the manoeuvre was a sine sweep of the road."""
    configurations = comparison.configurations
    if not any("excitation_phase" in each.run and not stands_still([each], "road_height") for each in configurations):
        return {}
    return {
        f"{quantity}_amplification": draw_svg(_amplification_figure, configurations, quantity, stations)
        for quantity in SWEEP_QUANTITIES
        if (stations := _responding(configurations, quantity))
    }


def _responding(configurations: Sequence[Configuration], quantity: str) -> list[str]:
    """Stations that a sweep moves at all: a symmetric one does not roll the car."""
    values = [run_values for each in configurations for run_values in each.run.stations(quantity).values()]
    moves = any(np.ptp(each) > 1e-9 * max(1.0, np.abs(each).max()) for each in values)
    return stations_with(configurations, quantity) if moves else []


def _amplification_figure(configurations: Sequence[Configuration], quantity: str, stations: Sequence[str]) -> Figure:
    from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

    figure, axes = make_panels(
        [each.name for each in configurations], [station_name(each) for each in stations], share_y=True
    )
    unit = QUANTITIES[quantity][0]
    shown_as = {"m": ("", 1.0), "m/s²": ("1/s²", 1.0), "N": ("kN/m", 1e-3), "rad": ("°/m", 180 / np.pi)}
    ratio_unit, factor = shown_as.get(unit, (f"({unit})/m", 1.0))
    label = quantity.replace("_", " ") + " / road height" + (f" [{ratio_unit}]" if ratio_unit else " [–]")
    for panel, station in zip(axes, stations, strict=True):
        for order, each in enumerate(configurations):
            name = channel_name(station, quantity)
            found = amplification(each.run, name, station) if name in each.run else None
            if found is not None:
                draw_line(panel, order, found.frequency, np.abs(found.ratio) * factor)
            if name in each.transfer:
                frequency, exact = each.transfer[name]
                panel.plot(frequency, np.abs(exact) * factor, color=colour(order), linestyle=":", linewidth=1.2)
        panel.set_xscale("log")
        panel.set_yscale("log")
        for axis in (panel.xaxis, panel.yaxis):
            decades = np.diff(np.log10(axis.get_view_interval()))[0]
            axis.set_major_locator(LogLocator(subs=(1, 2, 5) if decades < 3 else (1,)))
            axis.set_minor_locator(NullLocator())
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        label_axes(panel, "frequency [Hz]", label)
    return figure
