"""Slip of a tyre from its speeds, steady and as a state, down to standstill.

``V_s`` is the sliding speed (longitudinal ``V_x - Omega R_e``, lateral ``V_y``), ``V_x`` the forward speed of the
contact point. With a first-order relaxation length sigma ([pacejka2012], chapter 7) the slip is a state of its own,

    sigma ds/dt = direction V_s - max(|V_x|, |V_s|/s_max) s

with direction -1 for kappa and +1 for ``tan alpha``; sigma falls where the tyre slides. Nothing is divided by a speed.
Rolling, s settles at ``direction V_s/|V_x|`` within a distance sigma; at standstill it integrates the sliding, as a
spring would, and settles at s_max, so |s| never exceeds s_max.
"""

from __future__ import annotations

import math

MOST_KAPPA, MOST_TAN_ALPHA = 1.5, 3.0
"""Largest slips that sliding leads to, at standstill too."""
SMALLEST_RELAXATION, SMALLEST_TIME = 0.05, 7e-4
"""Relaxation length [m] and time [s] of a tyre that hardly touches the road, however fast it slips: what steps of 1 ms
integrate."""
SLIDING_SLIP = 0.15
"""Slip s_c at which the relaxation length has halved, about that of the largest force."""
SLOW = 2.5
"""Below this rolling speed [m/s] the slips' rates add to the forces, a damping without which a standing car would sway
for ever."""
SLOW_SLIP = 0.07
"""Slip per sliding speed [s/m] that is added at standstill: 0.02 s over a relaxation length of 0.3 m."""
HELD_SLIP, HELD_TIME = 0.08, 0.05
"""Coming to rest, a tyre that slid is wound up as far as its friction carries and no further: slips beyond the first
fade within the second [s]. As a spring of the relaxation length a slip of 1 would throw the car back by half a metre.
"""


def steady_slip(sliding: float, rolling: float, largest: float) -> float:
    """``V_s/|V_x|``, held within ±`largest`; 0 at rest. For kappa give the sliding speed with its sign reversed."""
    speed = max(abs(rolling), abs(sliding) / largest)
    return sliding / speed if speed > 0.0 else 0.0


def slip_rate(slip: float, sliding: float, rolling: float, relaxation: float, largest: float) -> float:
    """``ds/dt = (V_s - V s)/max(sigma/(1 + (s/s_c)²), 0.05 m, 0.7 ms V)`` with ``V = max(|V_x|, |V_s|/s_max)`` [1/s];
    sign of V_s as in `steady_slip`.

    The relaxation length falls with the slope of the force over the slip: a tyre that slides is wound up no further
    than its friction carries, and a locked wheel that grips again does not spring back.
    """
    speed = max(abs(rolling), abs(sliding) / largest)
    length = relaxation / (1.0 + slip * slip / (SLIDING_SLIP * SLIDING_SLIP))
    return (sliding - speed * slip) / max(length, SMALLEST_RELAXATION, speed * SMALLEST_TIME)


def _slowness(rolling: float) -> float:
    """1 at standstill, 0 from `SLOW` on, half a cosine between."""
    return 0.5 * (1.0 + math.cos(math.pi * rolling / SLOW)) if abs(rolling) < SLOW else 0.0


def damped_slip(slip: float, sliding: float, rolling: float) -> float:
    """Slip with what its rate adds to the force of a wheel that rolls slowly; sign of V_s as in `steady_slip`."""
    return slip + _slowness(rolling) * SLOW_SLIP * sliding


def fading(slip: float, rolling: float) -> float:
    """Rate [1/s] that takes a slip beyond `HELD_SLIP` back as a wheel comes to rest."""
    return -_slowness(rolling) / HELD_TIME * (slip - min(max(slip, -HELD_SLIP), HELD_SLIP))


def heading(rolling: float, lateral: float) -> float:
    """``V_x/sqrt(V_x² + V_y² + (0.1 m/s)²)``: cosine of the slip angle, with the sign of the rolling, 0 at
    standstill."""
    return rolling / math.sqrt(rolling * rolling + lateral * lateral + 0.01)
