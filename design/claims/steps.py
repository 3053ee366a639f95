"""Appendix 9, steps 1 and 2: steps of the road under oscillation model 1, more damping."""

from __future__ import annotations

from evaluation.compare import Claim
from evaluation.display import quantity_text
from evaluation.reproduction import Beside, Part
from susp_mj.names import AXLES
from vehicles.rates import damping_ratio
from vehicles.reading import load_vehicle

from ..cycle.knobs import knobs_of
from ..running import Job, Report
from .runs import CAR, Answered, numbers_of, wanted
from .stated import stated

SETS = {"1": "configuration_1", "2": "configuration_2", "3": "configuration_3_step_1"}
"""Configuration of the thesis -> set of characteristics of step 1."""
LOADS = ("empty", "ko", "full")
HEIGHTS = (0.01, 0.03, 0.05, 0.07)
RATES = {1000: 900, 2000: 900, 3000: 900, 4000: 1200}
"""Average damping up to 0.2 m/s in step 2 -> damping beyond [N s/m]."""
SHOOTS = 0.01
"""Overshoot from which on the body is seen to swing."""
NUMBERS = ("overshoot", "stop_hits", "contact_loss_time")

Case = tuple[str, str, float]
"""Configuration, load, height of the step [m]; the axle is the rear one."""
Raised = tuple[str, int, float]
"""Configuration, average damping [N s/m], height of the step [m]; the load is full."""


def steps(progress: Report, workers: int | None = None) -> Part:
    """Claims of steps 1 and 2."""
    cases = {(c, load, h): _step(SETS[c], load, h) for c in SETS for load in LOADS for h in HEIGHTS}
    raised = {(c, rate, h): _step(SETS[c], "full", h, rate) for c in SETS for rate in RATES for h in (0.05, 0.07)}
    found = numbers_of(cases, "steps of the road", progress, workers)
    more = numbers_of(raised, "steps with more damping", progress, workers)
    ratios = {(axle, c, load): _ratio(SETS[c], axle, load) for axle in AXLES for c in SETS for load in LOADS}
    claims = (
        _under_damped(ratios),
        _overshoots("overshoot_30_mm", found, 0.03),
        _overshoots("overshoot_10_mm", found, 0.01),
        _hits("stop_hits_50_mm", found, 0.05),
        _hits("stop_hits_70_mm", found, 0.07),
        _thrown(found),
        _fewer_hits(more),
        _no_hit(more),
    )
    return Part("Appendix 9, steps 1 and 2: ride", claims, (_case_table(ratios, found), _damping_table(more)))


def _step(characteristics: str, load: str, height: float, rate: int | None = None) -> Job:
    manoeuvre = {"kind": "step", "height": height, "duration": 4.0}
    change = {} if rate is None else {"rear.damper.rates": [rate, RATES[rate]]}
    return wanted(characteristics, "quarter_1dof", load, manoeuvre, NUMBERS, "rear", change)


def _ratio(characteristics: str, axle: str, load: str) -> float:
    car = load_vehicle(CAR, characteristics)
    return damping_ratio(car, axle, load, float(knobs_of(car)[f"{axle}.damping"]))


def _under_damped(ratios: dict[tuple[str, str, str], float]) -> Claim:
    claim = stated()["under_damped"]
    rear = sorted((ratio, f"{c} {load}") for (axle, c, load), ratio in ratios.items() if axle == "rear")
    low = [each for each in rear if claim.accepts(each[0])]
    rest = [ratio for ratio, _ in rear if not claim.accepts(ratio)]
    words = ", ".join(f"{name} {ratio:.3f}" for ratio, name in low)
    agrees = {name for _, name in low} == {"2 empty", "3 full"}
    front = {f"{c} {load}": ratio for (axle, c, load), ratio in ratios.items() if axle == "front"}
    also = [f"{name} {ratio:.3f}" for name, ratio in front.items() if claim.accepts(ratio)]
    why = f"Of the front axle the thesis says nothing; there {', '.join(also)} lie below it too." if also else ""
    return claim.held(f"{words}; the others at least {min(rest):.3f}", agrees=agrees, why=why)


def _overshoots(key: str, found: dict[Case, Answered], height: float) -> Claim:
    """Whether the thesis' two cases overshoot more than all others, and visibly."""
    shoots = {f"{c} {load}": found[c, load, height].sure("overshoot") for c in SETS for load in LOADS}
    seen = sorted((name for name, share in shoots.items() if share > SHOOTS), key=lambda name: -shoots[name])
    words = ", ".join(f"{name} {100 * shoots[name]:.0f} %" for name in seen) or "none"
    return stated()[key].held(words, agrees=set(seen[:2]) == {"2 empty", "3 full"})


def _hits(key: str, found: dict[Case, Answered], height: float) -> Claim:
    hits = {c: found[c, "full", height].sure("stop_hits") for c in SETS}
    words = ", ".join(f"{c}: {count:.0f}" for c, count in hits.items())
    return stated()[key].held(f"hits {words}", agrees=hits["1"] > 0 and hits["2"] > 0 and hits["3"] == 0)


def _thrown(found: dict[Case, Answered]) -> Claim:
    off = {c: found[c, "full", 0.07].sure("contact_loss_time") for c in ("1", "2")}
    words = ", ".join(f"{c}: {time:.2f} s off the road" for c, time in off.items())
    return stated()["thrown_into_the_air"].held(words, agrees=all(time > 0 for time in off.values()))


def _fewer_hits(found: dict[Raised, Answered]) -> Claim:
    hits = {c: [found[c, rate, 0.07].sure("stop_hits") for rate in RATES] for c in ("1", "2")}
    words = "; ".join(f"{c}: {', '.join(f'{count:.0f}' for count in counts)}" for c, counts in hits.items())
    agrees = all(counts == sorted(counts, reverse=True) and counts[-1] < counts[0] for counts in hits.values())
    return stated()["damping_lowers_stop_hits"].held(words, agrees=agrees)


def _no_hit(found: dict[Raised, Answered]) -> Claim:
    hits = [found["3", 4000, height].sure("stop_hits") for height in (0.05, 0.07)]
    return stated()["configuration_3_keeps_off_the_stop"].held(f"{sum(hits):.0f} hits", agrees=sum(hits) == 0)


def _case_table(ratios: dict[tuple[str, str, str], float], found: dict[Case, Answered]) -> Beside:
    rows = [
        (
            f"{c}, {load}",
            *(f"{ratios[axle, c, load]:.3f}" for axle in AXLES),
            *(_cell(found[c, load, height]) for height in HEIGHTS),
        )
        for c in SETS
        for load in LOADS
    ]
    heights = [quantity_text(height, "m") for height in HEIGHTS]
    return Beside(
        "Step 1: 1500 N s/m, oscillation model 1",
        ("configuration", *(f"damping ratio, {axle}" for axle in AXLES), *(f"rear, {each}" for each in heights)),
        rows,
        "Damping ratio D/(2 sqrt(k m)), k over ±1 mm, friction left out. On steps: overshoot, hits of a stop, time off "
        "the road.",
    )


def _cell(answered: Answered) -> str:
    shoot, hits, off = (answered.sure(name) for name in NUMBERS)
    words = [f"{100 * shoot:.0f} %"]
    words += [f"{hits:.0f} hit{'s' * (hits > 1)}"] if hits else []
    words += [f"{off:.2f} s off"] if off else []
    return ", ".join(words)


def _damping_table(found: dict[Raised, Answered]) -> Beside:
    rows = [
        (f"{c}, {quantity_text(height, 'm')}", *(_cell(found[c, rate, height]) for rate in RATES))
        for c in SETS
        for height in (0.05, 0.07)
    ]
    return Beside("Step 2: rear axle, full, over the average damping", ("", *(f"{rate} N s/m" for rate in RATES)), rows)
