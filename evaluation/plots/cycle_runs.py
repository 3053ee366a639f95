"""Plots of the runs of a design cycle, as in the thesis' appendix 9, each with what is asked as a line.

What is drawn follows from what a run is: an oscillation model on a road that steps, a slowly tightened turn, a sweep, a
manoeuvre that shows quantities together.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from susp_mj.run import Run

from ..colours import INK, MUTED
from ..display import quantity_text
from ..numbers import NUMBERS
from ..numbers.frequency import amplification, road_swept
from ..numbers.ride import final_value
from ..numbers.runs import character, drives, facts, on_tyres
from ..numbers.steering_frequency import steering_response
from ..numbers.transient import STEPPED, step_response
from ..numbers.turns import TIGHTENED, inner, stations_of, tightening
from ..story import Finding, Story
from .candidates import Cast, Plot, Scene, draw_limits, scenes
from .channels import STATIONS, station_name
from .figure import colour, draw_svg, label_axes, limit_line, short_label, stop_line, stop_lines, zero_line
from .over_time import moves, together_label, together_line, together_unit
from .steering import STEERED, gain_unit, over_frequency
from .turns import ACCELERATION, from_zero, mark_lifts, over_acceleration

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_WIDE = (8.78, 2.15)
"""An only panel as wide as two."""


def run_plots(story: Story, cast: Cast) -> dict[str, list[Plot]]:
    """Figures of a cycle's runs, by the heading under which they stand; a check of which none is drawn has an empty
    list."""
    found = list(scenes(story, cast))
    steps = [each for each in found if _steps(each)]
    sections = {"steps of the road": list(_step_plots(steps, cast))} if steps else {}
    for each in found:
        if each not in steps:
            sections.setdefault(each.check, []).extend(_plots_of(each, cast))
    return sections


def _first(scene: Scene) -> Run:
    return next(iter(scene.runs.values()))


def _plots_of(scene: Scene, cast: Cast) -> Iterator[Plot]:
    """Figures of one check at one place, by what its manoeuvre is."""
    run = _first(scene)
    if run in TIGHTENED:
        yield from _turn_plots(scene, cast)
    elif drives(run) and steering_response(run, STEERED[0]) is not None:
        svg = draw_svg(_gain_figure, scene, cast)
        yield Plot("Amplification of the steering wheel over frequency", scene.where, svg)
    elif drives(run):
        quantities = [each for each in character(run).together if any(moves(one, each) for one in scene.runs.values())]
        if quantities:
            svg = draw_svg(_together_figure, scene, cast, quantities)
            yield Plot(f"{character(run).title} over time", f"{scene.where}; positive to the left, nose down", svg)
    elif not on_tyres(run):
        yield from _vibration_plots(scene, cast)


# ---- steps of the road


def _steps(scene: Scene) -> bool:
    """Whether the road under an oscillation model goes from one height to another, and stays there."""
    run = _first(scene)
    roads = run.stations("road_height").values()
    return (
        not on_tyres(run) and any(road[-1] != road[0] for road in roads) and all(_goes_one_way(road) for road in roads)
    )


def _goes_one_way(road: np.ndarray) -> bool:
    slope = np.diff(road)
    return bool((slope >= 0).all() or (slope <= 0).all())


def _height(run: Run) -> float:
    """By how much the road rises [m]."""
    return max((float(road[-1] - road[0]) for road in run.stations("road_height").values()), key=abs)


def _step_plots(steps: Sequence[Scene], cast: Cast) -> Iterator[Plot]:
    """Body and suspension after the smallest and the two largest steps at the place where least travel is left, and
    after every step that a check asks for; body acceleration on the largest one that reaches no stop."""
    place = min(steps, key=_room).place
    there = sorted((each for each in steps if each.place == place), key=lambda each: abs(_height(_first(each))))
    chosen = [there[0], *there[1:][-2:]]
    for each in [*chosen, *(each for each in steps if each.held and each not in chosen)]:
        svg = draw_svg(_step_figure, each, cast)
        yield Plot(f"After a step of {quantity_text(_height(_first(each)), 'm')}", f"{each.where}; {_hits(each)}", svg)
    free = [each for each in there if not any(_stop_hits(run) for run in each.runs.values())]
    on = free[-1] if free else there[0]
    title = f"Body acceleration on a step of {quantity_text(_height(_first(on)), 'm')}"
    yield Plot(title, f"{on.where}; positive upwards", draw_svg(_acceleration_figure, on, cast))


def _room(scene: Scene) -> float:
    """Smallest distance to a stop that any candidate leaves [m]."""
    left = ("travel_left_compression", "travel_left_rebound")
    found = [NUMBERS[name](run).value for name in left for run in scene.runs.values()]
    return min((each for each in found if each is not None), default=np.inf)


def _stop_hits(run: Run) -> int:
    return int(NUMBERS["stop_hits"](run).value or 0)


def _hits(scene: Scene) -> str:
    """How often which candidate hits a stop."""
    hits = {name: _stop_hits(run) for name, run in scene.runs.items()}
    if not any(hits.values()):
        return "no stop is hit"
    return "stop hits, marked ×: " + ", ".join(f"{name} {count}" for name, count in hits.items())


def _step_figure(scene: Scene, cast: Cast) -> Figure:
    """Rise of the body, and suspension deflection with its stops and the hits on them."""
    run = _first(scene)
    stations = list(run.stations("suspension_deflection"))
    titles = [
        "rise of the body; thin: the road",
        *(f"suspension deflection {station_name(each)}".strip() for each in stations),
    ]
    figure, (rise, *travels) = cast.panels(list(scene.runs), titles)
    _draw_rise(rise, scene, cast)
    for panel, station in zip(travels, stations, strict=True):
        for name in cast.kept_first(scene.runs):
            each = scene.runs[name]
            deflection = each.stations("suspension_deflection")[station]
            cast.line(panel, name, each.time, deflection * 1e3)
            _mark_hits(panel, cast.order(name), each, deflection, each.meta["travel"][station])
        for rebound, compression in sorted({tuple(each.meta["travel"][station]) for each in scene.runs.values()}):
            stop_lines(panel, rebound * 1e3, compression * 1e3, horizontal=True, named=True)
        zero_line(panel)
        _over_time(panel, scene, "suspension deflection [mm]")
    return figure


def _draw_rise(panel: Axes, scene: Scene, cast: Cast) -> None:
    run = _first(scene)
    for road in run.stations("road_height").values():
        panel.plot(run.time, (road - road[0]) * 1e3, color=MUTED, linewidth=0.8)
    for name in cast.kept_first(scene.runs):
        displacement = scene.runs[name]["body_displacement"]
        cast.line(panel, name, scene.runs[name].time, (displacement - displacement[0]) * 1e3)
    last = list(scene.runs)[-1]
    displacement = scene.runs[last]["body_displacement"]
    rise = final_value(displacement - displacement[0]) * 1e3
    if NUMBERS["overshoot"](scene.runs[last]).value is not None:
        _limit_overshoot(panel, scene.asked("overshoot"), rise, last)
    _over_time(panel, scene, "rise of the body [mm]")


def _limit_overshoot(panel: Axes, asked: Finding | None, steady: float, name: str) -> None:
    """What may be overshot by a candidate that comes to rest at `steady`."""
    if asked is not None and asked.maximum is not None:
        limit_line(panel, (1 + asked.maximum) * steady, f"asked of {short_label(name)}: overshoot {asked.band}")


def _mark_hits(panel: Axes, order: int, run: Run, deflection: np.ndarray, stops: Sequence[float]) -> None:
    """A cross at every instant at which a stop is hit."""
    for stop, beyond in zip(stops, (deflection < stops[0], deflection > stops[1]), strict=True):
        at = np.flatnonzero(beyond & ~np.concatenate([[False], beyond[:-1]]))
        panel.plot(run.time[at], np.full(len(at), stop * 1e3), "x", color=colour(order), markersize=6, zorder=3)


def _acceleration_figure(scene: Scene, cast: Cast) -> Figure:
    figure, (panel,) = cast.panels(list(scene.runs), [""], size=_WIDE)
    for name in cast.kept_first(scene.runs):
        cast.line(panel, name, scene.runs[name].time, scene.runs[name]["body_acceleration"])
    zero_line(panel)
    for bound in ("max", "min"):
        draw_limits(panel, scene.asked(f"body acceleration {bound}"))
    _over_time(panel, scene, "body acceleration [m/s²]")
    return figure


def _over_time(panel: Axes, scene: Scene, label: str) -> None:
    panel.set_xlim(0, max(float(each.time[-1]) for each in scene.runs.values()))
    label_axes(panel, "time [s]", label)


# ---- other runs of oscillation models


def _vibration_plots(scene: Scene, cast: Cast) -> Iterator[Plot]:
    """Amplification over frequency on a road that is swept, body and suspension over time on any other."""
    run = _first(scene)
    if road_swept(run):
        yield Plot("Amplification of the road", f"{scene.where}", draw_svg(_amplification_figure, scene, cast))
    elif run.stations("suspension_deflection"):
        svg = draw_svg(_step_figure, scene, cast)
        yield Plot(f"{character(run).title or scene.check} over time", f"{scene.where}; {_hits(scene)}", svg)
        svg = draw_svg(_acceleration_figure, scene, cast)
        yield Plot("Body acceleration", f"{scene.where}; positive upwards", svg)


_AMPLIFIED = {
    "body_displacement": ("body displacement / road height [–]", "body amplification"),
    "body_acceleration": ("body acceleration / road height [1/s²]", "body acceleration amplification"),
}


def _amplification_figure(scene: Scene, cast: Cast) -> Figure:
    """How much the body moves and is accelerated for each metre of road."""
    figure, panels = cast.panels(list(scene.runs), ["", ""])
    for panel, (quantity, (label, target)) in zip(panels, _AMPLIFIED.items(), strict=True):
        for name in cast.kept_first(scene.runs):
            found = amplification(scene.runs[name], quantity)
            if found is not None:
                cast.line(panel, name, found.frequency, np.abs(found.ratio))
        over_frequency(panel)
        panel.set_ylim(bottom=0)
        draw_limits(panel, scene.asked(target))
        label_axes(panel, "frequency [Hz]", label)
    return figure


# ---- a car that drives


def _turn_plots(scene: Scene, cast: Cast) -> Iterator[Plot]:
    """Roll, travel and load of the inner wheels of a slowly tightened turn."""
    about = f"{scene.where}; up to the largest lateral acceleration"
    yield Plot(
        "Roll angle over lateral acceleration",
        f"{about}; the suspension's roll is the mean of both axles, the body rolls on its tyres as well",
        draw_svg(_roll_figure, scene, cast),
    )
    yield Plot(
        "Travel of the inner wheels over lateral acceleration",
        f"{about}; negative in rebound",
        draw_svg(_inner_travel_figure, scene, cast),
    )
    yield Plot(
        "Load of the inner wheels over lateral acceleration",
        f"{about}; at zero the wheel lifts, a ring marks it",
        draw_svg(_inner_load_figure, scene, cast),
    )


def _draw_over_acceleration(
    panel: Axes, scene: Scene, cast: Cast, values: Mapping[str, np.ndarray], label: str
) -> None:
    """A line for each candidate over its lateral acceleration, and the one that is asked for."""
    for name in cast.kept_first(scene.runs):
        turning = tightening(scene.runs[name])
        cast.line(panel, name, *over_acceleration(turning.acceleration, turning.part(values[name])))
    draw_limits(panel, scene.asked("lateral acceleration max"), horizontal=False)
    label_axes(panel, ACCELERATION, label)


def _roll_figure(scene: Scene, cast: Cast) -> Figure:
    runs = scene.runs
    sides = {name: tightening(run).side for name, run in runs.items()}
    body = {name: sides[name] * np.degrees(run["roll_angle"] - run["roll_angle"][0]) for name, run in runs.items()}
    suspension = {
        name: sides[name] * np.degrees(_suspension_roll(run))
        for name, run in runs.items()
        if all(f"track_{axle}" in facts(run) for axle in ("front", "rear"))
    }
    drawn = {"roll of the suspension": suspension, "roll of the body": body}
    drawn = {title: values for title, values in drawn.items() if len(values) == len(runs)}
    figure, panels = cast.panels(list(runs), list(drawn), share_y=True)
    asked = scene.asked("roll angle", "roll angle max", "roll angle at 7", "roll angle at 4", anywhere=True)
    for panel, values in zip(panels, drawn.values(), strict=True):
        _draw_over_acceleration(panel, scene, cast, values, "roll angle [°]")
        draw_limits(panel, asked, end="left")
    from_zero(*panels)
    return figure


def _suspension_roll(run: Run) -> np.ndarray:
    """Roll by the deflections of the wheels, mean of both axles, positive left side up [rad]: ``(z_r - z_l)/t``."""
    rolls = []
    for axle in ("front", "rear"):
        left, right = (run[f"{station}_suspension_deflection"] for station in stations_of(axle))
        rolls.append((right - left) / facts(run)[f"track_{axle}"])
    roll = (rolls[0] + rolls[1]) / 2
    return roll - roll[0]


def _inner_travel_figure(scene: Scene, cast: Cast) -> Figure:
    """Travel of the inner front and rear wheel, with the rebound stop and the travel to be left."""
    figure, panels = _inner_panels(scene, cast)
    for row, (panel, axle) in enumerate(zip(panels, ("front", "rear"), strict=True)):
        stations = {name: inner(run)[row] for name, run in scene.runs.items()}
        values = {name: run[f"{stations[name]}_suspension_deflection"] * 1e3 for name, run in scene.runs.items()}
        _draw_over_acceleration(panel, scene, cast, values, "suspension deflection [mm]")
        for stop in sorted({run.meta["travel"][stations[name]][0] * 1e3 for name, run in scene.runs.items()}):
            stop_line(panel, stop, "rebound stop", "top", "left")
            draw_limits(panel, scene.asked(f"travel left rebound {axle}"), start=stop, end="left")
    low, high = panels[0].get_ylim()  # of both, which share it
    panels[0].set_ylim(low - 0.07 * (high - low), high)
    for panel in panels:
        zero_line(panel)
    from_zero(*panels)
    return figure


def _inner_load_figure(scene: Scene, cast: Cast) -> Figure:
    """Load of the inner front and rear wheel; at zero it lifts."""
    figure, panels = _inner_panels(scene, cast)
    for row, (panel, axle) in enumerate(zip(panels, ("front", "rear"), strict=True)):
        values = {name: run[f"{inner(run)[row]}_wheel_load"] * 1e-3 for name, run in scene.runs.items()}
        _draw_over_acceleration(panel, scene, cast, values, "wheel load [kN]")
        draw_limits(panel, scene.asked(f"inner wheel load {axle}"), end="left")
        panel.axhline(0, color=INK, linewidth=0.9)
    lifted = mark_lifts([(cast.order(name), run) for name, run in scene.runs.items()], panels)
    top = max(panel.dataLim.y1 for panel in panels)
    panels[0].set_ylim(
        -(0.14 + 0.06 * len(scene.runs) if lifted else 0.06) * top, 1.06 * top
    )  # of both, which share it
    from_zero(*panels)
    return figure


def _inner_panels(scene: Scene, cast: Cast) -> tuple[Figure, list[Axes]]:
    """A panel for the inner front, and one for the inner rear wheel."""
    sides = {inner(run) for run in scene.runs.values()}
    names = [STATIONS[each] for each in sides.pop()] if len(sides) == 1 else ["front", "rear"]
    return cast.panels(list(scene.runs), [f"{each}, inner wheel" for each in names], share_y=True)


def _together_figure(scene: Scene, cast: Cast, quantities: Sequence[str]) -> Figure:
    """What the manoeuvre shows together over time, with the overshoot that is asked of the last candidate."""
    figure, panels = cast.panels(list(scene.runs), ["" for _ in quantities])
    last = list(scene.runs)[-1]
    for panel, quantity in zip(panels, quantities, strict=True):
        for name in cast.kept_first(scene.runs):
            if quantity in scene.runs[name]:
                cast.line(panel, name, *together_line(scene.runs[name], quantity))
        asked = scene.asked(f"{quantity} overshoot".replace("_", " "))
        if asked is not None and scene.runs[last] in STEPPED:
            steady = step_response(scene.runs[last], quantity).steady * together_unit(quantity).factor
            _limit_overshoot(panel, asked, steady, last)
        zero_line(panel)
        _over_time(panel, scene, together_label(quantity))
    return figure


def _gain_figure(scene: Scene, cast: Cast) -> Figure:
    """Gain of each quantity per steering wheel angle over frequency."""
    quantities = [each for each in STEERED if all(each in run for run in scene.runs.values())]
    figure, panels = cast.panels(list(scene.runs), [each.replace("_", " ") for each in quantities])
    for panel, quantity in zip(panels, quantities, strict=True):
        unit, factor = gain_unit(quantity)
        for name in cast.kept_first(scene.runs):
            found = steering_response(scene.runs[name], quantity)
            if found is not None:
                cast.line(panel, name, found.frequency, found.gain * factor)
        over_frequency(panel)
        panel.set_ylim(0, 1.12 * panel.dataLim.y1)
        words = quantity.replace("_", " ")
        draw_limits(panel, scene.asked(f"{words} gain peak", f"{words.removesuffix(' angle')} gain peak"))
        label_axes(panel, "frequency [Hz]", f"gain [{unit}]")
    return figure
