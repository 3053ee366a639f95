"""Appendix 9, step 4: the handling car in the zuziehen, and the window in which its wheel lifts as the thesis says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from evaluation.compare import Claim
from evaluation.display import quantity_text
from evaluation.reproduction import Beside, Part
from vehicles.reading import load_vehicle

from ..running import Job, Report
from .runs import CAR, Answered, numbers_of, wanted
from .stated import stated

ZUZIEHEN = {"kind": "ramp_steer"}
LOADS = ("full", "ko")
NUMBERS = (
    "lateral_acceleration_max",
    "suspension_roll_at_7",
    "inner_lift_instant_front",
    "inner_lift_time_front",
    "wheel_lift_instant",
    "inner_wheel_load_front",
    "travel_left_rebound_front",
)
STOP = 1e-4
"""Travel left [m] below which a wheel stands on its stop."""


@dataclass(frozen=True)
class Variation:
    """What differs from the shipped saloon, for both configurations.

    Attributes:
        title: one phrase.
        load: load case.
        change: overrides of the vehicle by dotted path.
        grip: of the road.
    """

    title: str
    load: str = "full"
    change: Mapping[str, Any] = field(default_factory=dict)
    grip: float = 1.0

    def run(self, number: str) -> Job:
        """The zuziehen of a configuration of the thesis."""
        manoeuvre = {**ZUZIEHEN, "grip": self.grip} if self.grip != 1.0 else ZUZIEHEN
        return wanted(f"configuration_{number}", "handling", self.load, manoeuvre, NUMBERS, change=self.change)


def zuziehen(progress: Report, workers: int | None = None) -> Part:
    """Claims of step 4."""
    jobs = {(each.title, number): each.run(number) for each in variations() for number in ("3", "4")}
    found = numbers_of(jobs, "zuziehen", progress, workers)
    by_load = {(load, number): found[_title(load), number] for load in LOADS for number in ("3", "4")}
    claims = [
        *(_roll(by_load[load, number], f"suspension_roll_{number}_{load}") for number in ("3", "4") for load in LOADS),
        *(_lifts(by_load[load, "3"], f"configuration_3_lifts_{load}") for load in LOADS),
        *(_keeps(by_load[load, "4"], f"configuration_4_keeps_travel_{load}") for load in LOADS),
        _first(by_load),
    ]
    return Part("Appendix 9, step 4: zuziehen", claims, (_window(found),))


def _title(load: str) -> str:
    return f"as it ships, load {load}"


def variations() -> list[Variation]:
    """The shipped saloon, and what is uncertain in it, one at a time."""
    cg = load_vehicle(CAR).load("full").cg
    assert cg is not None
    x, y, z = cg
    shipped = [Variation(_title(load), load) for load in (*LOADS, "empty")]
    grips = [Variation(f"grip {grip:g}", grip=grip) for grip in (0.95, 0.98, 0.99, 1.01, 1.02, 1.03, 1.05, 1.1)]
    heights = [
        Variation(f"centre of gravity {1000 * more:+.0f} mm", change={"loads.full.cg": [x, y, z + more]})
        for more in (-0.04, -0.02, 0.02, 0.04)
    ]
    tracks = [
        Variation(f"track {track:g} m", change={"front.track": track, "rear.track": track})
        for track in (1.37, 1.43, 1.5, 1.57)
    ]
    tyre = {f"{axle}.handling_tyre.file": "pac2002_235_55R17.tir" for axle in ("front", "rear")}
    tyres = [Variation(f"tyre pac2002_235_55R17, grip {grip:g}", change=tyre, grip=grip) for grip in (1.0, 1.1, 1.2)]
    return [*shipped, *grips, *heights, *tracks, *tyres]


def _roll(answered: Answered, key: str) -> Claim:
    if answered.failed:
        return stated()[key].failed(answered.failed)
    number = answered.numbers["suspension_roll_at_7"]
    return stated()[key].valued(number.value, number.note)


def _lifts(answered: Answered, key: str) -> Claim:
    lifted = answered.value("inner_lift_instant_front")
    return stated()[key].held(_words(answered), agrees=lifted is not None)


def _keeps(answered: Answered, key: str) -> Claim:
    agrees = answered.value("wheel_lift_instant") is None and answered.sure("travel_left_rebound_front") > STOP
    return stated()[key].held(_words(answered), agrees=agrees)


def _first(found: Mapping[tuple[str, str], Answered]) -> Claim:
    holds = {load: in_order(found[load, "3"], found[load, "4"]) for load in LOADS}
    less = {
        load: found[load, "4"].sure("inner_wheel_load_front") - found[load, "3"].sure("inner_wheel_load_front")
        for load in LOADS
    }
    words = "; ".join(f"{load}: {'yes' if holds[load] else 'no'}, {less[load]:.0f} N less in 3" for load in LOADS)
    return stated()["configuration_3_before_4"].held(words, agrees=all(holds.values()))


def as_claimed(three: Answered, four: Answered) -> bool:
    """Whether configuration 3 lifts its inner front wheel, and 4 lifts none and keeps travel."""
    lifts, keeps = three.value("inner_lift_instant_front"), four.value("wheel_lift_instant")
    return lifts is not None and not four.failed and keeps is None and four.sure("travel_left_rebound_front") > STOP


def in_order(three: Answered, four: Answered) -> bool:
    """Whether configuration 3 comes first: it falls over and 4 does not, or it alone lifts the inner front wheel or
    does so earlier, or, where neither does, it has less travel and less load left there."""
    if three.failed or four.failed:
        return not four.failed
    first, second = (each.value("inner_lift_instant_front") for each in (three, four))
    if first is not None or second is not None:
        return first is not None and (second is None or first < second)
    return all(three.sure(name) < four.sure(name) for name in ("travel_left_rebound_front", "inner_wheel_load_front"))


def _words(answered: Answered) -> str:
    """Lift, travel, load and lateral acceleration of a zuziehen."""
    if answered.failed:
        return answered.failed.rpartition(": ")[2]
    lift = answered.numbers["wheel_lift_instant"]
    front = answered.numbers["inner_lift_instant_front"]
    if front.value is not None:
        station, _, acceleration = front.note.partition(" at ")
        lifts = f"lifts the inner front wheel ({station}) after {front.value:.1f} s at {acceleration}"
    elif lift.value is not None:
        lifts = f"lifts only {lift.note} after {lift.value:.1f} s"
    else:
        lifts = f"lifts none, least {answered.sure('inner_wheel_load_front'):.0f} N"
    left = answered.sure("travel_left_rebound_front")
    travel = "on its stop" if left <= STOP else f"{quantity_text(left, 'm')} left"
    return f"{lifts}; {travel}; largest {answered.sure('lateral_acceleration_max'):.2f} m/s²"


def _window(found: Mapping[tuple[str, str], Answered]) -> Beside:
    rows = []
    for each in variations():
        three, four = found[each.title, "3"], found[each.title, "4"]
        verdicts = ("yes" if holds else "no" for holds in (as_claimed(three, four), in_order(three, four)))
        rows.append((each.title, _words(three), _words(four), *verdicts))
    return Beside(
        "The window in which the lift and the order hold",
        ("variation, one at a time", "configuration 3", "configuration 4", "lift as claimed", "3 before 4"),
        rows,
        "Load full unless another is named. Nothing else changes with a variation. The tyre is reconstructed: that the "
        "lift comes out at its own grip is no proof of it.",
    )
