"""Coefficients of the Magic Formula 6.1, one class a section of the ``.tir`` file; names and meaning as in
[besselink2010]."""

from __future__ import annotations

from typing import Annotated

from ...description import Description
from ...units import Dimensionless, PositiveForce, Quantity, Stiffness

Positive = Annotated[float, Quantity("", gt=0)]
Negative = Annotated[float, Quantity("", lt=0)]
Pressure = Annotated[float, Quantity("Pa", gt=0)]


class Operation(Description):
    """Section [OPERATING_CONDITIONS]: inflation pressure that the tyre runs at, and the one of the measurement [Pa]."""

    INFLPRES: Pressure
    NOMPRES: Pressure


class Vertical61(Description):
    """Section [VERTICAL]: load over deflection, and radii of the free and of the rolling tyre.

    Attributes:
        FNOMIN: nominal load [N].
        BREFF, DREFF, FREFF: of the effective rolling radius.
        Q_RE0, Q_V1: radius of the free tyre over R_0, and its growth with speed.
        Q_V2: growth of the stiffness with speed.
        Q_FZ2: quadratic part of the load over the deflection; the linear part follows from the stiffness.
        Q_FCX, Q_FCY: loss of load by F_x and F_y.
        PFZ1: growth of the stiffness with pressure; the tyre's own `vertical_stiffness` is at the pressure it runs at.
    """

    FNOMIN: PositiveForce
    BREFF: Dimensionless
    DREFF: Dimensionless
    FREFF: Dimensionless
    Q_RE0: Positive = 1.0
    Q_V1: Dimensionless = 0.0
    Q_V2: Dimensionless = 0.0
    Q_FZ2: Dimensionless = 0.0
    Q_FCX: Dimensionless = 0.0
    Q_FCY: Dimensionless = 0.0
    PFZ1: Dimensionless = 0.0


class Structure(Description):
    """Section [STRUCTURAL]: stiffness of the carcass along and across [N/m] at nominal load and pressure, and its
    changes.

    PCF.1 and PCF.2 with ``df_z`` and its square, PCF.3 with ``dp_i``.
    """

    LONGITUDINAL_STIFFNESS: Stiffness
    LATERAL_STIFFNESS: Stiffness
    PCFX1: Dimensionless = 0.0
    PCFX2: Dimensionless = 0.0
    PCFX3: Dimensionless = 0.0
    PCFY1: Dimensionless = 0.0
    PCFY2: Dimensionless = 0.0
    PCFY3: Dimensionless = 0.0


class Longitudinal61(Description):
    """Section [LONGITUDINAL_COEFFICIENTS]: P.. of F_x, PP.. with pressure, R.. of its fall with the slip angle."""

    PCX1: Positive
    PDX1: Positive
    PDX2: Dimensionless
    PDX3: Dimensionless = 0.0
    PEX1: Dimensionless
    PEX2: Dimensionless
    PEX3: Dimensionless
    PEX4: Dimensionless
    PKX1: Positive
    PKX2: Dimensionless
    PKX3: Dimensionless
    PHX1: Dimensionless
    PHX2: Dimensionless
    PVX1: Dimensionless
    PVX2: Dimensionless
    PPX1: Dimensionless = 0.0
    PPX2: Dimensionless = 0.0
    PPX3: Dimensionless = 0.0
    PPX4: Dimensionless = 0.0
    RBX1: Dimensionless | None = None
    RBX2: Dimensionless | None = None
    RBX3: Dimensionless = 0.0
    RCX1: Dimensionless | None = None
    REX1: Dimensionless = 0.0
    REX2: Dimensionless = 0.0
    RHX1: Dimensionless = 0.0


class Lateral61(Description):
    """Section [LATERAL_COEFFICIENTS]: P.. of F_y, PP.. with pressure, R.. of its fall with kappa and the side force by
    kappa."""

    PCY1: Positive
    PDY1: Positive
    PDY2: Dimensionless
    PDY3: Dimensionless
    PEY1: Dimensionless
    PEY2: Dimensionless
    PEY3: Dimensionless
    PEY4: Dimensionless
    PEY5: Dimensionless = 0.0
    PKY1: Negative
    PKY2: Positive
    PKY3: Dimensionless
    PKY4: Positive = 2.0
    PKY5: Dimensionless = 0.0
    PKY6: Dimensionless
    PKY7: Dimensionless
    PHY1: Dimensionless
    PHY2: Dimensionless
    PVY1: Dimensionless
    PVY2: Dimensionless
    PVY3: Dimensionless
    PVY4: Dimensionless
    PPY1: Dimensionless = 0.0
    PPY2: Dimensionless = 0.0
    PPY3: Dimensionless = 0.0
    PPY4: Dimensionless = 0.0
    PPY5: Dimensionless = 0.0
    RBY1: Dimensionless | None = None
    RBY2: Dimensionless | None = None
    RBY3: Dimensionless = 0.0
    RBY4: Dimensionless = 0.0
    RCY1: Dimensionless | None = None
    REY1: Dimensionless = 0.0
    REY2: Dimensionless = 0.0
    RHY1: Dimensionless = 0.0
    RHY2: Dimensionless = 0.0
    RVY1: Dimensionless = 0.0
    RVY2: Dimensionless = 0.0
    RVY3: Dimensionless = 0.0
    RVY4: Dimensionless = 0.0
    RVY5: Dimensionless = 0.0
    RVY6: Dimensionless = 0.0


class Aligning61(Description):
    """Section [ALIGNING_COEFFICIENTS]: Q.. of the pneumatic trail and the residual moment, S.. of the arm of F_x, PPZ..
    with pressure."""

    QBZ1: Dimensionless
    QBZ2: Dimensionless
    QBZ3: Dimensionless
    QBZ4: Dimensionless
    QBZ5: Dimensionless
    QBZ9: Dimensionless
    QBZ10: Dimensionless = 0.0
    QCZ1: Dimensionless
    QDZ1: Dimensionless
    QDZ2: Dimensionless
    QDZ3: Dimensionless
    QDZ4: Dimensionless
    QDZ6: Dimensionless
    QDZ7: Dimensionless
    QDZ8: Dimensionless
    QDZ9: Dimensionless
    QDZ10: Dimensionless = 0.0
    QDZ11: Dimensionless = 0.0
    QEZ1: Dimensionless
    QEZ2: Dimensionless
    QEZ3: Dimensionless
    QEZ4: Dimensionless
    QEZ5: Dimensionless
    QHZ1: Dimensionless
    QHZ2: Dimensionless
    QHZ3: Dimensionless
    QHZ4: Dimensionless
    PPZ1: Dimensionless = 0.0
    PPZ2: Dimensionless = 0.0
    SSZ1: Dimensionless = 0.0
    SSZ2: Dimensionless = 0.0
    SSZ3: Dimensionless = 0.0
    SSZ4: Dimensionless = 0.0


class Overturning61(Description):
    """Section [OVERTURNING_COEFFICIENTS]; without it there is no overturning moment."""

    QSX1: Dimensionless = 0.0
    QSX2: Dimensionless = 0.0
    QSX3: Dimensionless = 0.0
    QSX4: Dimensionless = 0.0
    QSX5: Dimensionless = 0.0
    QSX6: Dimensionless = 0.0
    QSX7: Dimensionless = 0.0
    QSX8: Dimensionless = 0.0
    QSX9: Dimensionless = 0.0
    QSX10: Dimensionless = 0.0
    QSX11: Dimensionless = 0.0
    QSX12: Dimensionless = 0.0
    QSX13: Dimensionless = 0.0
    QSX14: Dimensionless = 0.0
    PPMX1: Dimensionless = 0.0


class Rolling61(Description):
    """Section [ROLLING_COEFFICIENTS]; without it there is no rolling resistance. QSY7, QSY8: exponents of load and
    pressure."""

    QSY1: Dimensionless = 0.0
    QSY2: Dimensionless = 0.0
    QSY3: Dimensionless = 0.0
    QSY4: Dimensionless = 0.0
    QSY5: Dimensionless = 0.0
    QSY6: Dimensionless = 0.0
    QSY7: Positive = 1.0
    QSY8: Dimensionless = 0.0


class Scaling61(Description):
    """Section [SCALING_COEFFICIENTS]: factors on the coefficients, 1 where the file gives none."""

    LFZO: Positive = 1.0
    LCX: Positive = 1.0
    LMUX: Positive = 1.0
    LEX: Dimensionless = 1.0
    LKX: Positive = 1.0
    LHX: Dimensionless = 1.0
    LVX: Dimensionless = 1.0
    LCY: Positive = 1.0
    LMUY: Positive = 1.0
    LEY: Dimensionless = 1.0
    LKY: Positive = 1.0
    LKYC: Dimensionless = 1.0
    LKZC: Dimensionless = 1.0
    LHY: Dimensionless = 1.0
    LVY: Dimensionless = 1.0
    LTR: Dimensionless = 1.0
    LRES: Dimensionless = 1.0
    LXAL: Dimensionless = 1.0
    LYKA: Dimensionless = 1.0
    LVYKA: Dimensionless = 1.0
    LS: Dimensionless = 1.0
    LMX: Dimensionless = 1.0
    LVMX: Dimensionless = 1.0
    LMY: Dimensionless = 1.0
