"""Comparison: several configurations under one manoeuvre, with numbers and verdicts side by side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from susp_mj.errors import InputError, choices
from susp_mj.run import Run

from . import NUMBERS
from .number import Criterion, Number
from .tyre_curves import TyreCurves

if TYPE_CHECKING:
    from susp_mj.linear import Mode


@dataclass(frozen=True)
class ElementNote:
    """Which law an element follows, for the equations of a report.

    Attributes:
        role: ``spring``, ``stops``, ``damper``, ``mount``, ``friction``, ``tyre`` or ``handling_tyre``.
        kind: its kind, as files write it.
        text: what its class says of itself.
    """

    role: str
    kind: str
    text: str


@dataclass(frozen=True)
class ComponentSpring:
    """The spring itself, where its motion ratio is known; arrays in SI, between the stops.

    Attributes:
        ratio: component travel per wheel travel in the design position.
        travel, force, rate: over the component's own travel from the design position, positive in compression.
    """

    ratio: float
    travel: Any
    force: Any
    rate: Any


@dataclass(frozen=True)
class ComponentDamper:
    """The damper itself, where its motion ratio is known, with the wheel in the design position; arrays in SI.

    Attributes:
        ratio: component travel per wheel travel in the design position.
        speed, force: of the component, positive in compression; hydraulic force.
    """

    ratio: float
    speed: Any
    force: Any


@dataclass(frozen=True)
class Characteristic:
    """Sampled characteristics of one suspension, for the F-x, rate, frequency and F-v plots; arrays in SI.

    Attributes:
        title: e.g. "rear axle".
        deflection, spring_force, spring_rate, spring_frequency: over the travel and a little beyond, the stops included
            in the force; rate and frequency belong to the spring alone and are not a number beyond the stops.
        speed, damper_force: hydraulic force over speed, without mount and friction.
        preload: [N].
        elements: what the suspension is made of.
        component_spring, component_damper: the same at the component, or None where no motion ratio is given.
        tyre: curves of the tyre with slip, or None where the car has none.
    """

    title: str
    deflection: Any
    spring_force: Any
    spring_rate: Any
    spring_frequency: Any
    speed: Any
    damper_force: Any
    preload: float
    elements: Sequence[ElementNote] = ()
    component_spring: ComponentSpring | None = None
    component_damper: ComponentDamper | None = None
    tyre: TyreCurves | None = None

    @property
    def stops(self) -> tuple[float, float]:
        """Deflections [m] of the rebound and the compression stop."""
        inside = self.deflection[np.isfinite(self.spring_rate)]
        return float(inside[0]), float(inside[-1])


@dataclass(frozen=True)
class Configuration:
    """One configuration's outcome.

    Attributes:
        name: as the case file calls it; the label in every plot.
        title: what it is, one line.
        run: its run.
        numbers: evaluation numbers by name.
        characteristics: of the suspensions that its model uses.
        modes: of the model linearised at static equilibrium, friction left out, by rising frequency.
        transfer: for a sweep, channel -> (frequency [Hz], exact complex amplification) of the linearised model.
    """

    name: str
    title: str
    run: Run
    numbers: Mapping[str, Number]
    characteristics: Sequence[Characteristic] = ()
    modes: Sequence[Mode] = ()
    transfer: Mapping[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)

    @property
    def facts(self) -> dict[str, str]:
        """What was run, for the summary."""
        meta = self.run.meta
        return {
            "vehicle": meta["vehicle"],
            "load": meta["load"],
            "model": meta["model"],
            "manoeuvre": meta["manoeuvre"]["kind"],
        }


@dataclass(frozen=True)
class Claim:
    """A published statement beside what came out.

    Attributes:
        text: the statement, with its source.
        expected: what it says, e.g. "11.24 ± 0.05 m/s²".
        result: what came out, e.g. "11.241 m/s²".
        holds: whether it does.
    """

    text: str
    expected: str
    result: str
    holds: bool


@dataclass(frozen=True)
class Comparison:
    """Everything a report shows.

    Attributes:
        title: of the case.
        description: a sentence or two; may be empty.
        configurations: in the order of the case file; the order fixes their colours.
        criteria: by number name.
        claims: published statements beside results; empty for a user's own case.
        videos: file names of videos beside the report.
    """

    title: str
    description: str
    configurations: Sequence[Configuration]
    criteria: Mapping[str, Criterion] = field(default_factory=dict)
    claims: Sequence[Claim] = ()
    videos: Sequence[str] = ()

    def verdicts(self, configuration: Configuration) -> dict[str, dict[str, Any]]:
        """Criteria of one configuration: ``{name: {value, unit, min, max, passed}}``."""
        return {
            name: {
                "value": configuration.numbers[name].value,
                "unit": configuration.numbers[name].unit,
                "min": criterion.minimum,
                "max": criterion.maximum,
                "passed": criterion.passed(configuration.numbers[name].value),
            }
            for name, criterion in self.criteria.items()
        }

    @property
    def passed(self) -> bool:
        """Whether every configuration meets every criterion."""
        return all(verdict["passed"] for each in self.configurations for verdict in self.verdicts(each).values())

    def summary(self) -> list[dict[str, Any]]:
        """One entry per configuration, plain JSON values."""
        return [
            {
                "configuration": each.name,
                **each.facts,
                "modes": [{"frequency": m.frequency, "damping": m.damping} for m in each.modes],
                "numbers": {
                    name: {"value": n.value, "unit": n.unit, "note": n.note} for name, n in each.numbers.items()
                },
                "criteria": self.verdicts(each),
            }
            for each in self.configurations
        ]


def evaluate(run: Run, names: Sequence[str]) -> dict[str, Number]:
    """Evaluation numbers of a run, by name.

    Raises:
        InputError: an unknown number.
    """
    for name in names:
        if name not in NUMBERS:
            raise InputError(f"no evaluation number '{name}'; {choices(NUMBERS, name)}", key="numbers")
    return {name: NUMBERS[name](run) for name in names}
