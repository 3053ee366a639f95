"""Plots of tyres for the characteristic sheet: forces and aligning moment over slip, and the friction ellipse."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..colours import MUTED, PAPER
from .figure import PANEL, colour, draw_line, draw_svg, label_axes, make_panels

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ..characteristics import Characteristic
    from ..tyre_curves import TyreCurves

_ROOM = 0.26
"""Room for the names of the loads, as a share of the width."""
_SQUARE = (PANEL[0], 3.3)


def tyre_plots(sets: Mapping[str, Sequence[Characteristic]]) -> dict[str, str]:
    """Longitudinal and lateral force and aligning moment over slip at several loads, and both forces in combined slip.

    A panel for each axle; configurations with the same tyre share its first one's lines.

    Args:
        sets: characteristics by configuration; those without a tyre are left out.
    """
    tyres = {
        name: {each.title: each.tyre for each in characteristics if each.tyre} for name, characteristics in sets.items()
    }
    titles = list(dict.fromkeys(itertools.chain(*tyres.values())))
    return {name: draw_svg(_figure, tyres, titles, draw_one) for name, draw_one in _PLOTS.items()} if titles else {}


def _figure(
    tyres: Mapping[str, Mapping[str, TyreCurves]],
    titles: Sequence[str],
    draw_one: Callable[[Axes, int, TyreCurves], None],
) -> Figure:
    """One panel for each title, every different tyre in it."""
    figure, axes = make_panels(list(tyres), titles, size=_SQUARE if draw_one is _combined else PANEL)
    for panel, title in zip(axes, titles, strict=True):
        drawn: list[TyreCurves] = []
        for order, curves in enumerate(tyres.values()):
            tyre = curves.get(title)
            if tyre is not None and not any(tyre.equals(each) for each in drawn):
                draw_one(panel, order, tyre)
                drawn.append(tyre)
        panel.axhline(0, color=MUTED, linewidth=0.6, zorder=1.5)
        panel.axvline(0, color=MUTED, linewidth=0.6, zorder=1.5)
    return figure


def _over_slip(panel: Axes, order: int, x: np.ndarray, lines: np.ndarray, loads: np.ndarray) -> None:
    """A line for each load, its name at the right end of the first tyre's lines."""
    first = not panel.lines
    for y, load in zip(lines, loads, strict=True):
        draw_line(panel, order, x, y)
        if first:
            panel.annotate(
                f"{load * 1e-3:.1f} kN",
                (x[-1], y[-1]),
                xytext=(3, 0),
                textcoords="offset points",
                va="center",
                fontsize=7.0,
                color=MUTED,
                annotation_clip=False,
            )
    panel.set_xlim(x[0], x[-1] + _ROOM * (x[-1] - x[0]) / 2)


def _longitudinal(panel: Axes, order: int, tyre: TyreCurves) -> None:
    _over_slip(panel, order, tyre.kappa * 100, tyre.longitudinal_force * 1e-3, tyre.loads)
    label_axes(panel, "longitudinal slip [%]", "longitudinal force [kN]")


def _lateral(panel: Axes, order: int, tyre: TyreCurves) -> None:
    _over_slip(panel, order, np.degrees(tyre.alpha), tyre.lateral_force * 1e-3, tyre.loads)
    label_axes(panel, "slip angle [°]", "lateral force [kN]")


def _aligning(panel: Axes, order: int, tyre: TyreCurves) -> None:
    x, moment = np.degrees(tyre.alpha), tyre.aligning_moment
    first = not panel.lines
    for y, load in zip(moment, tyre.loads, strict=True):
        draw_line(panel, order, x, y)
        if first:
            top = int(np.argmax(y))
            panel.annotate(
                f"{load * 1e-3:.1f} kN",
                (x[top], y[top]),
                xytext=(0, 2),
                textcoords="offset points",
                ha="center",
                va="bottom",
                fontsize=7.0,
                color=MUTED,
                bbox={"boxstyle": "round,pad=0.08", "facecolor": PAPER, "edgecolor": "none", "alpha": 0.8},
            )
    panel.set_xlim(x[0], x[-1])
    label_axes(panel, "slip angle [°]", "aligning moment [N m]")


def _combined(panel: Axes, order: int, tyre: TyreCurves) -> None:
    """Lines of constant slip angle; the dotted ellipse has the largest of each force as its half axes."""
    first = not panel.lines
    straight = int(np.argmin(np.abs(tyre.combined_kappa)))
    if tyre.friction is not None:
        turn = np.linspace(0, 2 * math.pi, 181)
        x, y = tyre.friction[0] * np.cos(turn), tyre.friction[1] * np.sin(turn)
        panel.plot(x * 1e-3, y * 1e-3, color=colour(order), linestyle=":", linewidth=1.1)
    for angle, x, y in zip(tyre.angles, tyre.combined_longitudinal * 1e-3, tyre.combined_lateral * 1e-3, strict=True):
        panel.plot(x, y, color=colour(order), linewidth=1.2)
        if first and angle != 0.0:
            panel.annotate(
                f"{math.degrees(angle):.0f}°".replace("-", "−"),
                (x[straight], y[straight]),
                ha="center",
                va="center",
                fontsize=6.5,
                color=MUTED,
                bbox={"boxstyle": "round,pad=0.12", "facecolor": PAPER, "edgecolor": "none"},
            )
    panel.margins(0.05)
    panel.set_aspect("equal", adjustable="datalim")
    label_axes(panel, "longitudinal force [kN]", "lateral force [kN]")


_PLOTS: dict[str, Callable[[Axes, int, TyreCurves], None]] = {
    "tyre_longitudinal_force_characteristic": _longitudinal,
    "tyre_lateral_force_characteristic": _lateral,
    "tyre_aligning_moment_characteristic": _aligning,
    "tyre_combined_slip_characteristic": _combined,
}
