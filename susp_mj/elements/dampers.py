"""Suspension dampers, effective at the wheel: zoned or measured characteristic, rubber mount in series, rod friction.

Speed v [m/s] is positive in compression (thesis sections 4.4.2 and 5.3.5.2).
"""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike
from pydantic import Field, field_validator, model_validator

from ..description import Description, wrong
from ..errors import short, wrong_answer
from ..units import Damping, NonNegativeForce, Quantity, Stiffness
from .element import FloatArray, ForceElement, chosen_from
from .law import Law, Parameters


def hydraulic_force(speed: float, p: Parameters) -> float:
    """Force of the piecewise straight characteristic in p = mount rate, friction, n_c, n_r, then (v, F, slope) each."""
    first, count = (4, int(p[2])) if speed >= 0.0 else (4 + 3 * int(p[2]), int(p[3]))
    magnitude = abs(speed)
    i = first + 3 * (count - 1)
    while i > first and magnitude < p[i]:
        i -= 3
    force = p[i + 1] + p[i + 2] * (magnitude - p[i])
    return force if speed >= 0.0 else -force


def hydraulic_speed(force: float, p: Parameters) -> float:
    """Inverse of `hydraulic_force`."""
    first, count = (4, int(p[2])) if force >= 0.0 else (4 + 3 * int(p[2]), int(p[3]))
    magnitude = abs(force)
    i = first + 3 * (count - 1)
    while i > first and magnitude < p[i + 1]:
        i -= 3
    speed = p[i] + (magnitude - p[i + 1]) / p[i + 2]
    return speed if force >= 0.0 else -speed


def direct_force(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """Damper without a mount: hydraulic force and regularised Coulomb friction."""
    return hydraulic_force(speed, p) + p[1] * 2.0 / math.pi * math.atan(201.7 * speed)


def mounted_force(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """Force of the mount, ``k1 (x - y)``; the state y is the deflection of the damper rod."""
    return p[0] * (deflection - state)


def mounted_rod_speed(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """dy/dt: 0 while the mount force stays within the friction, else the inverse characteristic of the excess."""
    force = p[0] * (deflection - state)
    excess = abs(force) - p[1]
    if excess <= 0.0:
        return 0.0
    return hydraulic_speed(excess if force > 0.0 else -excess, p)


LARGEST_SPEED = 3.0
"""Up to here a law of one's own is sampled [m/s]; faster no wheel moves against its body."""
Branches = tuple[tuple[FloatArray, FloatArray], tuple[FloatArray, FloatArray]]

DIRECT_DAMPER = Law("direct_damper", direct_force)
MOUNTED_DAMPER = Law("mounted_damper", mounted_force, mounted_rod_speed)


def _rises(speed: FloatArray, force: FloatArray) -> bool:
    """Whether both begin at 0 and increase strictly, together."""
    return (
        speed.shape == force.shape == (speed.size,)
        and speed.size > 1
        and all(
            values[0] == 0.0 and np.isfinite(values[-1]) and (np.diff(values) > 0.0).all() for values in (speed, force)
        )
    )


class Mount(Description):
    """Rubber mount in series with the damper.

    Attributes:
        rate: stiffness k1 [N/m].
    """

    rate: Stiffness


class Damper(ForceElement):
    """A damper effective at the wheel, with a law of its own; piecewise straight ones are `HydraulicDamper`."""

    owed_with_state: ClassVar[tuple[str, ...]] = ("force_at", "time_constant")

    kind: str

    def force_at(self, speed: ArrayLike) -> FloatArray:
        """Force [N] in steady motion at speed [m/s]."""
        return self.evaluate(speed=speed)

    def branches(self) -> Branches:
        """Speeds [m/s] and forces [N] outwards from rest, both positive: compression, then rebound; the law,
        sampled."""
        speed = np.concatenate([[0.0], np.geomspace(1e-4, LARGEST_SPEED, 80)])
        return (speed, self.force_at(speed)), (speed, -self.force_at(-speed))

    def lines(self) -> Branches:
        """The pieces that `branches` gives, for what goes by them."""
        return self.branches()

    def slopes(self) -> FloatArray:
        """Slopes dF/dv [N s/m] of the characteristic's pieces, compression first."""
        return np.concatenate([np.diff(force) / np.diff(speed) for speed, force in self.lines()])

    def without_friction(self) -> Damper:
        """The same damper without what acts like Coulomb friction, for linearisation."""
        return self


class HydraulicDamper(Damper):
    """A piecewise straight characteristic with rod friction, with or without a rubber mount in series.

    Without a mount ``F = F_d(v) + F_f (2/pi) arctan(201.7 v)``. With a mount of rate k1 the rod deflection y is a
    state: ``F = k1 (x - y)``; ``dy/dt = 0`` while ``|F| <= F_f``, else ``F_d^-1(|F| - F_f) sign(F)``: the inverse
    characteristic takes the stiffness out of Coulomb friction (thesis 5.14). F_d must therefore increase strictly.

    Attributes:
        friction: Coulomb friction F_f [N] of rod and piston.
        mount: the rubber mount, or None.
    """

    law: ClassVar[Law] = DIRECT_DAMPER

    friction: NonNegativeForce = 0.0
    mount: Mount | None = None

    @abstractmethod
    def branches(self) -> Branches:
        """Speeds [m/s] and forces [N] from the origin outwards, both positive: compression, then rebound."""

    def lines(self) -> Branches:
        """The straight lines that `branches` gives, found good.

        Raises:
            InputError: a branch does not begin in the origin, or does not increase strictly.
        """
        given: Any = self.branches()
        try:
            compression, rebound = [(np.asarray(speed, float), np.asarray(force, float)) for speed, force in given]
        except (TypeError, ValueError):
            compression = rebound = (np.zeros(0), np.zeros(0))
        if not all(_rises(*branch) for branch in (compression, rebound)):
            wanted = "speeds and forces of compression, then of rebound, each from 0 on strictly increasing"
            raise wrong_answer(type(self).branches, short(given), wanted)
        return compression, rebound

    @property
    def active_law(self) -> Law:
        return self.law if self.mount is None else MOUNTED_DAMPER

    def parameters(self) -> tuple[float, ...]:
        numbers: list[float] = []
        branches = self.lines()
        for speed, force in branches:
            slope = np.diff(force) / np.diff(speed)
            numbers += np.column_stack([speed[:-1], force[:-1], slope]).ravel().tolist()
        mount = self.mount.rate if self.mount else 0.0
        return (mount, self.friction, *(float(len(speed) - 1) for speed, _ in branches), *numbers)

    def force_at(self, speed: ArrayLike) -> FloatArray:
        """Hydraulic force F_d [N] at speed [m/s], without friction and mount."""
        p = self.parameters()
        return np.vectorize(lambda v: hydraulic_force(v, p), otypes=[float])(speed)

    def speed_at(self, force: ArrayLike) -> FloatArray:
        """Inverse characteristic: speed [m/s] at hydraulic force [N]."""
        p = self.parameters()
        return np.vectorize(lambda f: hydraulic_speed(f, p), otypes=[float])(force)

    def time_constant(self) -> float | None:
        """Fastest time constant [s] of mount and damper in series, ``min(dF_d/dv) / k1``; None without a mount."""
        return float(self.slopes().min()) / self.mount.rate if self.mount else None

    def without_friction(self) -> HydraulicDamper:
        return self.model_copy(update={"friction": 0.0})


def ratio_of(value: Any) -> tuple[float, float]:
    """Compression and rebound of a ratio, a text like "1:2" or two numbers.

    Raises:
        ValueError: anything else, or a part that is not from 0.001 to 1000.
    """
    if isinstance(value, str):
        parts = value.split(":")
        try:
            value = (float(parts[0]), float(parts[1])) if len(parts) == 2 else None
        except ValueError:
            value = None
    numbers = isinstance(value, (tuple, list)) and len(value) == 2 and all(type(part) in (int, float) for part in value)
    if not numbers or not all(1e-3 <= part <= 1e3 for part in value):
        raise ValueError("write the ratio of compression to rebound as two numbers from 0.001 to 1000, like '1:2'")
    return value[0], value[1]


class ZonedDamper(HydraulicDamper):
    """Average rate per velocity zone and compression:rebound ratio (thesis section 4.4.2).

    In each zone ``D_c = 2 D c/(c+r)`` and ``D_r = 2 D r/(c+r)``; the characteristic is the continuous, piecewise
    straight line through the zone limits. "1:2" and 3000 N s/m give 2000 in compression and 4000 in rebound.

    Attributes:
        rates: average rate D [N s/m] of one to three zones, from rest outwards.
        limits: speeds [m/s] between the zones, increasing, one fewer than the rates.
        ratio: compression to rebound, written ``"1:2"``.
    """

    kind: Literal["zoned"] = "zoned"
    rates: tuple[Damping, ...] = Field(min_length=1, max_length=3)
    limits: tuple[Annotated[float, Quantity("m/s", gt=0)], ...] = ()
    ratio: tuple[float, float] = (1.0, 1.0)

    @field_validator("ratio", mode="before")
    @classmethod
    def _read_ratio(cls, value: Any) -> Any:
        try:
            return ratio_of(value)
        except ValueError as error:
            raise wrong(str(error)) from None

    @model_validator(mode="after")
    def _zones(self) -> ZonedDamper:
        if len(self.limits) != len(self.rates) - 1:
            raise wrong(f"{len(self.limits)} limits do not separate {len(self.rates)} rates; give one fewer", "limits")
        if any(b <= a for a, b in zip(self.limits, self.limits[1:], strict=False)):
            raise wrong("zone limits must increase", "limits")
        return self

    def branches(self) -> Branches:
        limits = self.limits or (1.0,)
        speed = np.array([0.0, *limits, 2 * limits[-1]])[: len(self.rates) + 1]
        average = np.concatenate([[0.0], np.cumsum(np.array(self.rates) * np.diff(speed))])
        compression, rebound = self.ratio
        share = 2.0 / (compression + rebound)
        return (speed, average * share * compression), (speed, average * share * rebound)


class TableDamper(HydraulicDamper):
    """A measured characteristic: straight lines through the points and the origin, the end slopes continued.

    Attributes:
        speed: speeds [m/s], strictly increasing, from below to above 0.
        force: forces [N] at them, strictly increasing, with the sign of the speed.
    """

    kind: Literal["table"] = "table"
    speed: tuple[Annotated[float, Quantity("m/s")], ...] = Field(min_length=2, max_length=500)
    force: tuple[Annotated[float, Quantity("N")], ...] = Field(min_length=2, max_length=500)

    @model_validator(mode="after")
    def _increasing(self) -> TableDamper:
        if len(self.force) != len(self.speed):
            raise wrong(f"{len(self.force)} values are not allowed; speed has {len(self.speed)}", "force")
        for key in ("speed", "force"):
            values = getattr(self, key)
            for i in range(1, len(values)):
                if values[i] <= values[i - 1]:
                    raise wrong(
                        f"{values[i]:g} follows {values[i - 1]:g}; a damper must increase strictly", f"{key}.{i}"
                    )
        if not self.speed[0] < 0 < self.speed[-1]:
            raise wrong("must reach from rebound (below 0) to compression (above 0)", "speed")
        for i, (speed, force) in enumerate(zip(self.speed, self.force, strict=True)):
            if np.sign(speed) != np.sign(force):
                raise wrong(
                    f"{force:g} N at {speed:g} m/s would feed energy in; force and speed need the same sign",
                    f"force.{i}",
                )
        return self

    def branches(self) -> Branches:
        speed, force = np.array(self.speed), np.array(self.force)

        def outwards(sign: float) -> tuple[FloatArray, FloatArray]:
            side = sign * speed > 0
            order = np.argsort(np.abs(speed[side]))
            return np.concatenate([[0.0], np.abs(speed[side])[order]]), np.concatenate(
                [[0.0], np.abs(force[side])[order]]
            )

        return outwards(1.0), outwards(-1.0)


DAMPERS: dict[str, type[Damper]] = {"zoned": ZonedDamper, "table": TableDamper}
AnyDamper = Annotated[Damper, chosen_from(DAMPERS)]
