"""Magic Formula 5.2 (PAC2002): one plain scalar function a quantity, and `magic_formula_contact` that gives all at
once.

Axes are ISO-W: x forward in the wheel plane, y to the left, z up out of the road. With V the speed of the contact point
and V_s = V - Omega R_e its sliding speed, ``kappa = -V_sx/|V_x|`` and ``tan alpha = V_sy/|V_x|``: a driven wheel has
kappa > 0 and F_x > 0, a tyre that drifts to the left has alpha > 0 and F_y < 0. Camber gamma is positive where the
wheel leans to the right (top of the wheel towards -y).

The functions of one quantity are there to be read and checked: they follow the source term by term. The car calls
`magic_formula_contact`, which computes the same numbers with every shared term evaluated once, and adds the road's
friction.

Every function takes ``kappa [1], alpha [rad], camber [rad], load F_z [N]`` and the parameters `p` in the order of
`PARAMETERS`: coefficients with their scaling factors already multiplied in. Slips and camber beyond the valid ranges of
the tyre are held at the limits, so is the load above its largest valid value; at zero load every result is zero.

Source: PAC2002 chapter of [msc2008]; the same equations stand in [pacejka2012], section 4.3.2, without turn slip and
inflation pressure.
"""

from __future__ import annotations

import math
from collections.abc import MutableSequence

from ..law import Parameters

# fmt: off
PARAMETERS = (
    "SIDE", "COMBINED", "R0", "FZ0", "FZN", "FZMAX", "KPUMIN", "KPUMAX", "ALPMIN", "ALPMAX", "CAMMIN", "CAMMAX",
    "PCX1", "PDX1", "PDX2", "PDX3", "PEX1", "PEX2", "PEX3", "PEX4", "PKX1", "PKX2", "PKX3", "PHX1", "PHX2", "PVX1",
    "PVX2",
    "RBX1", "RBX2", "RCX1", "REX1", "REX2", "RHX1", "PTX1", "PTX2", "PTX3",
    "PCY1", "PDY1", "PDY2", "PDY3", "PEY1", "PEY2", "PEY3", "PEY4", "PKY1", "PKY2", "PKY3", "PHY1", "PHY2", "PHY3",
    "PVY1", "PVY2", "PVY3", "PVY4", "RBY1", "RBY2", "RBY3", "RCY1", "REY1", "REY2", "RHY1", "RHY2",
    "RVY1", "RVY2", "RVY3", "RVY4", "RVY5", "RVY6", "PTY1", "PTY2",
    "QBZ1", "QBZ2", "QBZ3", "QBZ4", "QBZ5", "QBZ9", "QBZ10", "QCZ1", "QDZ1", "QDZ2", "QDZ3", "QDZ4", "QDZ6", "QDZ7",
    "QDZ8",
    "QDZ9", "QEZ1", "QEZ2", "QEZ3", "QEZ4", "QEZ5", "QHZ1", "QHZ2", "QHZ3", "QHZ4", "SSZ1", "SSZ2", "SSZ3", "SSZ4",
    "QSX1", "QSX2", "QSX3", "QSY1", "QSY2", "QSY3", "QSY4", "VREF", "LGAX", "LGAY", "LGAZ",
    "DEFLECTION", "BREFF", "DREFF", "FREFF", "SIGMA_LEAST",
    "PER_FZ0", "PER_FZN", "PER_VREF", "PER_KY_LOAD", "PER_SY_LOAD", "KY_MOST", "SY_MOST",
)
"""Names of the parameters, in order; FZ0 is the nominal load times LFZO, FZN the nominal load itself.

The last ones are combinations: ``DEFLECTION = FZ0/C_z``, ``PER_X = 1/X``, and of the cornering stiffness and the
lateral relaxation length the load (``PKY2 FZ0``, ``PTY2 FZ0``) and the value (``PKY1 FZ0``, ``PTY1 R0``) of their
largest.
"""
(
    SIDE, COMBINED, R0, FZ0, FZN, FZMAX, KPUMIN, KPUMAX, ALPMIN, ALPMAX, CAMMIN, CAMMAX,
    PCX1, PDX1, PDX2, PDX3, PEX1, PEX2, PEX3, PEX4, PKX1, PKX2, PKX3, PHX1, PHX2, PVX1, PVX2,
    RBX1, RBX2, RCX1, REX1, REX2, RHX1, PTX1, PTX2, PTX3,
    PCY1, PDY1, PDY2, PDY3, PEY1, PEY2, PEY3, PEY4, PKY1, PKY2, PKY3, PHY1, PHY2, PHY3,
    PVY1, PVY2, PVY3, PVY4, RBY1, RBY2, RBY3, RCY1, REY1, REY2, RHY1, RHY2,
    RVY1, RVY2, RVY3, RVY4, RVY5, RVY6, PTY1, PTY2,
    QBZ1, QBZ2, QBZ3, QBZ4, QBZ5, QBZ9, QBZ10, QCZ1, QDZ1, QDZ2, QDZ3, QDZ4, QDZ6, QDZ7, QDZ8,
    QDZ9, QEZ1, QEZ2, QEZ3, QEZ4, QEZ5, QHZ1, QHZ2, QHZ3, QHZ4, SSZ1, SSZ2, SSZ3, SSZ4,
    QSX1, QSX2, QSX3, QSY1, QSY2, QSY3, QSY4, VREF, LGAX, LGAY, LGAZ,
    DEFLECTION, BREFF, DREFF, FREFF, SIGMA_LEAST,
    PER_FZ0, PER_FZN, PER_VREF, PER_KY_LOAD, PER_SY_LOAD, KY_MOST, SY_MOST,
) = range(len(PARAMETERS))
# fmt: on
SMALLEST_LOAD = 1e-9
"""Load [N] below which there is no aligning moment: the stiffnesses, whose ratio it needs, underflow to zero."""
SMALLEST_FRICTION = 1e-6
"""Friction of the road that stands for none: the shape of the curves, which is divided by it, stays finite."""


def within(value: float, low: float, high: float) -> float:
    """`value`, held between `low` and `high`."""
    return min(max(value, low), high)


def bent(b: float, e: float, x: float) -> float:
    """Argument of the formula's outer sine or cosine: ``atan(b x - e (b x - atan(b x)))``; e above 1 counts as 1."""
    bx = b * x
    return math.atan(bx - min(e, 1.0) * (bx - math.atan(bx)))


def load_change(load: float, p: Parameters) -> float:
    """``df_z = (F_z - F_z0)/F_z0``."""
    return (load - p[FZ0]) / p[FZ0]


def longitudinal_stiffness(load: float, p: Parameters) -> float:
    """``K_x = F_z (PKX1 + PKX2 df_z) exp(PKX3 df_z)`` [N]: slope of F_x over kappa where the slip, less its shift, is
    zero."""
    load = within(load, 0.0, p[FZMAX])
    dfz = load_change(load, p)
    return load * (p[PKX1] + p[PKX2] * dfz) * math.exp(p[PKX3] * dfz)


def cornering_stiffness(camber: float, load: float, p: Parameters) -> float:
    """``K_y = PKY1 F_z0 sin(2 atan(F_z/(PKY2 F_z0))) (1 - PKY3 |gamma|)`` [N/rad], negative."""
    load = within(load, 0.0, p[FZMAX])
    gamma = within(camber, p[CAMMIN], p[CAMMAX]) * p[LGAY]
    return p[PKY1] * p[FZ0] * math.sin(2.0 * math.atan(load / (p[PKY2] * p[FZ0]))) * (1.0 - p[PKY3] * abs(gamma))


def longitudinal_friction(camber: float, load: float, p: Parameters) -> float:
    """``mu_x = (PDX1 + PDX2 df_z)(1 - PDX3 gamma²)``, at least zero."""
    gamma = within(camber, p[CAMMIN], p[CAMMAX]) * p[LGAX]
    return max(0.0, (p[PDX1] + p[PDX2] * load_change(min(load, p[FZMAX]), p)) * (1.0 - p[PDX3] * gamma * gamma))


def lateral_friction(camber: float, load: float, p: Parameters) -> float:
    """``mu_y = (PDY1 + PDY2 df_z)(1 - PDY3 gamma²)``, at least zero."""
    gamma = within(camber, p[CAMMIN], p[CAMMAX]) * p[LGAY]
    return max(0.0, (p[PDY1] + p[PDY2] * load_change(min(load, p[FZMAX]), p)) * (1.0 - p[PDY3] * gamma * gamma))


def lateral_shifts(gamma: float, load: float, p: Parameters) -> tuple[float, float]:
    """Shifts of F_y over alpha: ``S_Hy`` [rad] and ``S_Vy`` [N] (ply steer, conicity, camber thrust)."""
    dfz = load_change(load, p)
    horizontal = p[PHY1] + p[PHY2] * dfz + p[PHY3] * gamma
    return horizontal, load * (p[PVY1] + p[PVY2] * dfz + (p[PVY3] + p[PVY4] * dfz) * gamma)


def pure_longitudinal_force(kappa: float, camber: float, load: float, p: Parameters) -> float:
    """``F_x0 = D_x sin(C_x atan(B_x k - E_x (B_x k - atan(B_x k)))) + S_Vx``, ``k = kappa + S_Hx`` [N]."""
    load = within(load, 0.0, p[FZMAX])
    friction = longitudinal_friction(p[SIDE] * camber, load, p) * load
    if friction <= 0.0:
        return 0.0
    dfz = load_change(load, p)
    slip = within(kappa, p[KPUMIN], p[KPUMAX]) + p[PHX1] + p[PHX2] * dfz
    curvature = (p[PEX1] + p[PEX2] * dfz + p[PEX3] * dfz * dfz) * (1.0 - p[PEX4] * math.copysign(1.0, slip))
    slope = longitudinal_stiffness(load, p) / (p[PCX1] * friction)
    return friction * math.sin(p[PCX1] * bent(slope, curvature, slip)) + load * (p[PVX1] + p[PVX2] * dfz)


def unmirrored_lateral_force(alpha: float, camber: float, load: float, p: Parameters) -> float:
    """F_y0 [N] on the side of the car that the coefficients were measured for; `load` above zero, arguments in
    range."""
    friction = lateral_friction(camber, load, p) * load
    if friction <= 0.0:
        return 0.0
    dfz, gamma = load_change(load, p), camber * p[LGAY]
    horizontal, vertical = lateral_shifts(gamma, load, p)
    slip = alpha + horizontal
    curvature = (p[PEY1] + p[PEY2] * dfz) * (1.0 - (p[PEY3] + p[PEY4] * gamma) * math.copysign(1.0, slip))
    slope = cornering_stiffness(camber, load, p) / (p[PCY1] * friction)
    return friction * math.sin(p[PCY1] * bent(slope, curvature, slip)) + vertical


def pure_lateral_force(alpha: float, camber: float, load: float, p: Parameters) -> float:
    """``F_y0 = D_y sin(C_y atan(B_y a - E_y (B_y a - atan(B_y a)))) + S_Vy``, ``a = alpha + S_Hy`` [N]."""
    load = within(load, 0.0, p[FZMAX])
    alpha = within(p[SIDE] * alpha, p[ALPMIN], p[ALPMAX])
    return p[SIDE] * unmirrored_lateral_force(alpha, within(p[SIDE] * camber, p[CAMMIN], p[CAMMAX]), load, p)


def longitudinal_weight(kappa: float, alpha: float, load: float, p: Parameters) -> float:
    """``G_xa = cos(C atan(B a - E (..)))`` at ``a = alpha + S_H`` over its value at ``a = S_H``; ``B = RBX1
    cos(atan(RBX2 kappa))``."""
    b = p[RBX1] * math.cos(math.atan(p[RBX2] * kappa))
    e = p[REX1] + p[REX2] * load_change(load, p)
    return math.cos(p[RCX1] * bent(b, e, alpha + p[RHX1])) / math.cos(p[RCX1] * bent(b, e, p[RHX1]))


def lateral_weight(kappa: float, alpha: float, load: float, p: Parameters) -> float:
    """``G_yk``, as `longitudinal_weight` over kappa; ``B = RBY1 cos(atan(RBY2 (alpha - RBY3)))``."""
    dfz = load_change(load, p)
    b = p[RBY1] * math.cos(math.atan(p[RBY2] * (alpha - p[RBY3])))
    e, shift = p[REY1] + p[REY2] * dfz, p[RHY1] + p[RHY2] * dfz
    return math.cos(p[RCY1] * bent(b, e, kappa + shift)) / math.cos(p[RCY1] * bent(b, e, shift))


def slip_steer(kappa: float, alpha: float, camber: float, load: float, p: Parameters) -> float:
    """``S_Vyk = mu_y F_z (RVY1 + RVY2 df_z + RVY3 gamma) cos(atan(RVY4 alpha)) sin(RVY5 atan(RVY6 kappa))`` [N]."""
    size = lateral_friction(camber, load, p) * load * (p[RVY1] + p[RVY2] * load_change(load, p) + p[RVY3] * camber)
    return size * math.cos(math.atan(p[RVY4] * alpha)) * math.sin(p[RVY5] * math.atan(p[RVY6] * kappa))


def longitudinal_force(kappa: float, alpha: float, camber: float, load: float, p: Parameters) -> float:
    """``F_x = G_xa F_x0`` [N]; ``F_x0`` for a tyre whose file asks for no combined slip."""
    pure = pure_longitudinal_force(kappa, camber, load, p)
    if load <= 0.0 or p[COMBINED] == 0.0:
        return pure
    alpha = within(p[SIDE] * alpha, p[ALPMIN], p[ALPMAX])
    return pure * longitudinal_weight(within(kappa, p[KPUMIN], p[KPUMAX]), alpha, min(load, p[FZMAX]), p)


def lateral_force(kappa: float, alpha: float, camber: float, load: float, p: Parameters) -> float:
    """``F_y = G_yk F_y0 + S_Vyk`` [N]; ``F_y0`` for a tyre whose file asks for no combined slip."""
    pure = pure_lateral_force(alpha, camber, load, p)
    if load <= 0.0 or p[COMBINED] == 0.0:
        return pure
    load, kappa = min(load, p[FZMAX]), within(kappa, p[KPUMIN], p[KPUMAX])
    alpha = within(p[SIDE] * alpha, p[ALPMIN], p[ALPMAX])
    camber = within(p[SIDE] * camber, p[CAMMIN], p[CAMMAX])
    return pure * lateral_weight(kappa, alpha, load, p) + p[SIDE] * slip_steer(kappa, alpha, camber, load, p)


def equivalent_slip(alpha: float, kappa: float, stiffness_ratio: float) -> float:
    """``sgn(alpha) atan(sqrt(tan² alpha + (K_x/K_y)² kappa²))`` [rad]."""
    lateral, longitudinal = math.tan(alpha), stiffness_ratio * kappa
    return math.copysign(math.atan(math.sqrt(lateral * lateral + longitudinal * longitudinal)), alpha)


def pneumatic_trail(kappa: float, alpha: float, camber: float, load: float, p: Parameters) -> float:
    """``t = D_t cos(C_t atan(B_t a - E_t (B_t a - atan(B_t a))))`` [m], a the equivalent slip; the cosine of alpha is
    left out."""
    dfz, gamma = load_change(load, p), camber * p[LGAZ]
    slip = alpha + p[QHZ1] + p[QHZ2] * dfz + (p[QHZ3] + p[QHZ4] * dfz) * gamma
    b = (p[QBZ1] + p[QBZ2] * dfz + p[QBZ3] * dfz * dfz) * (1.0 + p[QBZ4] * gamma + p[QBZ5] * abs(gamma))
    peak = load * (p[QDZ1] + p[QDZ2] * dfz) * (1.0 + p[QDZ3] * gamma + p[QDZ4] * gamma * gamma) * p[R0] / p[FZN]
    skew = 1.0 + (p[QEZ4] + p[QEZ5] * gamma) * 2.0 / math.pi * math.atan(b * p[QCZ1] * slip)
    e = (p[QEZ1] + p[QEZ2] * dfz + p[QEZ3] * dfz * dfz) * skew
    ratio = p[COMBINED] * longitudinal_stiffness(load, p) / cornering_stiffness(camber, load, p)
    return peak * math.cos(p[QCZ1] * bent(b, e, equivalent_slip(slip, kappa, ratio)))


def residual_moment(kappa: float, alpha: float, camber: float, load: float, p: Parameters) -> float:
    """``M_zr = D_r cos(atan(B_r a))`` [N m], a the equivalent slip; the cosine of alpha is left out."""
    dfz, gamma = load_change(load, p), camber * p[LGAZ]
    stiffness = cornering_stiffness(camber, load, p)
    horizontal, vertical = lateral_shifts(camber * p[LGAY], load, p)
    friction = lateral_friction(camber, load, p) * load
    b = p[QBZ9] + p[QBZ10] * (stiffness / friction if friction > 0.0 else 0.0)
    ratio = p[COMBINED] * longitudinal_stiffness(load, p) / stiffness
    slip = equivalent_slip(alpha + horizontal + vertical / stiffness, kappa, ratio)
    return load * p[R0] * (p[QDZ6] + p[QDZ7] * dfz + (p[QDZ8] + p[QDZ9] * dfz) * gamma) * math.cos(math.atan(b * slip))


def aligning_moment(kappa: float, alpha: float, camber: float, load: float, heading: float, p: Parameters) -> float:
    """``M_z = -t (F_y - S_Vyk) cos alpha + M_zr cos alpha + s F_x`` [N m], positive to the left.

    `heading` is ``V_x/|V|``, the signed cosine of alpha (see `slip.heading`): negative rolling backwards, 0 at
    standstill. ``s = R_0 (SSZ1 + SSZ2 F_y/F_zN + (SSZ3 + SSZ4 df_z) gamma)`` counts with combined slip only.
    """
    load = within(load, 0.0, p[FZMAX])
    if load < SMALLEST_LOAD:
        return 0.0
    side, kappa = p[SIDE], within(kappa, p[KPUMIN], p[KPUMAX])
    alpha, camber = within(side * alpha, p[ALPMIN], p[ALPMAX]), within(side * camber, p[CAMMIN], p[CAMMAX])
    force = unmirrored_lateral_force(alpha, camber, load, p)
    longitudinal_part = 0.0
    if p[COMBINED] != 0.0:
        force *= lateral_weight(kappa, alpha, load, p)
        whole = force + slip_steer(kappa, alpha, camber, load, p)
        arm = p[SSZ1] + p[SSZ2] * whole / p[FZN] + (p[SSZ3] + p[SSZ4] * load_change(load, p)) * camber
        longitudinal_part = p[R0] * arm * longitudinal_force(kappa, side * alpha, side * camber, load, p)
    trail, residual = pneumatic_trail(kappa, alpha, camber, load, p), residual_moment(kappa, alpha, camber, load, p)
    return side * ((residual - trail * force) * heading + longitudinal_part)


def overturning_moment(kappa: float, alpha: float, camber: float, load: float, p: Parameters) -> float:
    """``M_x = R_0 F_z (QSX1 - QSX2 gamma + QSX3 F_y/F_zN)`` [N m], positive left side up."""
    load = within(load, 0.0, p[FZMAX])
    force = p[SIDE] * lateral_force(kappa, alpha, camber, load, p)
    gamma = within(p[SIDE] * camber, p[CAMMIN], p[CAMMAX])
    return p[SIDE] * p[R0] * load * (p[QSX1] - p[QSX2] * gamma + p[QSX3] * force / p[FZN])


def rolling_resistance_moment(force: float, speed: float, load: float, heading: float, p: Parameters) -> float:
    """``M_y = -R_0 F_z (QSY1 + QSY2 F_x/F_zN + QSY3 |V_x/V_0| + QSY4 (V_x/V_0)^4) V_x/|V|`` [N m]: against the rolling.

    Args:
        force: F_x [N].
        speed: V_x [m/s].
        load: F_z [N].
        heading: ``V_x/|V|``; 0 at standstill, where the moment vanishes.
        p: the parameters.
    """
    share = abs(speed) / p[VREF]
    factor = p[QSY1] + p[QSY2] * force / p[FZN] + p[QSY3] * share + p[QSY4] * share**4
    return -p[R0] * within(load, 0.0, p[FZMAX]) * max(0.0, factor) * heading


def longitudinal_relaxation_length(load: float, p: Parameters) -> float:
    """``sigma_x = F_z (PTX1 + PTX2 df_z) exp(-PTX3 df_z) R_0/F_zN`` [m]."""
    load = within(load, 0.0, p[FZMAX])
    dfz = load_change(load, p)
    return load * (p[PTX1] + p[PTX2] * dfz) * math.exp(-p[PTX3] * dfz) * p[R0] / p[FZN]


def lateral_relaxation_length(camber: float, load: float, p: Parameters) -> float:
    """``sigma_y = PTY1 sin(2 atan(F_z/(PTY2 F_z0))) (1 - PKY3 |gamma|) R_0`` [m]."""
    load = within(load, 0.0, p[FZMAX])
    gamma = within(camber, p[CAMMIN], p[CAMMAX]) * p[LGAY]
    return p[PTY1] * math.sin(2.0 * math.atan(load / (p[PTY2] * p[FZ0]))) * (1.0 - p[PKY3] * abs(gamma)) * p[R0]


def arctangent(x: float) -> float:
    """``atan x`` to 3e-16 of itself, compiled in line: reduced to ``|z| < tan(pi/8)``, there a polynomial."""
    size = abs(x)
    large = 1.0 if size > 2.414213562373095 else 0.0
    middle = 1.0 - large if size > 0.41421356237309503 else 0.0
    z = ((size - middle) * (1.0 - large) - large) / (1.0 + middle * size + large * (size - 1.0))
    u = z * z
    v = u * u
    w = v * v
    low = 1.0 - 0.3333333333333312 * u + v * (0.19999999999940535 - 0.14285714279231376 * u)
    high = 0.11111110744489916 - 0.09090896805970061 * u + v * (0.07692045380163111 - 0.06662953121072139 * u)
    highest = 0.058468911831827994 - 0.0503516960175827 * u + v * (0.03796709126162387 - 0.01780747025122684 * u)
    return math.copysign(0.25 * math.pi * (middle + 2.0 * large) + z * (low + w * (high + w * highest)), x)


def sine(x: float) -> float:
    """``sin x`` to 4e-16, compiled in line: reduced to ``|r| < pi/2``, there a polynomial; for arguments of a few
    turns."""
    half_turns = math.floor(x * 0.3183098861837907 + 0.5)
    r = x - half_turns * math.pi
    u = r * r
    v = u * u
    low = 1.0 - 0.16666666666666666 * u + v * (0.00833333333333318 - 0.00019841269841206817 * u)
    high = 2.7557319210960864e-06 - 2.5052106869068886e-08 * u
    high += v * (1.6058939909535364e-10 - 7.643003499120689e-13 * u + 2.7213494857029824e-15 * v)
    return r * (low + v * v * high) * (1 - 2 * (half_turns & 1))


def equivalent_tangent(angle: float, ratio: float) -> float:
    """Tangent of the size of `equivalent_slip`, for ``ratio = K_x kappa/K_y``, with ``tan² = sin²/(1 - sin²)``."""
    square = sine(angle) ** 2
    return math.sqrt(square / max(1.0 - square, 1e-30) + ratio * ratio)


def magic_formula_contact(  # noqa: PLR0915, C901 - one long formula, in the order in which the processor overlaps it best
    kappa: float,
    tan_alpha: float,
    camber: float,
    load: float,
    rolling: float,
    lateral: float,
    friction: float,
    p: Parameters,
    out: MutableSequence[float],
) -> None:
    """All of the functions above in one, as a contact law (see `contact_tyre.CONTACT`).

    The road's friction f acts as if LMUX and LMUY were f times what they are: it multiplies the friction, the vertical
    shifts and the residual moment and divides the stiffness factors of the moment; the slip stiffnesses stay. The
    cosine of an arc tangent is ``1/sqrt(1 + x²)``, the sine of twice one ``2 x/(1 + x²)``. Arc tangents that do not
    need each other stand side by side, because then they are computed at the same time.

    Names end in what they belong to: x, y the forces, a, k their weights over alpha and kappa, t the trail, r the
    residual.
    """
    share = max(0.0, load) * p[PER_FZ0]
    radius = p[R0] - p[DEFLECTION] * (p[DREFF] * arctangent(p[BREFF] * share) + p[FREFF] * share)
    load = min(load, p[FZMAX])
    if load < SMALLEST_LOAD:
        for i in range(5):
            out[i] = 0.0
        out[5], out[6], out[7] = p[SIGMA_LEAST], p[SIGMA_LEAST], radius
        return
    side, grip, size = p[SIDE], max(friction, SMALLEST_FRICTION), load * p[R0]
    kappa = within(kappa, p[KPUMIN], p[KPUMAX])
    alpha = within(side * arctangent(tan_alpha), p[ALPMIN], p[ALPMAX])
    camber = within(side * camber, p[CAMMIN], p[CAMMAX])
    dfz = load * p[PER_FZ0] - 1.0

    gamma = camber * p[LGAX]
    stiffness_x = load * (p[PKX1] + p[PKX2] * dfz) * math.exp(p[PKX3] * dfz)
    peak_x = grip * load * max(0.0, (p[PDX1] + p[PDX2] * dfz) * (1.0 - p[PDX3] * gamma * gamma))
    slip_x = kappa + p[PHX1] + p[PHX2] * dfz
    e_x = min(1.0, (p[PEX1] + (p[PEX2] + p[PEX3] * dfz) * dfz) * (1.0 - math.copysign(p[PEX4], p[PEX4] * slip_x)))
    gamma = camber * p[LGAY]
    lean, heavy, heavy_sigma = 1.0 - p[PKY3] * abs(gamma), load * p[PER_KY_LOAD], load * p[PER_SY_LOAD]
    stiffness_y = p[KY_MOST] * lean * 2.0 * heavy / (1.0 + heavy * heavy)
    peak_y = grip * load * max(0.0, (p[PDY1] + p[PDY2] * dfz) * (1.0 - p[PDY3] * gamma * gamma))
    vertical_y = grip * load * (p[PVY1] + p[PVY2] * dfz + (p[PVY3] + p[PVY4] * dfz) * gamma)
    slip_y = alpha + p[PHY1] + p[PHY2] * dfz + p[PHY3] * gamma
    skew = p[PEY3] + p[PEY4] * gamma
    e_y = min(1.0, (p[PEY1] + p[PEY2] * dfz) * (1.0 - math.copysign(skew, skew * slip_y)))
    gamma = camber * p[LGAZ]
    slip_t = alpha + p[QHZ1] + p[QHZ2] * dfz + (p[QHZ3] + p[QHZ4] * dfz) * gamma
    b_t = (p[QBZ1] + (p[QBZ2] + p[QBZ3] * dfz) * dfz) * (1.0 + p[QBZ4] * gamma + p[QBZ5] * abs(gamma)) / grip
    b_r = p[QBZ9] / grip
    b_a = p[RBX1] / math.sqrt(1.0 + (p[RBX2] * kappa) ** 2)
    b_k = p[RBY1] / math.sqrt(1.0 + (p[RBY2] * (alpha - p[RBY3])) ** 2)
    shift_k = p[RHY1] + p[RHY2] * dfz
    e_a, e_k = min(1.0, p[REX1] + p[REX2] * dfz), min(1.0, p[REY1] + p[REY2] * dfz)

    # B times slip of every curve
    x, y, a, k = 0.0, 0.0, b_a * (alpha + p[RHX1]), b_k * (kappa + shift_k)
    if peak_x > 0.0:
        x = stiffness_x / (p[PCX1] * peak_x) * slip_x
    if peak_y > 0.0:
        y = stiffness_y / (p[PCY1] * peak_y) * slip_y
        b_r += p[QBZ10] * stiffness_y / peak_y
    ratio = p[COMBINED] * stiffness_x * kappa / stiffness_y
    t, r = equivalent_tangent(slip_t, ratio), equivalent_tangent(slip_y + vertical_y / stiffness_y, ratio)
    t, r = arctangent(t), arctangent(r)
    t, r = b_t * math.copysign(t, slip_t), b_r * r
    # the inner arc tangents, the outer ones, the curves
    in_x, in_y, in_t, skew = arctangent(x), arctangent(y), arctangent(t), arctangent(b_t * p[QCZ1] * slip_t)
    in_a, in_k = a, k
    if e_a != 0.0 or e_k != 0.0:  # often both are zero
        in_a, in_k = arctangent(a), arctangent(k)
    e_t = p[QEZ1] + (p[QEZ2] + p[QEZ3] * dfz) * dfz
    e_t = min(1.0, e_t * (1.0 + (p[QEZ4] + p[QEZ5] * gamma) * (2.0 / math.pi) * skew))
    x, y = arctangent(x - e_x * (x - in_x)), arctangent(y - e_y * (y - in_y))
    a, k = arctangent(a - e_a * (a - in_a)), arctangent(k - e_k * (k - in_k))
    t = arctangent(t - e_t * (t - in_t))
    fx, fy = peak_x * sine(p[PCX1] * x), peak_y * sine(p[PCY1] * y)
    a, k = sine(0.5 * math.pi + p[RCX1] * a), sine(0.5 * math.pi + p[RCY1] * k)
    trail = size * p[PER_FZN] * (p[QDZ1] + p[QDZ2] * dfz) * (1.0 + (p[QDZ3] + p[QDZ4] * gamma) * gamma)
    trail *= sine(0.5 * math.pi + p[QCZ1] * t)
    residual = grip * size * (p[QDZ6] + p[QDZ7] * dfz + (p[QDZ8] + p[QDZ9] * dfz) * gamma) / math.sqrt(1.0 + r * r)

    if peak_x > 0.0:
        fx += grip * load * (p[PVX1] + p[PVX2] * dfz)
    if peak_y > 0.0:
        fy += vertical_y
    whole, arm = fy, 0.0
    if p[COMBINED] != 0.0:
        if p[RHX1] != 0.0 or shift_k != 0.0:  # the weights are 1 without the other slip
            zero_a, zero_k = b_a * p[RHX1], b_k * shift_k
            in_a, in_k = arctangent(zero_a), arctangent(zero_k)
            zero_a, zero_k = arctangent(zero_a - e_a * (zero_a - in_a)), arctangent(zero_k - e_k * (zero_k - in_k))
            a, k = a / sine(0.5 * math.pi + p[RCX1] * zero_a), k / sine(0.5 * math.pi + p[RCY1] * zero_k)
        steer = peak_y * (p[RVY1] + p[RVY2] * dfz + p[RVY3] * camber)
        if steer != 0.0:
            steer *= sine(p[RVY5] * arctangent(p[RVY6] * kappa)) / math.sqrt(1.0 + (p[RVY4] * alpha) ** 2)
        fx, fy = a * fx, k * fy
        whole = fy + steer
        arm = p[R0] * (p[SSZ1] + p[SSZ2] * whole * p[PER_FZN] + (p[SSZ3] + p[SSZ4] * dfz) * camber)

    heading = rolling / math.sqrt(rolling * rolling + lateral * lateral + 0.01)
    speed = abs(rolling) * p[PER_VREF]
    resistance = p[QSY1] + p[QSY2] * fx * p[PER_FZN] + p[QSY3] * speed + p[QSY4] * speed**4
    sigma_x = size * p[PER_FZN] * (p[PTX1] + p[PTX2] * dfz) * math.exp(-p[PTX3] * dfz)
    sigma_y = p[SY_MOST] * lean * 2.0 * heavy_sigma / (1.0 + heavy_sigma * heavy_sigma)
    out[0] = fx
    out[1] = side * whole
    out[2] = side * size * (p[QSX1] - p[QSX2] * camber + p[QSX3] * whole * p[PER_FZN])
    out[3] = -size * max(0.0, resistance) * heading
    out[4] = side * ((residual - trail * fy) * heading + arm * fx)
    out[5], out[6], out[7] = max(sigma_x, p[SIGMA_LEAST]), max(sigma_y, p[SIGMA_LEAST]), radius
