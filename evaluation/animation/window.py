"""Which stretch of the runs a video shows, and how slowly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from susp_mj.features import Bump
from susp_mj.names import channel_name
from susp_mj.run import Run

from ..numbers.ride import CONTACT_LOST
from .clip import features_of
from .kinds import drives_freely

BEFORE, AFTER, AFTER_INPUT, LONGEST = 0.1, 1.3, 1.0, 6.5
"""Stretch of a run that is shown [s]: before the input first moves, after that, at least after it rests, and altogether
at most."""
PLAYBACKS = (0.2, 0.25, 1 / 3, 0.5, 1.0)
LONGEST_CLIP = 8.0
"""Default playback is the slowest of these that keeps the clip below this length [s]."""
DRIVING_PLAYBACKS = (1.0, 2.0, 4.0, 8.0, 16.0)
LONGEST_DRIVE = 20.0
"""Of cars that drive freely, default playback is the slowest of these that keeps the clip below this length [s]."""
_INPUTS = ("road_height", "lateral_acceleration", "longitudinal_acceleration", "roll_target")


@dataclass(frozen=True)
class Window:
    """Stretch of the runs that is shown.

    Attributes:
        start, end: [s] of the runs.
        playback: seconds of the run per second of video.
        fps: frames per second.
    """

    start: float
    end: float
    playback: float
    fps: int

    @property
    def frame_step(self) -> float:
        """Time of the runs from frame to frame [s]."""
        return self.playback / self.fps

    @cached_property
    def times(self) -> np.ndarray:
        """(frames,) times of the runs [s]."""
        return self.start + self.frame_step * np.arange(max(round((self.end - self.start) / self.frame_step), 1) + 1)


def window_of(runs: Sequence[Run], fps: int, playback: float | None) -> Window:
    """From just before the input first moves until the cars have calmed down; of a long excitation, where a wheel load
    varies most.

    Of cars that drive freely the whole run is shown, in real time or, if it is long, quicker; over a bump they count as
    others.
    """
    bump = any(isinstance(feature, Bump) for run in runs for feature in features_of(run))
    if not bump and all(drives_freely(run) for run in runs):
        start, end = min(float(run.time[0]) for run in runs), max(float(run.time[-1]) for run in runs)
        if playback is None:
            playback = next(
                (each for each in DRIVING_PLAYBACKS if (end - start) / each <= LONGEST_DRIVE), DRIVING_PLAYBACKS[-1]
            )
        return Window(start, end, playback, fps)
    moves = [_input_moves(run, _INPUTS[:1] if bump else _INPUTS) for run in runs]
    first, last = min(move[0] for move in moves), max(move[1] for move in moves)
    end = max(first + AFTER, last + AFTER_INPUT)
    if end - first > LONGEST:
        peak = max((_largest_load(run) for run in runs), key=lambda each: each[0])[1]
        first, end = peak - AFTER / 2, peak + AFTER / 2
    begins, ends = min(float(run.time[0]) for run in runs), max(float(run.time[-1]) for run in runs)
    start = max(first - BEFORE, begins)
    end = min(max(end, start + BEFORE + AFTER), ends)
    if playback is None:
        playback = next((each for each in PLAYBACKS if (end - start) / each <= LONGEST_CLIP), PLAYBACKS[-1])
    return Window(start, end, playback, fps)


def _input_moves(run: Run, inputs: Sequence[str]) -> tuple[float, float]:
    """When the road, or what else drives the car, first and last moves [s]."""
    driven = [values for quantity in inputs for values in run.stations(quantity).values()]
    moving = np.flatnonzero(np.any([np.abs(np.diff(values)) > 1e-9 for values in driven], axis=0)) if driven else []
    return (float(run.time[moving[0]]), float(run.time[moving[-1] + 1])) if len(moving) else (BEFORE, BEFORE)


def _largest_load(run: Run) -> tuple[float, float]:
    """Largest departure of a wheel load from its initial value [N], and when [s]."""
    departure = np.max([np.abs(load - load[0]) for load in run.stations("wheel_load").values()], axis=0)
    return float(departure.max()), float(run.time[int(departure.argmax())])


def lift(run: Run, window: Window, time: float, station: str = "") -> tuple[bool, float]:
    """Whether a wheel is off the road at any record since the last frame, and how long it has been in the window so far
    [s]."""
    off = run[channel_name(station, "wheel_load")] <= CONTACT_LOST
    latest = (run.time > time - max(window.frame_step, run.step)) & (run.time <= time + 1e-9)
    past = (run.time >= window.start) & (run.time <= time + 1e-9)
    return bool(off[latest].any()), float(off[past].sum()) * run.step
