"""Slip of a tyre from its speeds, steady and as a state, down to standstill.

``V_s`` is the sliding speed (longitudinal ``V_x - Omega R_e``, lateral ``V_y``), ``V_x`` the forward speed of the
contact point. With a first-order relaxation length sigma ([pacejka2012], chapter 7) the slip is a state of its own,

    sigma ds/dt = direction V_s - max(|V_x|, |V_s|/s_max) s

with direction -1 for kappa and +1 for ``tan alpha``. Nothing is divided by a speed. Rolling, s settles at
``direction V_s/|V_x|`` within a distance sigma; at standstill it integrates the sliding, as a spring would, and settles
at s_max, so |s| never exceeds s_max.
"""

from __future__ import annotations

import math

SMALLEST_RELAXATION = 0.05
"""Relaxation length [m] of a tyre with hardly any load: at 70 m/s a time constant of 0.7 ms, which steps of 1 ms still
integrate."""


def steady_slip(sliding: float, rolling: float, largest: float) -> float:
    """``V_s/|V_x|``, held within ±`largest`; 0 at rest. For kappa give the sliding speed with its sign reversed."""
    speed = max(abs(rolling), abs(sliding) / largest)
    return sliding / speed if speed > 0.0 else 0.0


def slip_rate(slip: float, sliding: float, rolling: float, relaxation: float, largest: float) -> float:
    """``ds/dt = (V_s - max(|V_x|, |V_s|/s_max) s)/max(sigma, 0.05 m)`` [1/s]; sign of V_s as in `steady_slip`."""
    speed = max(abs(rolling), abs(sliding) / largest)
    return (sliding - speed * slip) / max(relaxation, SMALLEST_RELAXATION)


def heading(rolling: float, lateral: float) -> float:
    """``V_x/sqrt(V_x² + V_y² + (0.1 m/s)²)``: cosine of the slip angle, with the sign of the rolling, 0 at
    standstill."""
    return rolling / math.sqrt(rolling * rolling + lateral * lateral + 0.01)
