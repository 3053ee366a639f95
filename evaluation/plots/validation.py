"""Plots of a comparison with measurements: the simulated line, the measurements, the band around their mean."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..colours import INK
from ..display import shown
from ..validation import Findings, Judgement
from .figure import colour, draw_svg, label_axes, make_panels, thinned

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_FEW = 40
"""Up to so many points are marked one by one."""


def validation_plots(findings: Findings) -> dict[str, str]:
    """A plot for each channel, as SVG text by name."""
    return {"_".join(each.channel.split()): draw_svg(_figure, each, findings) for each in findings.judgements}


def _figure(each: Judgement, findings: Findings) -> Figure:
    """Both curves, and beside them their difference in the band that it must keep to."""
    figure, (curves, difference) = make_panels(
        ["mean of the measurements and its band", "simulated"], ["", "simulated less mean"]
    )
    over, own = shown(findings.over_unit), shown(each.unit)
    x, mean, half, simulated = (
        each.abscissa * over.factor,
        *(values * own.factor for values in (each.mean, each.half, each.simulated)),
    )
    mark, at = "o" if len(x) <= _FEW else "", each.worst
    for panel, middle, lines in ((curves, mean, (mean, simulated)), (difference, 0 * mean, (None, simulated - mean))):
        panel.fill_between(x, middle - half, middle + half, color=colour(0), alpha=0.18, linewidth=0)
        for order, values in enumerate(lines):
            if values is not None:
                panel.plot(*thinned(x, values), color=colour(order), linewidth=1.5, marker=mark, markersize=3)
        panel.plot(x[at], lines[1][at], "o", color=INK, markersize=7, fillstyle="none")
        label_axes(panel, _label(findings.over or "time", over.unit), _label(each.channel, own.unit))
    for one in each.measured if len(each.measured) > 1 else ():
        curves.plot(*thinned(x, one * own.factor), color=colour(0), linewidth=0.5, alpha=0.6)
    return figure


def _label(channel: str, unit: str) -> str:
    return f"{channel.replace('_', ' ')} [{unit}]" if unit else channel.replace("_", " ")
