"""Curves of a tyre with slip: forces and aligning moment over each slip at several loads, and both forces in combined
slip."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from susp_mj.elements.law import numbers_of

LOADS = (0.5, 1.0, 1.5, 2.0)
"""Loads of the curves, as multiples of the wheel load in the design position."""
LARGEST_KAPPA, LARGEST_ALPHA = 0.3, math.radians(15)
ANGLES = tuple(math.radians(angle) for angle in (-12, -6, -4, -2, -1, 0, 1, 2, 4, 6, 12))
"""Slip angles [rad] of the lines of combined slip."""
ROLLING = 20.0
"""Speed of the contact point [m/s]."""

FloatArray = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True)
class TyreCurves:
    """Sampled curves of one tyre without camber, in SI and in the axes of the tyre (ISO-W: x forward, y left).

    Attributes:
        name: kind of the tyre.
        loads: (n,) [N].
        kappa: (k,) longitudinal slip [1], positive driven.
        longitudinal_force: (n, k) [N] at zero slip angle.
        alpha: (a,) slip angle [rad], positive drifting to the left.
        lateral_force: (n, a) [N] at zero kappa, positive to the left.
        aligning_moment: (n, a) [N m] at zero kappa, positive to the left.
        nominal_load: [N] of the combined slip below.
        angles: (m,) slip angles [rad] of its lines.
        combined_kappa: (q,) longitudinal slips along each line [1].
        combined_longitudinal, combined_lateral: (m, q) [N].
        friction: largest of each force alone at the nominal load [N], or None where the curves still rise at their
            ends.
    """

    name: str
    loads: FloatArray
    kappa: FloatArray
    longitudinal_force: FloatArray
    alpha: FloatArray
    lateral_force: FloatArray
    aligning_moment: FloatArray
    nominal_load: float
    angles: FloatArray
    combined_kappa: FloatArray
    combined_longitudinal: FloatArray
    combined_lateral: FloatArray
    friction: tuple[float, float] | None

    def equals(self, other: TyreCurves) -> bool:
        """Whether another tyre has the same curves."""
        mine, its = vars(self), vars(other)
        return all(np.array_equal(mine[name], its[name]) for name in mine if name != "friction")


def tyre_curves(tyre: Any, nominal_load: float, loads: Sequence[float] | None = None) -> TyreCurves:
    """Sample a tyre's curves.

    Args:
        tyre: what has a `kind`, a contact `law` and `parameters()` (see `susp_mj.elements.ContactTyre`).
        nominal_load: [N], of the combined slip.
        loads: [N]; by default `LOADS` times the nominal one, to 100 N.
    """
    weights = tuple(round(nominal_load * each, -2) for each in LOADS) if loads is None else tuple(map(float, loads))
    return _sampled(tyre.kind, tyre.law, numbers_of(tyre), float(nominal_load), weights)


@functools.lru_cache(maxsize=64)
def _sampled(
    kind: str, law: Any, parameters: tuple[float, ...], nominal_load: float, loads: tuple[float, ...]
) -> TyreCurves:
    """The curves, sampled once: the laws are plain Python, and cars of one comparison mostly have the same tyres."""

    def sample(kappa: FloatArray, alpha: FloatArray, load: float) -> FloatArray:
        """F_x, F_y, M_z in columns, for slips (..., ) that broadcast."""
        out = [0.0] * 8
        slips = np.broadcast_arrays(kappa, np.tan(alpha))
        rows = []
        for k, t in zip(*(each.ravel() for each in slips), strict=True):
            law.function(float(k), float(t), 0.0, load, ROLLING, ROLLING * float(t), 1.0, parameters, out)
            rows.append((out[0], out[1], out[4]))
        return np.array(rows).reshape(*slips[0].shape, 3)

    kappa = np.linspace(-LARGEST_KAPPA, LARGEST_KAPPA, 151)
    alpha = np.linspace(-LARGEST_ALPHA, LARGEST_ALPHA, 151)
    weights = np.array(loads)
    along = np.array([sample(kappa, np.zeros(1), load)[:, 0] for load in weights])
    across = np.array([sample(np.zeros(1), alpha, load)[:, 1:] for load in weights])
    angles = np.array(ANGLES)
    dense = np.sinh(np.linspace(-4.0, 4.0, 121)) / math.sinh(4.0)
    combined = sample(dense[None, :], angles[:, None], nominal_load)
    return TyreCurves(
        name=kind,
        loads=weights,
        kappa=kappa,
        longitudinal_force=along,
        alpha=alpha,
        lateral_force=across[..., 0],
        aligning_moment=across[..., 1],
        nominal_load=nominal_load,
        angles=angles,
        combined_kappa=dense,
        combined_longitudinal=combined[..., 0],
        combined_lateral=combined[..., 1],
        friction=_friction(sample, nominal_load),
    )


def _friction(sample: Any, load: float) -> tuple[float, float] | None:
    """Largest longitudinal and lateral force [N] of either alone, the mean of both directions; None where there is
    none."""
    slip = np.sinh(np.linspace(-5.0, 5.0, 201)) / math.sinh(5.0)
    along, across = sample(slip, np.zeros(1), load)[:, 0], sample(np.zeros(1), 1.2 * slip, load)[:, 1]
    if any(abs(force[end]) >= abs(force).max() for force in (along, across) for end in (0, -1)):
        return None
    return float(np.ptp(along) / 2), float(np.ptp(across) / 2)
