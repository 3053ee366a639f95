"""Stage 1 of a cycle: springs, dampers and bars held against the targets, in closed form and on oscillation models."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from evaluation.display import quantity_text
from evaluation.numbers import Number
from evaluation.story import Finding
from susp_mj.elements import GRAVITY
from susp_mj.errors import InputError
from susp_mj.names import AXLES
from vehicles.rates import RollNeeds, damping_ratio, roll_needs, static_deflection, static_rate
from vehicles.vehicle import DESIGN_LOAD, Vehicle

from .candidate import Candidate, Layout
from .ledger import Answered, Asked
from .targets import Limits, Roll

Ask = Callable[[list[Asked]], list[Answered]]
POSSIBLE, NATURAL = "possible", "natural frequency"
"""Targets that others ask about by name."""
EVEN = 0.01
"""Share of an axle's need by which springs may exceed it before a bar of zero is a miss."""
ONE_MASS = "quarter_1dof"
"""Model on which steps of the road are tried: the wheel follows the road."""
ROLLING = "full_3dof"
"""Model on which the roll is tried."""
ON_STEPS = ("stop_hits", "overshoot", "contact_loss_time")


def place_name(load: str, axle: str | None) -> str:
    """Where something is, as findings name it."""
    return f"{axle} axle, {load}" if axle else load


def step_of(height: float) -> dict[str, Any]:
    """Table of the step of the road [m]."""
    return {"kind": "step", "height": height, "duration": 2.5}


def lateral_force_of(roll: Roll) -> dict[str, Any]:
    """Table of the force under which the roll is tried."""
    return {"kind": "lateral_force", "acceleration": roll.lateral_acceleration}


@dataclass(frozen=True)
class Tried:
    """A candidate under test.

    Attributes:
        layout: targets and car.
        candidate: as it is.
        car: its vehicle.
        ask: answers what is asked of runs.
    """

    layout: Layout
    candidate: Candidate
    car: Vehicle
    ask: Ask

    @classmethod
    def of(cls, layout: Layout, candidate: Candidate, ask: Ask) -> Tried:
        """A candidate with its car."""
        return cls(layout, candidate, layout.vehicle(candidate), ask)

    def run(
        self,
        label: str,
        model: str,
        load: str,
        axle: str | None,
        manoeuvre: Mapping[str, Any],
        numbers: tuple[str, ...],
        step: float | None = None,
        key: str = "",
    ) -> Asked:
        """One run of the candidate."""
        return Asked(
            f"{self.candidate.name}, {label}",
            key,
            self.car,
            self.layout.hash_of(self.car),
            model,
            load,
            axle,
            manoeuvre,
            numbers,
            step,
        )

    def step(self, height: float, axle: str, load: str) -> Asked:
        """A step of the road [m] under one axle."""
        label = f"step of {quantity_text(height, 'm')}, {place_name(load, axle)}"
        return self.run(label, ONE_MASS, load, axle, step_of(height), ON_STEPS)

    def corner_force(self, axle: str, load: str) -> float:
        """Static force [N] on one wheel's spring."""
        return self.car.corner_mass(axle, load) * GRAVITY


def possible(layout: Layout, candidate: Candidate) -> Finding | None:
    """That the turned knobs make a spring at all; None if they do."""
    try:
        car = layout.vehicle(candidate)
        for name in AXLES:
            car.axle(name)
    except InputError as error:
        key = error.key.split(".")[0]
        return Finding(
            "characteristics",
            POSSIBLE,
            key,
            "",
            {},
            None,
            "",
            0.0,
            note=str(error),
            words=f"is not possible: {error}",
        )
    return None


def load_range(tried: Tried) -> Iterator[Finding]:
    """Travel that the largest step leaves at the largest load, and force and travel that rebound keeps."""
    targets = tried.layout.targets
    height = max(targets.travel.steps, default=0.0)
    for name in AXLES:
        spring = tried.car.axle(name).spring
        stop, design = spring.stops, tried.corner_force(name, DESIGN_LOAD)
        heaviest = max(targets.loads, key=lambda load: tried.corner_force(name, load))
        lightest = min(targets.loads, key=lambda load: tried.corner_force(name, load))
        static = static_deflection(spring, tried.corner_force(name, heaviest))
        left, asked = stop.compression - static - height, least_frequency(tried, name)
        needs = "no frequency does" if asked is None else f"needs at least {quantity_text(asked, 'Hz')}"
        short = targets.travel.reserve - left
        yield Finding(
            "load range",
            "travel left in compression",
            place_name(heaviest, name),
            "x_max - x_static - h >= reserve, so f >= sqrt(g ln(F/F_0)/(x_max - h - reserve))/2π",
            {
                "x_max": quantity_text(stop.compression, "m"),
                "x_static": quantity_text(static, "m"),
                "h": quantity_text(height, "m"),
                "F/F_0": f"{tried.corner_force(name, heaviest) / design:.3f}",
            },
            left,
            "m",
            targets.travel.reserve,
            note=needs,
            words=(
                f"the {name} springs of {quantity_text(_frequency(tried, name), 'Hz')} do not carry the load range: at "
                f"load {heaviest} they stand {quantity_text(static, 'm')} in compression, and a step of "
                f"{quantity_text(height, 'm')} would need {quantity_text(short, 'm')} more travel than the "
                f"{quantity_text(stop.compression, 'm')} to the stop; {needs}"
            ),
        )
        static = static_deflection(spring, tried.corner_force(name, lightest))
        yield Finding(
            "load range",
            "travel left in rebound",
            place_name(lightest, name),
            "x_static - x_min > 0",
            {"x_static": quantity_text(static, "m"), "x_min": quantity_text(stop.rebound, "m")},
            static - stop.rebound,
            "m",
            1e-3,
            words=f"the {name} springs stand on their rebound stop at load {lightest}",
            assumed=True,
        )
        force, least = float(spring.force_at(stop.rebound)), targets.ride.rebound_force
        yield Finding(
            "load range",
            "force at the rebound stop",
            f"{name} axle",
            "F_0 - k_r |x_min|",
            {"F_0": quantity_text(design, "N"), "x_min": quantity_text(stop.rebound, "m")},
            force,
            "N",
            least,
            words=f"the {name} springs keep {force:.0f} N at the rebound stop, {least - force:.0f} N less than asked",
            assumed="rebound_force" not in targets.ride.model_fields_set,
        )


def least_frequency(tried: Tried, name: str) -> float | None:
    """Natural frequency [Hz] with which a spring of constant frequency carries the load range, the largest step and the
    reserve on top; None if no spring does."""
    targets = tried.layout.targets
    ratio = max(tried.corner_force(name, load) for load in targets.loads) / tried.corner_force(name, DESIGN_LOAD)
    stop = tried.car.axle(name).spring.stops.compression
    room = stop - max(targets.travel.steps, default=0.0) - targets.travel.reserve
    return math.sqrt(GRAVITY * math.log(max(ratio, 1.0)) / room) / (2 * math.pi) if room > 0 else None


def _frequency(tried: Tried, axle: str) -> float:
    return float(tried.layout.values(tried.candidate)[f"{axle}.frequency"])


def frequencies(tried: Tried) -> Iterator[Finding]:
    """The natural frequencies, flat ride and the spread over the loads, where they are asked for."""
    ride, loads = tried.layout.targets.ride, tried.layout.targets.loads
    for name, asked in ride.frequency.items():
        found = _frequency(tried, name)
        words = (
            f"the {name} axle has {quantity_text(found, 'Hz')} in compression, asked is {quantity_text(asked, 'Hz')}"
        )
        what = ("frequencies", NATURAL, f"{name} axle", "of the body in compression, at the design load")
        yield Finding(*what, {}, found, "Hz", asked * (1 - 1e-9), words=words)
    natural = {
        (name, load): _natural(tried, name, load) for name in AXLES for load in dict.fromkeys((DESIGN_LOAD, *loads))
    }
    if ride.flat_ride is not None:
        front, rear = natural["front", DESIGN_LOAD], natural["rear", DESIGN_LOAD]
        yield _banded(
            ride.flat_ride,
            rear / front,
            ("frequencies", "flat ride, rear over front", DESIGN_LOAD, "f_rear/f_front"),
            {"f_front": quantity_text(front, "Hz"), "f_rear": quantity_text(rear, "Hz")},
            f"the rear axle's frequency is {rear / front:.3f} of the front axle's",
        )
    if ride.frequency_spread is not None:
        for name in AXLES:
            found = [natural[name, load] for load in loads]
            spread = (max(found) - min(found)) / natural[name, DESIGN_LOAD]
            yield _banded(
                ride.frequency_spread,
                spread,
                ("frequencies", "spread over the loads", f"{name} axle", "(f_max - f_min)/f_ko, f = sqrt(k g/F)/2π"),
                {load: quantity_text(natural[name, load], "Hz") for load in loads},
                f"the frequency of the {name} axle spreads over {100 * spread:.0f} % with the load",
            )


def _natural(tried: Tried, axle: str, load: str) -> float:
    return math.sqrt(static_rate(tried.car, axle, load) / tried.car.corner_mass(axle, load)) / (2 * math.pi)


def damping(tried: Tried) -> Iterator[Finding]:
    """Damping ratio of the body on each axle at every load."""
    targets = tried.layout.targets
    values = tried.layout.values(tried.candidate)
    for name in AXLES:
        rate = float(values[f"{name}.damping"])
        for load in targets.loads:
            ratio = damping_ratio(tried.car, name, load, rate)
            low = targets.dampers.ratio.min
            side = "under" if low is not None and ratio < low else "over"
            yield _banded(
                targets.dampers.ratio,
                ratio,
                (
                    "damping",
                    "damping ratio",
                    place_name(load, name),
                    "D/(2 sqrt(k m)), k over ±1 mm, friction left out",
                ),
                {
                    "D": quantity_text(rate, "N s/m"),
                    "k": quantity_text(static_rate(tried.car, name, load), "N/m"),
                    "m": f"{tried.car.corner_mass(name, load):.1f} kg",
                },
                f"the {name} axle is {side}-damped at load {load}",
                assumed="ratio" not in targets.dampers.model_fields_set,
            )


def steps(tried: Tried) -> Iterator[Finding]:
    """Steps of the road on either axle at every load: stop hits, and the overshoot where it is limited."""
    targets = tried.layout.targets
    if not targets.travel.steps:
        return
    places = [(name, load) for name in AXLES for load in targets.loads]
    asked = [tried.step(height, name, load) for name, load in places for height in targets.travel.steps]
    answers = iter(tried.ask(asked))
    for name, load in places:
        found = [(height, next(answers)) for height in targets.travel.steps]
        yield from _on_steps(name, load, found, targets.travel.overshoot)


def _on_steps(name: str, load: str, found: list[tuple[float, Answered]], limit: float | None) -> Iterator[Finding]:
    """What the steps show on one axle at one load."""
    failed = next((answer.failed for _, answer in found if answer.failed), "")
    numbers = [(height, answer.numbers) for height, answer in found if not answer.failed]
    hits = {height: int(_value(each["stop_hits"])) for height, each in numbers if _value(each["stop_hits"])}
    off = {height: _value(each["contact_loss_time"]) for height, each in numbers if _value(each["contact_loss_time"])}
    words = ", ".join(
        f"{count} at {quantity_text(height, 'm')}"
        + (f" with {off[height]:.2f} s off the road" if height in off else "")
        for height, count in hits.items()
    )
    heights = {"h": ", ".join(quantity_text(height, "m") for height, _ in found)}
    yield Finding(
        "steps",
        "stop hits",
        place_name(load, name),
        "step of the road, quarter_1dof",
        heights,
        None if failed else float(sum(hits.values())),
        "1",
        maximum=0.0,
        note=failed or words,
        words=failed or f"the {name} axle hits its stops at load {load}: {words}",
    )
    if limit is not None:
        shoots = [(_value(each["overshoot"]), height) for height, each in numbers]
        most, height = max(shoots, default=(math.nan, 0.0))
        yield Finding(
            "steps",
            "overshoot",
            place_name(load, name),
            "(z_max - z_end)/(z_end - z_0), quarter_1dof",
            heights,
            None if failed or math.isnan(most) else most,
            "1",
            maximum=limit,
            note=failed or f"at {quantity_text(height, 'm')}",
            words=failed
            or f"the body overshoots a step of {quantity_text(height, 'm')} by {100 * most:.0f} % "
            f"on the {name} axle at load {load}",
        )


def _value(number: Number) -> float:
    return 0.0 if number.value is None else number.value


def needs_of(tried: Tried) -> RollNeeds | None:
    """What the roll targets ask of the car's axles; None if no roll is asked for."""
    roll = tried.layout.targets.roll
    if roll is None:
        return None
    return roll_needs(tried.car, roll.angle, roll.lateral_acceleration, roll.front_share, roll.load)


def bars(tried: Tried, needs: RollNeeds) -> Iterator[Finding]:
    """The bar that each axle needs, and its share of the axle's roll stiffness."""
    roll = tried.layout.targets.roll
    assert roll is not None
    asks = f"a roll of {quantity_text(roll.angle, 'rad')} at {quantity_text(roll.lateral_acceleration, 'm/s²')}"
    for name in AXLES:
        inputs = {
            "K": f"{needs.stiffness / 1000:.1f} kN m/rad",
            "k": quantity_text(needs.springs[name], "N/m"),
            "m h": f"{needs.lever:.0f} kg m",
        }
        yield Finding(
            "bars",
            "rate left to the bar",
            f"{name} axle",
            "c = 2 q K/t² - k(secant), K = m h (a_y + g φ)/φ",
            inputs,
            needs.bars[name],
            "N/m",
            -EVEN * needs.needed[name],
            words=(
                f"the springs of the {name} axle alone exceed the roll stiffness by "
                f"{quantity_text(-needs.bars[name], 'N/m')}: {asks} is more than they let"
            ),
        )
        share = max(0.0, needs.bars[name]) / needs.needed[name]
        yield _banded(
            roll.bar_share,
            share,
            ("bars", "share of the bar in the roll stiffness", f"{name} axle", "c/(c + k)"),
            inputs,
            f"{asks} leaves {100 * share:.0f} % of the {name} axle's roll stiffness to its bar",
            assumed="bar_share" not in roll.model_fields_set,
        )


def roll_runs(tried: Tried) -> list[Asked]:
    """The run under the lateral force; none where no roll is asked for."""
    roll = tried.layout.targets.roll
    if roll is None:
        return []
    numbers = ("roll_angle_final", "load_transfer_share")
    return [tried.run("lateral force", ROLLING, roll.load, None, lateral_force_of(roll), numbers)]


def rolled(tried: Tried) -> Iterator[Finding]:
    """The roll of the whole car under the lateral force, and the load transfer it shares out."""
    roll = tried.layout.targets.roll
    if roll is None:
        return
    answer = tried.ask(roll_runs(tried))[0]
    found = answer.numbers.get("roll_angle_final")
    angle = None if found is None or found.value is None else abs(found.value)
    words = answer.failed or (
        f"the body rolls by {quantity_text(angle, 'rad')} at {quantity_text(roll.lateral_acceleration, 'm/s²')}, "
        f"not by {quantity_text(roll.angle, 'rad')}"
    )
    inputs = {"a_y": quantity_text(roll.lateral_acceleration, "m/s²")}
    where, band = f"{roll.load}, at {inputs['a_y']}", (roll.angle - roll.tolerance, roll.angle + roll.tolerance)
    yield Finding(
        "roll", "roll angle", where, "lateral force, full_3dof", inputs, angle, "rad", *band, answer.failed, words
    )
    if roll.transfer_over_weight is not None and not answer.failed:
        weights = {name: tried.corner_force(name, roll.load) for name in AXLES}
        share = answer.numbers["load_transfer_share"].value
        over = math.nan if share is None else share - weights["front"] / sum(weights.values())
        yield _banded(
            roll.transfer_over_weight,
            over,
            ("roll", "load transfer share over weight share, front", where, "lateral force, full_3dof"),
            inputs,
            f"the front axle takes {100 * over:.1f} % more of the load transfer than of the weight",
        )


def _banded(
    limits: Limits,
    value: float,
    what: tuple[str, str, str, str],
    inputs: dict[str, str],
    words: str,
    *,
    assumed: bool = False,
) -> Finding:
    """Finding of a plain number against limits, its words completed by what is asked."""
    words += f": {value:.3f}, asked is {Finding(*what, inputs, value, '1', limits.min, limits.max).band}"
    return Finding(*what, inputs, value, "1", limits.min, limits.max, words=words, assumed=assumed)


def rebound_limit(tried: Tried, axle: str) -> float:
    """Largest rebound rate [N/m] that keeps the least force at the rebound stop."""
    spring = tried.car.axle(axle).spring
    least = tried.layout.targets.ride.rebound_force
    return (float(spring.force_at(0.0)) - least) / -spring.stops.rebound
