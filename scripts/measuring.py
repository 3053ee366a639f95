"""What the measurements of ``make bench`` are made of: a figure beside its limit, times, ratios, the cost of the
callbacks."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

import mujoco

from susp_mj.compiled import attach_input, install, uninstall
from susp_mj.compiled.clock import start_clock
from susp_mj.plant import Plant
from susp_mj.trim import Blocks

REPEATS = 9


@dataclass(frozen=True)
class Result:
    """One measured figure and its limit, None for information only; `more` says that more is better."""

    text: str
    value: float
    limit: float | None
    unit: str
    more: bool = False

    @property
    def met(self) -> bool:
        """Whether the figure is on the right side of its limit."""
        if self.limit is None:
            return True
        return self.value >= self.limit if self.more else self.value <= self.limit

    def __str__(self) -> str:
        figure = f"{self.text:<78} {self.value:8.2f} {self.unit:<3}"
        if self.limit is None:
            return figure
        return (
            f"{figure} (limit {'>=' if self.more else '<='} {self.limit:g} {self.unit}) "
            f"{'met' if self.met else 'MISSED'}"
        )


def seconds(action: Callable[[], object]) -> float:
    """Wall time of one call [s]."""
    start = time.perf_counter()
    action()
    return time.perf_counter() - start


def quickest(action: Callable[[], object], repeats: int) -> float:
    """Shortest wall time of several calls [s]: of an absolute time the one that the rest of the machine disturbed
    least."""
    action()
    return min(seconds(action) for _ in range(repeats))


def ratio(first: Callable[[], object], second: Callable[[], object], repeats: int = REPEATS) -> float:
    """Median of time(first) / time(second), taken in turn."""
    first()
    second()
    return statistics.median(seconds(first) / seconds(second) for _ in range(repeats))


def callback_cost(plant: Plant, start: mujoco.MjData, blocks: Blocks, steps: int, repeats: int) -> float:
    """Time of `steps` steps with the compiled callbacks over that of the same MJCF without; median of pairs taken in
    turn.

    MuJoCo's own clock, which runs without our callbacks and stops with them, runs on both sides: the ratio is that of
    the callbacks alone.
    """

    def stepped(prepare: Callable[[], None]) -> float:
        prepare()
        data = mujoco.MjData(plant.model)
        mujoco.mj_copyData(data, plant.model, start)
        data.time = 0.0
        attach_input(data, blocks.inputs, blocks.road, blocks.driver)
        return seconds(lambda: mujoco.mj_step(plant.model, data, nstep=steps))

    def with_callbacks() -> None:
        install(plant.laws)
        start_clock()

    stepped(with_callbacks)
    measured = statistics.median(stepped(with_callbacks) / stepped(uninstall) for _ in range(repeats))
    install(plant.laws)
    return measured
