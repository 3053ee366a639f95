"""Plots of the response to the steering wheel over frequency."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from susp_mj.names import QUANTITIES

from ..numbers.steering_frequency import Response, steering_response
from .figure import draw_line, draw_svg, label_axes, make_panels

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ..compare import Configuration

STEERED = ("yaw_rate", "lateral_acceleration", "roll_angle", "side_slip_angle", "rear_side_slip_angle")
"""Quantities whose response to the steering wheel is drawn over frequency."""


def steering_plots(configurations: Sequence[Configuration]) -> dict[str, str]:
    """Gain, phase and coherence of each quantity, as SVG text by name; empty unless the steering wheel was swept."""
    return {
        f"{quantity}_over_frequency_handling": draw_svg(_frequency_figure, configurations, quantity)
        for quantity in STEERED
        if any(steering_response(each.run, quantity) is not None for each in configurations)
    }


def _frequency_figure(configurations: Sequence[Configuration], quantity: str) -> Figure:
    """Gain, phase and coherence of a quantity over the frequency of the steering wheel."""
    from matplotlib.ticker import MultipleLocator

    unit, factor = gain_unit(quantity)
    figure, panels = make_panels([each.name for each in configurations], ["gain", "phase", "coherence"])
    for order, each in enumerate(configurations):
        found = steering_response(each.run, quantity)
        if found is not None:
            for panel, values in zip(panels, _curves(found, factor), strict=True):
                draw_line(panel, order, found.frequency, values)
    for panel, label in zip(panels, (f"gain [{unit}]", "phase [°]", "coherence"), strict=True):
        over_frequency(panel)
        label_axes(panel, "frequency [Hz]", label)
    panels[0].set_ylim(0, 1.08 * panels[0].dataLim.y1)
    phases = float(np.ptp(panels[1].dataLim.intervaly))
    panels[1].yaxis.set_major_locator(MultipleLocator(15 if phases < 90 else 30 if phases < 200 else 90))
    panels[2].set_ylim(0, 1.04)
    return figure


def gain_unit(quantity: str) -> tuple[str, float]:
    """Unit in which the gain of a quantity is shown, and shown value per SI value."""
    shown_as = {"rad/s": ("1/s", 1.0), "m/s²": ("m/s² per 100°", float(np.radians(100.0)))}
    return shown_as.get(QUANTITIES[quantity][0], ("°/°", 1.0))


def over_frequency(panel: Axes) -> None:
    """Let the horizontal axis be a logarithmic one of a few plain frequencies."""
    from matplotlib.ticker import FuncFormatter, NullLocator

    panel.set_xscale("log")
    panel.set_xticks([each for each in (0.2, 0.5, 1, 2, 5, 10) if panel.dataLim.x0 <= each <= panel.dataLim.x1])
    panel.xaxis.set_minor_locator(NullLocator())
    panel.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def _curves(found: Response, factor: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return found.gain * factor, np.degrees(found.phase), found.coherence
