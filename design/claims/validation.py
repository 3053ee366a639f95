"""Chapter 6, table 6.3: the oscillation models against the handling car on a bump, in the role of the measurement."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from evaluation.compare import Claim
from evaluation.numbers import facts
from evaluation.reproduction import Beside, Part
from manoeuvres import Bump, RecordedMotion
from susp_mj import simulate
from susp_mj.batch import side_by_side
from susp_mj.elements import GRAVITY
from susp_mj.manoeuvre import Manoeuvre
from susp_mj.names import AXLES
from susp_mj.run import Run
from vehicles.mjcf import build
from vehicles.reading import load_vehicle

from ..running import Report
from .runs import CAR
from .stated import stated

MODELS = {
    "1": "quarter_1dof",
    "2": "axle_2dof",
    "3": "pitch_2dof",
    "4": "full_3dof",
    "5": "quarter_2dof",
    "6": "axle_4dof",
    "7": "full_7dof",
}
"""Number of the thesis -> model."""
ONE_AXLE, WITHOUT_TYRE = ("1", "2", "5", "6"), ("1", "2", "3", "4")
HEIGHTS = (0.01, 0.03, 0.05)
SPEED, LENGTH, START, DURATION = 80 / 3.6, 15.0, 0.5, 4.0
"""Speed [m/s] of the thesis. Length [m]: from the axes of table 6.1, see `thesis.toml`."""
CONFIGURATION, LOAD = "configuration_4", "ko"


@dataclass(frozen=True)
class Peaks:
    """Acceleration peaks of a model beside those of the handling car.

    Attributes:
        model: number of the thesis.
        place: axle above which the body is compared, or "cg".
        height: of the bump [m].
        wanted, found: (2,) largest and smallest acceleration [m/s²], of the handling car and of the model.
    """

    model: str
    place: str
    height: float
    wanted: np.ndarray
    found: np.ndarray

    @property
    def error(self) -> float:
        """Error of the peak that is larger in size, as a share of it."""
        larger = int(np.argmax(np.abs(self.wanted)))
        return float(self.found[larger] / self.wanted[larger] - 1)

    @property
    def off(self) -> float:
        """Error of the worse peak [g]."""
        return float(np.abs(self.found - self.wanted).max() / GRAVITY)


def validation(progress: Report, workers: int | None = None) -> Part:
    """Claims of table 6.3."""
    peaks = [each for height in HEIGHTS for each in _at(height, progress, workers)]
    errors = {model: max(abs(each.error) for each in peaks if each.model == model) for model in MODELS}
    claims = [
        *(_within(model, [each for each in peaks if each.model == model]) for model in MODELS),
        _rising(errors),
    ]
    return Part("Chapter 6: oscillation models against the handling car", claims, (_table(peaks),))


def _recorded(driven: Run) -> RecordedMotion:
    """The wheel centres of a run, for models without tyres."""
    with TemporaryDirectory() as folder:
        file = driven.save(Path(folder) / "driven.nc")
        return RecordedMotion(file=str(file), method="cubic", duration=float(driven.time[-1]))


def _at(height: float, progress: Report, workers: int | None) -> list[Peaks]:
    """Peaks of every model over a bump of one height [m]."""
    car = load_vehicle(CAR, CONFIGURATION)
    bump = Bump(height=height, length=LENGTH, speed=SPEED, start=START, duration=DURATION)
    driven = simulate(build(car, "handling", LOAD), bump)
    recorded = _recorded(driven)
    later = bump.model_copy(update={"start": START + facts(driven)["wheelbase"] / SPEED})
    places = [(model, axle) for model in MODELS for axle in (AXLES if model in ONE_AXLE else (None,))]

    def road(model: str, axle: str | None) -> Manoeuvre:
        if model in WITHOUT_TYRE:
            return recorded
        return later if axle == "rear" else bump

    runs = side_by_side(
        places,
        lambda place: (build(car, MODELS[place[0]], LOAD, place[1]), road(*place)),
        lambda made, done: simulate(*made, progress=done),
        lambda run: run,
        workers=workers,
        progress=lambda place, done: progress(f"oscillation models over {1000 * height:.0f} mm", done),
    )
    return [
        Peaks(model, axle or "cg", height, _extremes(_above(driven, axle)), _extremes(run["body_acceleration"]))
        for (model, axle), run in zip(places, runs, strict=True)
    ]


def _above(run: Run, axle: str | None) -> np.ndarray:
    """Vertical acceleration [m/s²] of the handling car's body above an axle, or at its centre of gravity."""
    if axle is None:
        return run["body_acceleration"]
    ahead = -facts(run)["cg_x"] - (0.0 if axle == "front" else facts(run)["wheelbase"])
    return run["body_acceleration"] - ahead * np.gradient(run["pitch_rate"], run.time)


def _extremes(values: np.ndarray) -> np.ndarray:
    return np.array([values.max(), values.min()])


def _within(model: str, peaks: Sequence[Peaks]) -> Claim:
    errors, off = [100 * abs(each.error) for each in peaks], [each.off for each in peaks]
    claim = stated()[f"oscillation_model_{model}"]
    words = f"at most {max(errors):.1f} %, {min(off):.3f} to {max(off):.3f} g"
    return claim.held(words, agrees=claim.accepts(max(errors) / 100))


def _rising(errors: Mapping[str, float]) -> Claim:
    found = list(errors.values())
    words = ", ".join(f"{100 * error:.1f}" for error in found) + " %"
    return stated()["rising_order"].held(words, agrees=found == sorted(found))


def _table(peaks: Sequence[Peaks]) -> Beside:
    rows = [
        (
            f"OM{each.model}, {each.place}",
            f"{1000 * each.height:.0f} mm",
            " / ".join(f"{value:+.2f}" for value in each.wanted),
            " / ".join(f"{value:+.2f}" for value in each.found),
            f"{100 * each.error:+.1f} %",
            f"{each.off:.3f} g",
        )
        for each in peaks
    ]
    return Beside(
        "Acceleration peaks over a bump of 15 m at 80 km/h",
        (
            "model, where",
            "height",
            "handling car [m/s²]",
            "model [m/s²]",
            "error of the larger peak",
            "worse peak off by",
        ),
        rows,
        "Models 1 to 4 have no tyre and follow the wheel centres of the handling car; 5 to 7 drive on the road. Models "
        "of one axle are compared with the body above it.",
    )
