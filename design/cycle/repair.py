"""Repairs: what a candidate that missed a target is changed into, and why."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from evaluation.display import quantity_text
from evaluation.story import Finding
from susp_mj.names import AXLES
from vehicles.vehicle import DESIGN_LOAD

from .characteristics import NATURAL, Tried, least_frequency, rebound_limit
from .knobs import Values

STIFFER, SOFTER, FURTHER = 1.15, 0.95, 0.05
LEAST = 0.01
"""A knob that would move by less than this share is at its end."""


@dataclass(frozen=True)
class Repair:
    """A change of the candidate.

    Attributes:
        changes: knob -> value in SI; empty if nothing can be changed.
        because: what was changed and why; or why nothing can be.
    """

    changes: Values
    because: str


def repair(tried: Tried, missed: Sequence[Finding], asked: str | None) -> Repair:
    """The change that the first missed step asks for.

    Args:
        tried: the candidate.
        missed: what it missed in one step.
        asked: name of the repair that a check asks for.
    """
    rule = _BY_NAME.get(asked or "") or _BY_STEP.get(missed[0].step)
    if rule is None:
        return Repair({}, "no repair is known for it")
    wished = rule(tried, missed)
    held = [knob for knob in wished.changes if knob in tried.layout.held]
    free = {knob: value for knob, value in wished.changes.items() if knob not in held}
    if held and not free:
        return Repair({}, f"{_in_a_row(held)} {'is' if len(held) == 1 else 'are'} held, and nothing else would help")
    return Repair(free, wished.because + (f"; {_in_a_row(held)} held" if held else ""))


def _axles(missed: Sequence[Finding]) -> list[str]:
    """Axles that the findings are of; both where they name none."""
    named = [name for name in AXLES if any(f"{name} axle" in each.where for each in missed)]
    return named or list(AXLES)


def _of_load_range(tried: Tried, missed: Sequence[Finding]) -> Repair:
    """Raise the frequency to what the load range needs; soften rebound where it would leave too little force."""
    values, changes, words = tried.layout.values(tried.candidate), {}, []
    for name in _axles(missed):
        of_axle = [each for each in missed if f"{name} axle" in each.where]
        if any(each.target == "travel left in compression" for each in of_axle):
            least = least_frequency(tried, name)
            if least is None:
                return Repair({}, f"no spring of the {name} axle does: the largest step takes all travel")
            needed = math.ceil(100 * least) / 100
            changes[f"{name}.frequency"] = needed
            words.append(f"{name} frequency raised to {needed:.2f} Hz, which the load range needs")
        if any(each.target == "force at the rebound stop" for each in of_axle):
            rate = rebound_limit(tried, name)
            if rate <= 0:
                return Repair({}, f"no spring of the {name} axle keeps that force at its rebound stop")
            changes[f"{name}.rebound_rate"] = rate
            words.append(f"{name} rebound softened to {quantity_text(rate, 'N/m')}, which keeps the force at the stop")
        elif any(each.target == "travel left in rebound" for each in of_axle):
            rate = float(values[f"{name}.rebound_rate"]) * STIFFER
            changes[f"{name}.rebound_rate"] = rate
            words.append(f"{name} rebound stiffened to {quantity_text(rate, 'N/m')} to keep travel when empty")
    return Repair(changes, ", ".join(words))


def _more_damping(tried: Tried, missed: Sequence[Finding]) -> Repair:
    """Turn the damper rate in proportion to what is missing, in steps of 100 N s/m, up to the largest one."""
    values, most, changes, words = tried.layout.values(tried.candidate), tried.layout.targets.dampers.most, {}, []
    for name in _axles(missed):
        rate = float(values[f"{name}.damping"])
        shares = [_lacking(each) for each in missed if f"{name} axle" in each.where] or [STIFFER]
        if min(shares) < 1 < max(shares):
            return Repair({}, f"no damping of the {name} axle does for all loads")
        needed = rate * (max(shares) if max(shares) > 1 else min(shares))
        rounded = math.ceil(needed / 100) * 100.0 if needed > rate else max(math.floor(needed / 100) * 100.0, 100.0)
        if needed > most:
            return Repair({}, f"{name} damping of {needed:.0f} N s/m would be needed, allowed are {most:.0f}")
        changes[f"{name}.damping"] = min(rounded, most)
        words.append(f"{name} damping {'raised' if needed > rate else 'lowered'} to {min(rounded, most):.0f} N s/m")
    return Repair(changes, ", ".join(words))


def _lacking(finding: Finding) -> float:
    """Factor on the damper rate that brings a damping ratio into its band; `STIFFER` for anything else."""
    if finding.target != "damping ratio" or not finding.value:
        return STIFFER
    if finding.minimum is not None and finding.value < finding.minimum:
        return finding.minimum / finding.value
    return (finding.maximum or finding.value) / finding.value


def _of_steps(tried: Tried, missed: Sequence[Finding]) -> Repair:
    """Stiffer compression where stops are hit; more damping where the body only overshoots."""
    hits = [each for each in missed if each.target == "stop hits"]
    return _stiffer_compression(tried, hits) if hits else _more_damping(tried, missed)


def _of_frequencies(tried: Tried, missed: Sequence[Finding]) -> Repair:
    """The frequency that is asked for; flat ride and spread follow from springs that something else decides."""
    asked: dict[str, float] = {**tried.layout.targets.ride.frequency}
    low = [name for name in AXLES for each in missed if each.target == NATURAL and f"{name} axle" in each.where]
    words = ", ".join(f"{name} frequency raised to {asked[name]:.2f} Hz, which is asked" for name in low)
    return Repair({f"{name}.frequency": asked[name] for name in low}, words or "no repair is known for it")


def _stiffer_compression(tried: Tried, missed: Sequence[Finding]) -> Repair:
    values = tried.layout.values(tried.candidate)
    changes = {f"{name}.frequency": float(values[f"{name}.frequency"]) + FURTHER for name in _axles(missed)}
    words = ", ".join(f"{knob.split('.')[0]} frequency raised to {value:.2f} Hz" for knob, value in changes.items())
    return Repair(changes, words)


def _stiffer_rebound(tried: Tried, missed: Sequence[Finding]) -> Repair:
    values, changes = tried.layout.values(tried.candidate), {}
    for name in AXLES:
        rate = float(values[f"{name}.rebound_rate"])
        wished = min(STIFFER * rate, rebound_limit(tried, name))
        if wished > (1 + LEAST) * rate:
            changes[f"{name}.rebound_rate"] = wished
    if not changes:
        return Repair({}, "the rebound springs are as stiff as the force at their stops lets them be")
    words = ", ".join(
        f"{knob.split('.')[0]} rebound stiffened to {quantity_text(value, 'N/m')}" for knob, value in changes.items()
    )
    return Repair(changes, words)


def _softer_rebound(tried: Tried, missed: Sequence[Finding]) -> Repair:
    values = tried.layout.values(tried.candidate)
    changes = {f"{name}.rebound_rate": SOFTER * float(values[f"{name}.rebound_rate"]) for name in _axles(missed)}
    words = ", ".join(
        f"{knob.split('.')[0]} rebound softened to {quantity_text(value, 'N/m')}" for knob, value in changes.items()
    )
    return Repair(changes, words)


def _of_bars(tried: Tried, missed: Sequence[Finding]) -> Repair:
    """Softer rebound springs where they alone exceed the roll stiffness; nothing where bars would carry too much."""
    exceeding = [each for each in missed if each.target == "rate left to the bar"]
    if not exceeding:
        return Repair({}, "stiffer springs would leave less to the bars, but the ride decides the springs")
    values = tried.layout.values(tried.candidate)
    names = _axles(exceeding)
    soft = [name for name in names if float(values[f"{name}.rebound_rate"]) < 0.2 * _compression_rate(tried, name)]
    if soft:
        return Repair({}, f"the {_in_a_row(soft)} rebound springs are as soft as they may be")
    return _softer_rebound(tried, exceeding)


def _compression_rate(tried: Tried, name: str) -> float:
    frequency = float(tried.layout.values(tried.candidate)[f"{name}.frequency"])
    return tried.car.corner_mass(name, DESIGN_LOAD) * (2 * math.pi * frequency) ** 2


def _in_a_row(words: Sequence[str]) -> str:
    return " and ".join(words)


Rule = Callable[[Tried, Sequence[Finding]], Repair]
_BY_STEP: dict[str, Rule] = {
    "load range": _of_load_range,
    "damping": _more_damping,
    "frequencies": _of_frequencies,
    "steps": _of_steps,
    "bars": _of_bars,
}
_BY_NAME: dict[str, Rule] = {
    "stiffer_compression": _stiffer_compression,
    "stiffer_rebound": _stiffer_rebound,
    "softer_rebound": _softer_rebound,
    "more_damping": _more_damping,
}
