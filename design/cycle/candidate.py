"""Candidate: a car with some of its knobs turned."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from susp_mj.elements import GRAVITY
from susp_mj.errors import InputError
from susp_mj.names import AXLES
from vehicles.reading import VehicleFile
from vehicles.vehicle import DESIGN_LOAD, Vehicle

from ..case import read_manoeuvre
from .knobs import Values, knobs_of, overrides
from .targets import Check, Targets, read_knobs


@dataclass(frozen=True)
class Candidate:
    """A set of characteristics of the car, with the knobs that were turned.

    Attributes:
        name: a letter, or what the user calls it.
        characteristics: set of the vehicle file.
        turned: knob -> value in SI, those that differ from the set.
        because: why it is tried.
        parent: name of the candidate that it was made from; empty for a first one.
        changed: knobs in which it differs from the parent, or from the set.
        repair, bars, through: as of `ByHand`.
    """

    name: str
    characteristics: str | None
    turned: Values
    because: str
    parent: str = ""
    changed: tuple[str, ...] = ()
    repair: bool = True
    bars: bool = True
    through: str | None = None

    def turn(self, name: str, because: str, changes: Values) -> Candidate:
        """A child in which further knobs are turned."""
        turned = {**self.turned, **changes}
        return replace(
            self,
            name=name,
            turned=turned,
            because=because,
            parent=self.name,
            changed=tuple(changes),
            repair=True,
            through=None,
        )


@dataclass(frozen=True)
class Layout:
    """What is laid out: targets and the car that they are for.

    Attributes:
        targets: as read.
        path: of the targets file.
        file: of the vehicle.
    """

    targets: Targets
    path: Path
    file: VehicleFile
    _cars: dict[Any, Vehicle] = field(default_factory=dict, repr=False, compare=False)
    _hashes: dict[int, tuple[Vehicle, str]] = field(default_factory=dict, repr=False, compare=False)

    @classmethod
    def open(cls, targets: Targets, path: Path) -> Layout:
        """Targets and their vehicle's file.

        Raises:
            InputError: no such vehicle, set or load.
        """
        name = targets.vehicle
        try:
            layout = cls(targets, path, VehicleFile.open(path.parent / name if name.endswith(".toml") else name))
            layout._check()
        except InputError as error:
            raise error.within(source=path.name) from None
        return layout

    def _check(self) -> None:
        """Refuse loads that the car does not have, and manoeuvres that are none."""
        car, targets = self.own(self.targets.characteristics), self.targets
        driven = {f"check.{i}": check for i, check in enumerate(targets.check)}
        driven |= {f"trade_off.response.{i}": each for i, each in enumerate(targets.trade_off.response)}
        loads = {"loads": targets.loads, "roll.load": (targets.roll.load,) if targets.roll is not None else ()}
        for key, each in driven.items():
            try:
                read_manoeuvre(each.manoeuvre, self.path)
            except InputError as error:
                raise error.within(key=key) from None
            loads |= {f"{key}.loads": each.loads or ()} if isinstance(each, Check) else {f"{key}.load": (each.load,)}
        for i, candidate in enumerate(targets.candidate):
            if candidate.characteristics is not None:
                try:
                    self.own(candidate.characteristics)
                except InputError as error:
                    raise error.within(key="" if error.source else f"candidate.{i}") from None
        for key, names in loads.items():
            for load in names:
                try:
                    car.load(load)
                except InputError as error:
                    raise InputError(error.message, key=key) from None

    def own(self, characteristics: str | None) -> Vehicle:
        """The car with one of its sets as the file and the targets' overrides have it."""
        return self._car(characteristics, self.targets.set)

    def _car(self, characteristics: str | None, values: Mapping[str, Any]) -> Vehicle:
        key = (characteristics, repr(values))
        if key not in self._cars:
            self._cars[key] = self.file.vehicle(characteristics, values)
        return self._cars[key]

    def values(self, candidate: Candidate) -> dict[str, float | str]:
        """Where every knob of a candidate stands."""
        return {**knobs_of(self.own(candidate.characteristics)), **candidate.turned}

    def set(self, candidate: Candidate) -> dict[str, Any]:
        """What to set in the vehicle file for a candidate.

        Raises:
            InputError: the turned knobs make no spring.
        """
        dampers = self.targets.dampers
        own = self.own(candidate.characteristics)
        made = overrides(own, self.values(candidate), set(candidate.turned), (dampers.above, dampers.above_least))
        return {**self.targets.set, **made}

    def vehicle(self, candidate: Candidate) -> Vehicle:
        """The candidate's car.

        Raises:
            InputError: its characteristics are not possible.
        """
        return self._car(candidate.characteristics, self.set(candidate))

    def hash_of(self, car: Vehicle) -> str:
        """Hash of all that a car is, its elements with the values of their own kinds."""
        if id(car) not in self._hashes:
            plain = car.model_dump_json(serialize_as_any=True)
            self._hashes[id(car)] = car, hashlib.sha256(plain.encode()).hexdigest()
        return self._hashes[id(car)][1]

    @cached_property
    def held(self) -> set[str]:
        """Knobs that no repair may turn."""
        return set(self.targets.hold)

    @cached_property
    def fixed(self) -> set[str]:
        """Held knobs whose values are given; others stay as they come out."""
        return set(read_knobs(self.targets.hold, "hold"))

    def proposed(self, name: str) -> Candidate:
        """The first candidate: laid out from the targets, or the car's own characteristics."""
        targets = self.targets
        values = self._from_targets() if targets.start == "targets" else {}
        values |= read_knobs(targets.hold, "hold")
        because = "springs and dampers from the targets" if targets.start == "targets" else "the car's own"
        return Candidate(name, targets.characteristics, values, because, changed=tuple(values))

    def by_hand(self, place: int, name: str, earlier: Mapping[str, Candidate]) -> Candidate:
        """A candidate that the user set up.

        Raises:
            InputError: its parent is no earlier candidate.
        """
        asked = self.targets.candidate[place]
        changes = read_knobs(asked.change, "change")
        if asked.parent is not None:
            if asked.parent not in earlier:
                raise InputError(
                    f"'{asked.parent}' is no earlier candidate",
                    key=f"candidate.{place}.parent",
                    source=self.path.name,
                )
            child = earlier[asked.parent].turn(name, asked.because, changes)
            return replace(child, repair=asked.repair, bars=asked.bars, through=asked.through)
        start = asked.start or ("car" if asked.characteristics is not None else self.targets.start)
        laid_out = self._from_targets() if start == "targets" else {}
        values = {**laid_out, **read_knobs(self.targets.hold, "hold"), **changes}
        return Candidate(
            name,
            asked.characteristics or self.targets.characteristics,
            values,
            asked.because,
            changed=tuple(values),
            repair=asked.repair,
            bars=asked.bars,
            through=asked.through,
        )

    def _from_targets(self) -> dict[str, float | str]:
        """Springs of the wished frequency, straight in rebound with the same rate, or the largest that keeps the force
        at the stop; dampers as they are to begin."""
        car, dampers = self.own(self.targets.characteristics), self.targets.dampers
        values: dict[str, float | str] = {}
        for axle in AXLES:
            frequency = self.targets.ride.frequency[axle]
            load = car.corner_mass(axle, DESIGN_LOAD) * GRAVITY
            values[f"{axle}.frequency"] = frequency
            softest = (load - self.targets.ride.rebound_force) / -car.axle(axle).spring.stops.rebound
            values[f"{axle}.rebound_rate"] = min(load / GRAVITY * (2 * math.pi * frequency) ** 2, softest)
            values[f"{axle}.damping"] = dampers.start
            values[f"{axle}.ratio"] = dampers.compression_to_rebound
            values[f"{axle}.bar"] = 0.0
        return values
