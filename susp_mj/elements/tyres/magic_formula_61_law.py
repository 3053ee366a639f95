"""Magic Formula 6.1: the contact law, one plain scalar function.

Axes and signs are those of `magic_formula_law`. With ``alpha* = tan alpha``, ``gamma* = sin gamma`` (gamma itself in
mu_x, M_x and M_y), ``df_z = (F_z - F_z0)/F_z0``, every shape ``sin`` or ``cos`` of ``C atan(B x - E (B x - atan(B
x)))`` with E at most 1:

    F_x0 = mu_x F_z sin(..; C = PCX1, E_x, x = kappa + S_Hx) + S_Vx                        B_x = K_x/(C_x mu_x F_z)
    K_x  = F_z (PKX1 + PKX2 df_z) exp(PKX3 df_z)
    F_y0 = mu_y F_z sin(..; C = PCY1, E_y, x = alpha* + S_Hy) + S_Vy                       B_y = K_y/(C_y mu_y F_z)
    K_y  = PKY1 F_z0 (1 - PKY3 |gamma*|) sin(PKY4 atan(F_z/F_z0/(PKY2 + PKY5 gamma*²)))
    S_Hy = PHY1 + PHY2 df_z + (F_z (PKY6 + PKY7 df_z) gamma* - S_Vyg)/K_y                  S_Vyg = F_z (PVY3 + PVY4
    df_z) gamma* F_x  = G_xa F_x0,  F_y = G_yk F_y0 + S_Vyk                                             the weights as
    in MF 5.2 M_z  = -t F_y' + M_zr + s F_x                                                          F_y' = G_yk F_y0
    without camber t    = D_t cos(..; x = sgn(a) sqrt(a² + (K_x kappa/K_y)²)) cos alpha                   M_zr = D_r
    cos(atan(B_r x)) cos alpha M_x  = R_0 F_z (QSX1 - QSX2 gamma + QSX3 F_y/F_z0 + QSX10 gamma atan(QSX11 F_z/F_z0) -
    QSX12 gamma |gamma|
           + QSX4 cos(QSX5 atan((QSX6 F_z/F_z0)²)) sin(QSX7 gamma + QSX8 atan(QSX9 F_y/F_z0))) + R_0 F_y (QSX13 + QSX14
           |gamma|)
    M_y  = -R_0 F_z0 (QSY1 + QSY2 F_x/F_z0 + QSY3 |V_x/V_0| + QSY4 (V_x/V_0)^4 + (QSY5 + QSY6 F_z/F_z0) gamma²)
    (F_z/F_z0)^QSY7 R_e  = R_0 (Q_RE0 + Q_V1 (V_x/V_0)²) - F_z0/C_z (DREFF atan(BREFF F_z/F_z0) + FREFF F_z/F_z0)
    sigma_x = K_x/C_x, sigma_y = |K_y|/C_y                                                 C_x, C_y stiffness of the
    carcass

Inflation pressure enters through the parameters (see `magic_formula_61.MagicFormula61Tyre.parameters`), the wheel's
speed in R_e through the speed of the contact point. Turn slip is left out (every zeta is 1), and so is the fall of
friction with sliding speed. The trail's and its stiffness factor's camber terms carry the sign of the camber, as in
[besselink2010].

Sources: [pacejka2012], section 4.3.2, equations 4.E1 to 4.E78; [besselink2010].
"""

from __future__ import annotations

import math
from collections.abc import MutableSequence

from ..law import Parameters

# fmt: off
PARAMETERS = (
    "SIDE", "COMBINED", "R0", "FZMAX", "KPUMIN", "KPUMAX", "TANMIN", "TANMAX", "CAMMIN", "CAMMAX",
    "PCX1", "PDX1", "PDX2", "PDX3", "PEX1", "PEX2", "PEX3", "PEX4", "PKX1", "PKX2", "PKX3", "PHX1", "PHX2", "PVX1",
    "PVX2",
    "RBX1", "RBX2", "RBX3", "RCX1", "REX1", "REX2", "RHX1",
    "PCY1", "PDY1", "PDY2", "PDY3", "PEY1", "PEY2", "PEY3", "PEY4", "PEY5", "PKY1", "PKY2", "PKY3", "PKY4", "PKY5",
    "PKY6", "PKY7",
    "PHY1", "PHY2", "PVY1", "PVY2", "PVY3", "PVY4", "RBY1", "RBY2", "RBY3", "RBY4", "RCY1", "REY1", "REY2", "RHY1",
    "RHY2",
    "RVY1", "RVY2", "RVY3", "RVY4", "RVY5", "RVY6",
    "QBZ1", "QBZ2", "QBZ3", "QBZ4", "QBZ5", "QBZ9", "QBZ10", "QCZ1", "QDZ1", "QDZ2", "QDZ3", "QDZ4", "QDZ6", "QDZ7",
    "QDZ8",
    "QDZ9", "QDZ10", "QDZ11", "QEZ1", "QEZ2", "QEZ3", "QEZ4", "QEZ5", "QHZ1", "QHZ2", "QHZ3", "QHZ4", "SSZ1", "SSZ2",
    "SSZ3", "SSZ4",
    "QSX1", "QSX2", "QSX3", "QSX4", "QSX5", "QSX6", "QSX7", "QSX8", "QSX9", "QSX10", "QSX11", "QSX12", "QSX13", "QSX14",
    "QSY1", "QSY2", "QSY3", "QSY4", "QSY5", "QSY6", "QSY7", "Q_RE0", "Q_V1", "BREFF", "DREFF", "FREFF", "DEFLECTION",
    "CX", "PCFX1", "PCFX2", "CY", "PCFY1", "PCFY2", "SIGMA_LEAST", "PER_FZ0", "PER_FZN", "FZN", "PER_VREF",
)
"""Names of the parameters, in order; FZN is the nominal load, ``PER_X = 1/X``, FZ0 the nominal load times LFZO,
``DEFLECTION = FZN/C_z``.

PKY1 is multiplied by FZ0.
"""
(
    SIDE, COMBINED, R0, FZMAX, KPUMIN, KPUMAX, TANMIN, TANMAX, CAMMIN, CAMMAX,
    PCX1, PDX1, PDX2, PDX3, PEX1, PEX2, PEX3, PEX4, PKX1, PKX2, PKX3, PHX1, PHX2, PVX1, PVX2,
    RBX1, RBX2, RBX3, RCX1, REX1, REX2, RHX1,
    PCY1, PDY1, PDY2, PDY3, PEY1, PEY2, PEY3, PEY4, PEY5, PKY1, PKY2, PKY3, PKY4, PKY5, PKY6, PKY7,
    PHY1, PHY2, PVY1, PVY2, PVY3, PVY4, RBY1, RBY2, RBY3, RBY4, RCY1, REY1, REY2, RHY1, RHY2,
    RVY1, RVY2, RVY3, RVY4, RVY5, RVY6,
    QBZ1, QBZ2, QBZ3, QBZ4, QBZ5, QBZ9, QBZ10, QCZ1, QDZ1, QDZ2, QDZ3, QDZ4, QDZ6, QDZ7, QDZ8,
    QDZ9, QDZ10, QDZ11, QEZ1, QEZ2, QEZ3, QEZ4, QEZ5, QHZ1, QHZ2, QHZ3, QHZ4, SSZ1, SSZ2, SSZ3, SSZ4,
    QSX1, QSX2, QSX3, QSX4, QSX5, QSX6, QSX7, QSX8, QSX9, QSX10, QSX11, QSX12, QSX13, QSX14,
    QSY1, QSY2, QSY3, QSY4, QSY5, QSY6, QSY7, Q_RE0, Q_V1, BREFF, DREFF, FREFF, DEFLECTION,
    CX, PCFX1, PCFX2, CY, PCFY1, PCFY2, SIGMA_LEAST, PER_FZ0, PER_FZN, FZN, PER_VREF,
) = range(len(PARAMETERS))
# fmt: on
SMALLEST_LOAD = 1e-9
"""Load [N] that counts as none."""
SMALLEST_FRICTION = 1e-6
"""Friction of the road that stands for none."""
RIGHT_ANGLE = 0.5 * math.pi


def within(value: float, low: float, high: float) -> float:
    """`value`, held between `low` and `high`."""
    return min(max(value, low), high)


def arctangent(x: float) -> float:
    """``atan x``, as in `magic_formula_law`; a law calls functions of its own module only."""
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
    """``sin x``, as in `magic_formula_law`."""
    half_turns = math.floor(x * 0.3183098861837907 + 0.5)
    r = x - half_turns * math.pi
    u = r * r
    v = u * u
    low = 1.0 - 0.16666666666666666 * u + v * (0.00833333333333318 - 0.00019841269841206817 * u)
    high = 2.7557319210960864e-06 - 2.5052106869068886e-08 * u
    high += v * (1.6058939909535364e-10 - 7.643003499120689e-13 * u + 2.7213494857029824e-15 * v)
    return r * (low + v * v * high) * (1 - 2 * (half_turns & 1))


def scaled_slip(stiffness: float, shape: float, peak: float, slip: float) -> float:
    """``B x = K x/(C D)``; 0 without friction."""
    return stiffness / (shape * peak) * slip if peak > 0.0 else 0.0


def contact(  # noqa: PLR0915, C901 - one long formula, in the order in which the processor overlaps it best
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
    """The formulas above as a contact law (see `contact_tyre.CONTACT`); the road's friction works as in MF 5.2.

    Names end in what they belong to: x, y the forces, z the side force without camber, a, k the weights over alpha and
    kappa, t the trail, r the residual moment.
    """
    speed, share = abs(rolling) * p[PER_VREF], max(0.0, load) * p[PER_FZN]
    radius = p[R0] * (p[Q_RE0] + p[Q_V1] * speed * speed)
    radius -= p[DEFLECTION] * (p[DREFF] * arctangent(p[BREFF] * share) + p[FREFF] * share)
    load = min(load, p[FZMAX])
    if load < SMALLEST_LOAD:
        for i in range(5):
            out[i] = 0.0
        out[5], out[6], out[7] = p[SIGMA_LEAST], p[SIGMA_LEAST], radius
        return
    side, grip, size, share = p[SIDE], max(friction, SMALLEST_FRICTION), load * p[R0], load * p[PER_FZN]
    kappa = within(kappa, p[KPUMIN], p[KPUMAX])
    alpha = within(side * tan_alpha, p[TANMIN], p[TANMAX])
    camber = within(side * camber, p[CAMMIN], p[CAMMAX])
    gamma, dfz = sine(camber), load * p[PER_FZ0] - 1.0
    steep = gamma * gamma

    # stiffnesses, frictions, shifts
    stiffness_x = load * (p[PKX1] + p[PKX2] * dfz) * math.exp(p[PKX3] * dfz)
    heavy = load * p[PER_FZ0]
    level_y = p[PKY1] * sine(p[PKY4] * arctangent(heavy / p[PKY2]))
    stiffness_y = level_y
    if p[PKY5] != 0.0:
        stiffness_y = p[PKY1] * sine(p[PKY4] * arctangent(heavy / (p[PKY2] + p[PKY5] * steep)))
    stiffness_y *= 1.0 - p[PKY3] * abs(gamma)
    peak_x = grip * load * max(0.0, (p[PDX1] + p[PDX2] * dfz) * (1.0 - p[PDX3] * camber * camber))
    peak_z = grip * load * max(0.0, p[PDY1] + p[PDY2] * dfz)
    peak_y = peak_z * max(0.0, 1.0 - p[PDY3] * steep)
    lean_y = grip * load * (p[PVY3] + p[PVY4] * dfz) * gamma
    vertical_z = grip * load * (p[PVY1] + p[PVY2] * dfz)
    vertical_y = vertical_z + lean_y
    slip_x, slip_z = kappa + p[PHX1] + p[PHX2] * dfz, alpha + p[PHY1] + p[PHY2] * dfz
    slip_y = slip_z + (load * (p[PKY6] + p[PKY7] * dfz) * gamma - lean_y) / stiffness_y
    e_x = min(1.0, (p[PEX1] + (p[PEX2] + p[PEX3] * dfz) * dfz) * (1.0 - math.copysign(p[PEX4], p[PEX4] * slip_x)))
    e_y, skew = p[PEY1] + p[PEY2] * dfz, p[PEY3] + p[PEY4] * gamma
    e_z = min(1.0, e_y * (1.0 - math.copysign(p[PEY3], p[PEY3] * slip_z)))
    e_y = min(1.0, e_y * (1.0 + p[PEY5] * steep - math.copysign(skew, skew * slip_y)))
    slip_t = alpha + p[QHZ1] + p[QHZ2] * dfz + (p[QHZ3] + p[QHZ4] * dfz) * gamma
    slip_r = slip_y + vertical_y / stiffness_y
    ratio = p[COMBINED] * stiffness_x * kappa / stiffness_y
    b_t = (p[QBZ1] + (p[QBZ2] + p[QBZ3] * dfz) * dfz) * (1.0 + p[QBZ4] * gamma + p[QBZ5] * abs(gamma)) / grip
    b_r = p[QBZ9] / grip + (p[QBZ10] * stiffness_y / peak_y if peak_y > 0.0 else 0.0)
    b_a = (p[RBX1] + p[RBX3] * steep) / math.sqrt(1.0 + (p[RBX2] * kappa) ** 2)
    reach = math.sqrt(1.0 + (p[RBY2] * (alpha - p[RBY3])) ** 2)
    b_k, b_z, shift_k = (p[RBY1] + p[RBY4] * steep) / reach, p[RBY1] / reach, p[RHY1] + p[RHY2] * dfz
    e_a, e_k = min(1.0, p[REX1] + p[REX2] * dfz), min(1.0, p[REY1] + p[REY2] * dfz)

    # B times slip of every curve, the inner arc tangents, the outer ones, the curves
    x = scaled_slip(stiffness_x, p[PCX1], peak_x, slip_x)
    y = scaled_slip(stiffness_y, p[PCY1], peak_y, slip_y)
    z = scaled_slip(level_y, p[PCY1], peak_z, slip_z)
    a, k, zk = b_a * (alpha + p[RHX1]), b_k * (kappa + shift_k), b_z * (kappa + shift_k)
    t = b_t * math.copysign(math.sqrt(slip_t * slip_t + ratio * ratio), slip_t)
    r2 = b_r * b_r * (slip_r * slip_r + ratio * ratio)
    in_x, in_y, in_z = arctangent(x), arctangent(y), arctangent(z)
    in_a, in_k, in_t, skew = arctangent(a), arctangent(k), arctangent(t), arctangent(b_t * p[QCZ1] * slip_t)
    e_t = p[QEZ1] + (p[QEZ2] + p[QEZ3] * dfz) * dfz
    e_t = min(1.0, e_t * (1.0 + (p[QEZ4] + p[QEZ5] * gamma) * (2.0 / math.pi) * skew))
    x, y, z = arctangent(x - e_x * (x - in_x)), arctangent(y - e_y * (y - in_y)), arctangent(z - e_z * (z - in_z))
    a, k, t = arctangent(a - e_a * (a - in_a)), arctangent(k - e_k * (k - in_k)), arctangent(t - e_t * (t - in_t))
    fx, fy, fz = peak_x * sine(p[PCX1] * x), peak_y * sine(p[PCY1] * y), peak_z * sine(p[PCY1] * z)
    a, k = sine(RIGHT_ANGLE + p[RCX1] * a), sine(RIGHT_ANGLE + p[RCY1] * k)
    trail = size * p[PER_FZN] * (p[QDZ1] + p[QDZ2] * dfz) * (1.0 + (p[QDZ3] + p[QDZ4] * gamma) * gamma)
    trail *= sine(RIGHT_ANGLE + p[QCZ1] * t)
    residual = p[QDZ6] + p[QDZ7] * dfz + (p[QDZ8] + p[QDZ9] * dfz + (p[QDZ10] + p[QDZ11] * dfz) * abs(gamma)) * gamma
    residual *= grip * size / math.sqrt(1.0 + r2)

    if peak_x > 0.0:
        fx += grip * load * (p[PVX1] + p[PVX2] * dfz)
    if peak_y > 0.0:
        fy, fz = fy + vertical_y, fz + vertical_z
    arm = 0.0
    if p[COMBINED] != 0.0:
        g = k
        if p[RBY4] != 0.0:  # the weight without camber
            g = sine(RIGHT_ANGLE + p[RCY1] * arctangent(zk - e_k * (zk - arctangent(zk))))
        if p[RHX1] != 0.0 or shift_k != 0.0:  # the weights are 1 without the other slip
            zero_a, zero_k, zero_z = b_a * p[RHX1], b_k * shift_k, b_z * shift_k
            in_a, in_k, in_z = arctangent(zero_a), arctangent(zero_k), arctangent(zero_z)
            zero_a, zero_k = arctangent(zero_a - e_a * (zero_a - in_a)), arctangent(zero_k - e_k * (zero_k - in_k))
            zero_z = arctangent(zero_z - e_k * (zero_z - in_z))
            a, k = a / sine(RIGHT_ANGLE + p[RCX1] * zero_a), k / sine(RIGHT_ANGLE + p[RCY1] * zero_k)
            g /= sine(RIGHT_ANGLE + p[RCY1] * zero_z)
        steer = peak_y * (p[RVY1] + p[RVY2] * dfz + p[RVY3] * gamma)
        if steer != 0.0:
            steer *= sine(p[RVY5] * arctangent(p[RVY6] * kappa)) / math.sqrt(1.0 + (p[RVY4] * alpha) ** 2)
        fx, fy, fz = a * fx, k * fy + steer, g * fz
        arm = p[R0] * (p[SSZ1] + p[SSZ2] * fy * p[PER_FZN] + (p[SSZ3] + p[SSZ4] * dfz) * gamma)

    overturning = p[QSX1] - (p[QSX2] + p[QSX12] * abs(camber)) * camber + p[QSX3] * fy * p[PER_FZN]
    if p[QSX4] != 0.0:
        angle = sine(p[QSX7] * camber + p[QSX8] * arctangent(p[QSX9] * fy * p[PER_FZN]))
        overturning += p[QSX4] * sine(RIGHT_ANGLE + p[QSX5] * arctangent((p[QSX6] * share) ** 2)) * angle
    if p[QSX10] != 0.0:
        overturning += p[QSX10] * arctangent(p[QSX11] * share) * camber
    heading = rolling / math.sqrt(rolling * rolling + lateral * lateral + 0.01)
    resistance = p[QSY1] + p[QSY2] * fx * p[PER_FZN] + p[QSY3] * speed + p[QSY4] * speed**4
    resistance += (p[QSY5] + p[QSY6] * share) * camber * camber
    resistance *= p[R0] * p[FZN] * (share if p[QSY7] == 1.0 else share ** p[QSY7])
    out[0] = fx
    out[1] = side * fy
    out[2] = side * (size * overturning + p[R0] * fy * (p[QSX13] + p[QSX14] * abs(camber)))
    out[3] = -max(0.0, resistance) * heading
    out[4] = side * ((residual - trail * fz) * heading + arm * fx)
    out[5] = max(stiffness_x / (p[CX] * (1.0 + (p[PCFX1] + p[PCFX2] * dfz) * dfz)), p[SIGMA_LEAST])
    out[6] = max(-stiffness_y / (p[CY] * (1.0 + (p[PCFY1] + p[PCFY2] * dfz) * dfz)), p[SIGMA_LEAST])
    out[7] = radius
