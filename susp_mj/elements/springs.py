"""Suspension springs, effective at the wheel: descriptions and their laws (thesis section 4.4.1).

Deflection x [m] is 0 in the design position (KO) and positive in compression; a force [N] is positive when it pushes
wheel and body apart. Beyond the stops a spring's force stays at its value at the stop; `Stops` adds the rest.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike
from pydantic import Field, model_validator

from ..description import wrong
from ..units import GRAVITY, NaturalFrequency, NonNegativeForce, PositiveForce, Quantity, Stiffness
from .element import FloatArray, ForceElement, chosen_from
from .law import Law, Parameters
from .stops import Stops


def linear_force(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """``F0 + k x``; p = x_min, x_max, F0, k."""
    x = min(max(deflection, p[0]), p[1])
    return p[2] + p[3] * x


def constant_frequency_force(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """``F0 exp(w² x / g)``; p = x_min, x_max, F0, w²/g."""
    x = min(max(deflection, p[0]), p[1])
    return p[2] * math.exp(p[3] * x)


def progressive_force(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """Linear in rebound, constant frequency to x_p, then the power term.

    p = x_min, x_max, F0, w²/g, rebound rate, x_p, F_max - F_cf(x_max), exponent.
    """
    x = min(max(deflection, p[0]), p[1])
    if x < 0.0:
        return p[2] + p[4] * x
    force = p[2] * math.exp(p[3] * x)
    if x > p[5]:
        force += p[6] * ((x - p[5]) / (p[1] - p[5])) ** p[7]
    return force


def table_force(deflection: float, speed: float, state: float, p: Parameters) -> float:
    """Piecewise cubic; p = x_min, x_max, n, n knots, then 4 coefficients (highest power first) for each of n+1 pieces.

    Piece 0 lies below the first knot and piece n above the last, both straight.
    """
    x = min(max(deflection, p[0]), p[1])
    n = int(p[2])
    low, high = 0, n
    while low < high:
        middle = (low + high) // 2
        if x >= p[3 + middle]:
            low = middle + 1
        else:
            high = middle
    origin = p[3] if low == 0 else p[2 + low]
    c = 3 + n + 4 * low
    s = x - origin
    return ((p[c] * s + p[c + 1]) * s + p[c + 2]) * s + p[c + 3]


class Spring(ForceElement):
    """A spring effective at the wheel, between its stops.

    Attributes:
        preload: force F0 [N] at x = 0; None stands for the load that the corner carries in the design position.
        stops: hard stops that end its travel.
    """

    kind: str
    preload: PositiveForce | None = None
    stops: Stops

    def at_preload(self, force: float) -> Spring:
        """The same spring, carrying `force` [N] at x = 0 if no preload of its own is given."""
        if self.preload is not None:
            return self
        return type(self).model_validate({**self.model_dump(), "preload": force})

    def force_at(self, deflection: ArrayLike) -> FloatArray:
        """Spring force [N] at rest at deflection [m], without the stops."""
        return self.evaluate(deflection, state=deflection)

    def rate_at(self, deflection: ArrayLike) -> FloatArray:
        """Local rate dF/dx [N/m], by central difference over 2 µm, one-sided at the stops."""
        x = np.asarray(deflection, float)
        low = np.maximum(x - 1e-6, self.stops.rebound)
        high = np.minimum(x + 1e-6, self.stops.compression)
        return (self.force_at(high) - self.force_at(low)) / (high - low)

    def frequency_at(self, deflection: ArrayLike) -> FloatArray:
        """Natural frequency [Hz] of the mass that the spring carries at `deflection`: ``sqrt(k g / F) / 2 pi``."""
        return np.sqrt(self.rate_at(deflection) * GRAVITY / self.force_at(deflection)) / (2 * math.pi)

    def deflection_at(self, force: float) -> float:
        """Deflection [m] at which the spring alone carries `force` [N], found between the stops.

        Raises:
            ValueError: the spring cannot carry it within its travel.
        """
        from scipy.optimize import brentq

        low, high = self.force_at([self.stops.rebound, self.stops.compression])
        if not low < force < high:
            raise ValueError(f"cannot carry {force:.0f} N; between its stops it carries {low:.0f} N to {high:.0f} N")
        root: Any = brentq(
            lambda x: float(self.force_at(x)) - force, self.stops.rebound, self.stops.compression, xtol=1e-12
        )
        return float(root)

    def _known_preload(self) -> float:
        if self.preload is None:
            raise ValueError("spring has no preload yet; use at_preload(force)")
        return self.preload


class LinearSpring(Spring):
    """Description 1 of the thesis, a linear spring: ``F = F0 + k x``.

    The rate is given, or follows from the natural frequency of the mass that F0 carries: ``k = (F0/g) (2 pi f)²``.

    Attributes:
        frequency: natural frequency f [Hz] at the preload (exactly one of frequency and rate).
        rate: rate k [N/m].
    """

    law: ClassVar[Law] = Law("linear_spring", linear_force)

    kind: Literal["linear"] = "linear"
    frequency: NaturalFrequency | None = None
    rate: Stiffness | None = None

    @model_validator(mode="after")
    def _one_of(self) -> LinearSpring:
        if (self.frequency is None) == (self.rate is None):
            raise wrong("give exactly one of 'frequency' and 'rate'")
        return self

    def parameters(self) -> tuple[float, ...]:
        preload = self._known_preload()
        rate = self.rate
        if rate is None:
            rate = preload / GRAVITY * (2 * math.pi * (self.frequency or 0.0)) ** 2
        return (self.stops.rebound, self.stops.compression, preload, rate)


class ConstantFrequencySpring(Spring):
    """Description 2 of the thesis: the rate keeps the natural frequency at every load, ``F = F0 exp(w² x / g)``.

    From ``k(x) = F(x) w²/g`` with ``w = 2 pi f``; at every x, ``k g / F = w²``.

    Attributes:
        frequency: natural frequency f [Hz].
    """

    law: ClassVar[Law] = Law("constant_frequency_spring", constant_frequency_force)

    kind: Literal["constant_frequency"] = "constant_frequency"
    frequency: NaturalFrequency

    def parameters(self) -> tuple[float, ...]:
        growth = (2 * math.pi * self.frequency) ** 2 / GRAVITY
        return (self.stops.rebound, self.stops.compression, self._known_preload(), growth)


class ProgressiveSpring(Spring):
    """Description 3 of the thesis: linear in rebound, constant frequency, then progressive up to the compression stop.

    ``x < 0``: straight from F0 to F_min at x_min. ``0 <= x <= x_p``: ``F_cf = F0 exp(w² x / g)``. Above:
    ``F = F_cf(x) + (F_max - F_cf(x_max)) ((x - x_p)/(x_max - x_p))^f``, so that F(x_max) = F_max. The exponential
    factor f is reconstructed: the formula is illegible in the source. Without F_max the spring keeps its frequency up
    to the stop.

    Attributes:
        frequency: natural frequency [Hz] of the constant-frequency part.
        rebound_force: F_min [N] at the rebound stop, at least 0 and below the preload (exactly one of force and rate).
        rebound_rate: rate of the straight part [N/m], ``(F0 - F_min)/-x_min``.
        compression_force: F_max [N] at the compression stop, not below the constant-frequency curve there; or None.
        progressive_from: x_p [m], where the progression starts.
        exponent: exponential factor f, at least 1 (a rate without a jump needs more than 1).
    """

    law: ClassVar[Law] = Law("progressive_spring", progressive_force)

    kind: Literal["progressive"] = "progressive"
    frequency: NaturalFrequency
    rebound_force: NonNegativeForce | None = None
    rebound_rate: Stiffness | None = None
    compression_force: PositiveForce | None = None
    progressive_from: Annotated[float, Quantity("m", ge=0)] = 0.0
    exponent: Annotated[float, Quantity("", ge=1)] = 2.0

    @model_validator(mode="after")
    def _monotone(self) -> ProgressiveSpring:
        if (self.rebound_force is None) == (self.rebound_rate is None):
            raise wrong("give exactly one of 'rebound_force' and 'rebound_rate'")
        if self.progressive_from >= self.stops.compression:
            raise wrong(
                f"{self.progressive_from} m is not allowed; it must lie below the compression stop at "
                f"{self.stops.compression} m",
                "progressive_from",
            )
        if self.preload is not None:
            if self.rebound_rate is not None and self.rebound_rate > self.preload / -self.stops.rebound:
                raise wrong(
                    f"{self.rebound_rate} N/m is not allowed; the spring would pull at the rebound stop, at most "
                    f"{self.preload / -self.stops.rebound:.0f} N/m",
                    "rebound_rate",
                )
            if self.rebound_force is not None and self.rebound_force >= self.preload:
                raise wrong(
                    f"{self.rebound_force} N is not allowed; it must be below the preload of {self.preload:.0f} N",
                    "rebound_force",
                )
            least = self.preload * math.exp((2 * math.pi * self.frequency) ** 2 / GRAVITY * self.stops.compression)
            if self.compression_force is not None and self.compression_force < least:
                raise wrong(
                    f"{self.compression_force} N is not allowed; constant frequency alone reaches {least:.0f} N at "
                    "the stop",
                    "compression_force",
                )
        return self

    def parameters(self) -> tuple[float, ...]:
        preload, stops = self._known_preload(), self.stops
        growth = (2 * math.pi * self.frequency) ** 2 / GRAVITY
        return (
            stops.rebound,
            stops.compression,
            preload,
            growth,
            self.rebound_rate or (preload - (self.rebound_force or 0.0)) / -stops.rebound,
            self.progressive_from,
            0.0
            if self.compression_force is None
            else self.compression_force - preload * math.exp(growth * stops.compression),
            self.exponent,
        )


class TableSpring(Spring):
    """A measured spring: monotone piecewise cubic (PCHIP) through the points, straight beyond the first and the last.

    Attributes:
        deflection: deflections [m], strictly increasing, at least two.
        force: forces [N] at them, strictly increasing.

    The preload is the curve's own force at x = 0.
    Source: F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304.
    """

    law: ClassVar[Law] = Law("table_spring", table_force)

    kind: Literal["table"] = "table"
    preload: None = None
    deflection: tuple[Annotated[float, Quantity("m")], ...] = Field(min_length=2, max_length=500)
    force: tuple[Annotated[float, Quantity("N")], ...] = Field(min_length=2, max_length=500)

    @model_validator(mode="after")
    def _increasing(self) -> TableSpring:
        if len(self.deflection) != len(self.force):
            raise wrong(f"{len(self.force)} values are not allowed; deflection has {len(self.deflection)}", "force")
        for key in ("deflection", "force"):
            values = getattr(self, key)
            for i in range(1, len(values)):
                if values[i] <= values[i - 1]:
                    raise wrong(f"{values[i]:g} follows {values[i - 1]:g}; values must increase strictly", f"{key}.{i}")
        return self

    def at_preload(self, force: float) -> TableSpring:
        return self

    def parameters(self) -> tuple[float, ...]:
        from scipy.interpolate import PchipInterpolator

        x, f = np.array(self.deflection), np.array(self.force)
        if len(x) == 2:
            coefficients = np.array([[0.0, 0.0, (f[1] - f[0]) / (x[1] - x[0]), f[0]]])
        else:
            coefficients = np.asarray(PchipInterpolator(x, f).c).T
        last, width = coefficients[-1], x[-1] - x[-2]
        slopes = np.diff(f) / np.diff(x)
        start_rate = coefficients[0][2] or slopes[0]  # the cubic may end level; the extension must not
        end_rate = max((3 * last[0] * width + 2 * last[1]) * width + last[2], 0.0) or slopes[-1]
        straight = [np.array([0.0, 0.0, start_rate, f[0]]), np.array([0.0, 0.0, end_rate, f[-1]])]
        pieces: list[Any] = [straight[0], *coefficients, straight[1]]
        return (
            self.stops.rebound,
            self.stops.compression,
            float(len(x)),
            *x.tolist(),
            *np.concatenate(pieces).tolist(),
        )


SPRINGS: dict[str, type[Spring]] = {
    "linear": LinearSpring,
    "constant_frequency": ConstantFrequencySpring,
    "progressive": ProgressiveSpring,
    "table": TableSpring,
}
AnySpring = Annotated[Spring, chosen_from(SPRINGS)]
