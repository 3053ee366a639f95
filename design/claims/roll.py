"""Appendix 9, step 3: anti-roll bars from oscillation model 4."""

from __future__ import annotations

from evaluation.reproduction import Part
from susp_mj.names import AXLES

from ..running import Report
from .runs import numbers_of, wanted
from .stated import stated

RIG = {"kind": "roll_angle", "angle": "5 deg", "lateral_acceleration": "7 m/s²", "front_share": 0.6}
FORCE = {"kind": "lateral_force", "acceleration": "7 m/s²", "duration": "5 s"}
BARS = tuple(f"anti_roll_bar_{axle}" for axle in AXLES)


def roll(progress: Report, workers: int | None = None) -> Part:
    """Claims of step 3."""
    jobs = {
        (number, kind): wanted(f"configuration_{number}", "full_3dof", "ko", manoeuvre, names)
        for number in ("3", "4")
        for kind, manoeuvre, names in (("rig", RIG, BARS), ("force", FORCE, ("roll_angle_final",)))
    }
    found = numbers_of(jobs, "roll of oscillation model 4", progress, workers)
    claims = []
    for number in ("3", "4"):
        for bar in BARS:
            answer = found[number, "rig"]
            claims.append(stated()[f"{bar}_{number}"].valued(answer.value(bar), answer.numbers[bar].note))
        angle = found[number, "force"].value("roll_angle_final")
        claims.append(stated()[f"roll_angle_{number}"].valued(None if angle is None else abs(angle)))
    return Part("Appendix 9, step 3: anti-roll bars", claims)
