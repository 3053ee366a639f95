"""Appendix 9, stage 2: compression to rebound ratio of the dampers, configurations 4 and 5."""

from __future__ import annotations

from collections.abc import Mapping

from evaluation.compare import Claim
from evaluation.display import quantity_text
from evaluation.reproduction import Beside, Part
from susp_mj.names import AXLES

from ..running import Report
from .runs import Answered, numbers_of, wanted
from .stated import stated

SWEEP = {"kind": "swept_steer"}
STEP = {"kind": "step", "height": "30 mm", "duration": 1.5}
STEER = {"kind": "step_steer"}
GAINS = ("side_slip_gain_peak", "rear_side_slip_gain_peak")
STEERED = ("yaw_rate_response_time", "yaw_rate_overshoot", "roll_angle_max", "pitch_angle_max", "pitch_angle_min")
MORE_COMPRESSION = {
    f"{axle}.damper": {
        "kind": "zoned",
        "rates": [16000 / 3, 1600],
        "limits": [0.2],
        "ratio": "1:1",
        "friction": 25,
        "mount": {"rate": 1.5e6},
    }
    for axle in AXLES
}
"""Configuration 4 with its compression damping doubled and its rebound damping kept: (2667, 5333) N s/m become (5333,
5333)."""


def dampers(progress: Report, workers: int | None = None) -> Part:
    """Claims of stage 2."""
    jobs = {("sweep", n): wanted(f"configuration_{n}", "handling", "ko", SWEEP, GAINS) for n in ("4", "5")}
    jobs["sweep", "kept"] = wanted("configuration_4", "handling", "ko", SWEEP, GAINS, change=MORE_COMPRESSION)
    jobs |= {("steer", n): wanted(f"configuration_{n}", "handling", "ko", STEER, STEERED) for n in ("3", "4", "5")}
    peak = ("body_acceleration_max",)
    for n in ("4", "5"):
        jobs |= {
            (f"quarter_{m}dof {axle}", n): wanted(f"configuration_{n}", f"quarter_{m}dof", "ko", STEP, peak, axle)
            for m in (1, 2)
            for axle in AXLES
        }
        jobs["full_7dof", n] = wanted(f"configuration_{n}", "full_7dof", "ko", STEP, peak)
    found = numbers_of(jobs, "stage 2: dampers", progress, workers)
    claims = (
        _sweep("lenksweep", found, "5"),
        _sweep("lenksweep_rebound_kept", found, "kept"),
        _step(found),
        *(_steered(found["steer", n], n) for n in ("3", "4", "5")),
    )
    return Part("Appendix 9, stage 2: dampers", claims, (_peaks(found),))


def _sweep(key: str, found: Mapping[tuple[str, str], Answered], other: str) -> Claim:
    first, second = found["sweep", "4"], found["sweep", other]
    ratios = [second.sure(gain) / first.sure(gain) - 1 for gain in GAINS]
    peaks = " against ".join(f"{each.sure(GAINS[0]):.4f}" for each in (second, first))
    words = f"{100 * ratios[0]:+.1f} % ({peaks}), at the rear axle {100 * ratios[1]:+.1f} %"
    return stated()[key].held(words, agrees=ratios[0] < 0)


def _step(found: Mapping[tuple[str, str], Answered]) -> Claim:
    """Ratio of the peaks on the axle where that of configuration 5 is the larger one."""
    axle = max(AXLES, key=lambda name: found[f"quarter_1dof {name}", "5"].sure("body_acceleration_max"))
    first, second = (found[f"quarter_1dof {axle}", n].sure("body_acceleration_max") for n in ("4", "5"))
    words = f"x{second / first:.2f}, {axle} axle, {first:.2f} to {second:.2f} m/s²"
    claim = stated()["step_30_mm"]
    return claim.held(words, agrees=claim.accepts(second / first))


def _steered(answered: Answered, number: str) -> Claim:
    claim = stated()[f"lenkwinkelsprung_{number}"]
    if answered.failed:
        return claim.failed(answered.failed)
    texts = {name: quantity_text(answered.value(name), answered.numbers[name].unit) for name in STEERED}
    words = (
        f"90 % of the yaw velocity after {texts['yaw_rate_response_time']}, overshoot "
        f"{100 * answered.sure('yaw_rate_overshoot'):.0f} %, roll up to {texts['roll_angle_max']}, pitch "
        f"{texts['pitch_angle_min']} to {texts['pitch_angle_max']}"
    )
    return claim.held(words, agrees=answered.value("yaw_rate_response_time") is not None)


def _peaks(found: Mapping[tuple[str, str], Answered]) -> Beside:
    models = [*(f"quarter_{m}dof {axle}" for m in (1, 2) for axle in AXLES), "full_7dof"]
    rows = []
    for model in models:
        first, second = (found[model, n].sure("body_acceleration_max") for n in ("4", "5"))
        rows.append((model, f"{first:.2f} m/s²", f"{second:.2f} m/s²", f"x{second / first:.2f}"))
    return Beside(
        "Peak acceleration on a step of 30 mm, load ko",
        ("model", "configuration 4", "configuration 5", "5 over 4"),
        rows,
    )
