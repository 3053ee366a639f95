"""Motion ratio: component travel per wheel travel, and what it makes of forces, rates and speeds."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike
from pydantic import Field, model_validator

from ..description import Description, wrong
from ..elements.element import FloatArray
from ..units import Length, Quantity


class MotionRatio(Description):
    """Motion ratio ``i = ds/dx`` of component travel s to wheel travel x, constant or a table over x (thesis appendix
    5).

    Both travels [m] are 0 in the design position and positive in compression. The virtual work of both sides is the
    same, ``F_wheel dx = F_comp ds``, hence ``F_comp = F_wheel/i``, ``v_comp = i v_wheel`` and

        ``k_comp = dF_comp/ds = d(F_wheel/i)/dx / i = k_wheel/i² - F_wheel i'/i³``,  ``k_wheel = i² k_comp + F_comp
        i'``.

    The second term is there wherever the ratio changes with travel: a rising ratio stiffens the wheel under load. A
    table is interpolated by PCHIP (monotone between its points) and keeps its end values beyond them. A file writes
    ``spring_ratio = 0.7`` or ``spring_ratio = { travel = ["-100 mm", "100 mm"], ratio = [0.65, 0.75] }``.

    Attributes:
        ratio: i, one value, or one for each travel; above 0.
        travel: wheel travels x [m] of the table, strictly increasing; empty for a constant ratio.
    """

    ratio: tuple[Annotated[float, Quantity("", gt=0)], ...] = Field(min_length=1, max_length=500)
    travel: tuple[Length, ...] = ()

    @model_validator(mode="before")
    @classmethod
    def _constant(cls, data: Any) -> Any:
        if isinstance(data, (int, float, str)):
            data = {"ratio": data}
        if isinstance(data, dict) and isinstance(data.get("ratio"), (int, float, str)):
            data = {**data, "ratio": [data["ratio"]]}
        return data

    @model_validator(mode="after")
    def _table(self) -> MotionRatio:
        if len(self.travel) != (len(self.ratio) if len(self.ratio) > 1 else 0):
            raise wrong(
                f"{len(self.ratio)} values are not allowed; give one number, or as many as travels, two at least",
                "ratio",
            )
        for i in range(1, len(self.travel)):
            if self.travel[i] <= self.travel[i - 1]:
                raise wrong(
                    f"{self.travel[i]:g} follows {self.travel[i - 1]:g}; travels must increase strictly", f"travel.{i}"
                )
        return self

    def at(self, travel: ArrayLike) -> FloatArray:
        """Ratio i at wheel travel [m]."""
        x = np.asarray(travel, float)
        return np.asarray(self._curve()(self._clipped(x))) if self.travel else np.full_like(x, self.ratio[0])

    def slope_at(self, travel: ArrayLike) -> FloatArray:
        """``i' = di/dx`` [1/m] at wheel travel [m]; 0 beyond the table."""
        x = np.asarray(travel, float)
        if not self.travel:
            return np.zeros_like(x)
        return np.where(x == self._clipped(x), self._curve().derivative()(self._clipped(x)), 0.0)

    def component_travel(self, travel: ArrayLike) -> FloatArray:
        """``s(x) = ∫ i dx`` from 0 to x [m], exact for the interpolated table."""
        x = np.asarray(travel, float)
        if not self.travel:
            return self.ratio[0] * x
        area = self._curve().antiderivative()

        def integral(upper: FloatArray) -> FloatArray:
            inside = self._clipped(upper)
            return area(inside) + self.at(inside) * (upper - inside)

        return integral(x) - integral(np.zeros(()))

    def wheel_travel(self, component_travel: ArrayLike) -> FloatArray:
        """Inverse of `component_travel`: wheel travel [m], to rounding error."""
        s = np.asarray(component_travel, float)
        if not self.travel:
            return s / self.ratio[0]
        knots = np.interp(np.arange(0, len(self.travel) - 1 + 1e-9, 1 / 32), np.arange(len(self.travel)), self.travel)
        known = self.component_travel(knots)
        cell = np.clip(np.searchsorted(known, s), 1, len(known) - 1)
        low, high = knots[cell - 1], knots[cell]
        x = low + (s - known[cell - 1]) / (known[cell] - known[cell - 1]) * (high - low)
        for _ in range(8):  # Newton; s(x) rises everywhere, and a cell is too short for it to bend much
            x = x - (self.component_travel(x) - s) / self.at(x)
        return x

    def component_force(self, wheel_force: ArrayLike, travel: ArrayLike) -> FloatArray:
        """``F_comp = F_wheel / i(x)`` [N]."""
        return np.asarray(wheel_force, float) / self.at(travel)

    def wheel_force(self, component_force: ArrayLike, travel: ArrayLike) -> FloatArray:
        """``F_wheel = i(x) F_comp`` [N]."""
        return np.asarray(component_force, float) * self.at(travel)

    def component_rate(self, wheel_rate: ArrayLike, wheel_force: ArrayLike, travel: ArrayLike) -> FloatArray:
        """``k_comp = k_wheel/i² - F_wheel i'/i³`` [N/m]."""
        i = self.at(travel)
        return np.asarray(wheel_rate, float) / i**2 - np.asarray(wheel_force, float) * self.slope_at(travel) / i**3

    def wheel_rate(self, component_rate: ArrayLike, component_force: ArrayLike, travel: ArrayLike) -> FloatArray:
        """``k_wheel = i² k_comp + F_comp i'`` [N/m]."""
        i = self.at(travel)
        return i**2 * np.asarray(component_rate, float) + np.asarray(component_force, float) * self.slope_at(travel)

    def component_speed(self, wheel_speed: ArrayLike, travel: ArrayLike = 0.0) -> FloatArray:
        """``v_comp = i(x) v_wheel`` [m/s]."""
        return np.asarray(wheel_speed, float) * self.at(travel)

    def wheel_speed(self, component_speed: ArrayLike, travel: ArrayLike = 0.0) -> FloatArray:
        """``v_wheel = v_comp / i(x)`` [m/s]."""
        return np.asarray(component_speed, float) / self.at(travel)

    def _curve(self) -> Any:
        from scipy.interpolate import PchipInterpolator

        return PchipInterpolator(self.travel, self.ratio)

    def _clipped(self, travel: FloatArray) -> FloatArray:
        return np.clip(travel, self.travel[0], self.travel[-1])
