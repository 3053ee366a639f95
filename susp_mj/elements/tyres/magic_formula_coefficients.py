"""Coefficients of the Magic Formula 5.2, one class a section of the ``.tir`` file; names and meaning as in
[msc2008]."""

from __future__ import annotations

from typing import Annotated

from ...description import Description
from ...units import Dimensionless, Quantity

Positive = Annotated[float, Quantity("", gt=0)]
Negative = Annotated[float, Quantity("", lt=0)]


class Longitudinal(Description):
    """Section [LONGITUDINAL_COEFFICIENTS]: P.. of F_x and its relaxation length, R.. of its fall with the slip
    angle."""

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
    RBX1: Dimensionless | None = None
    RBX2: Dimensionless | None = None
    RCX1: Dimensionless | None = None
    REX1: Dimensionless = 0.0
    REX2: Dimensionless = 0.0
    RHX1: Dimensionless = 0.0
    PTX1: Dimensionless
    PTX2: Dimensionless
    PTX3: Dimensionless


class Lateral(Description):
    """Section [LATERAL_COEFFICIENTS]: P.. of F_y and its relaxation length, R.. of its fall with kappa and the side
    force by kappa."""

    PCY1: Positive
    PDY1: Positive
    PDY2: Dimensionless
    PDY3: Dimensionless
    PEY1: Dimensionless
    PEY2: Dimensionless
    PEY3: Dimensionless
    PEY4: Dimensionless
    PKY1: Negative
    PKY2: Positive
    PKY3: Dimensionless
    PHY1: Dimensionless
    PHY2: Dimensionless
    PHY3: Dimensionless
    PVY1: Dimensionless
    PVY2: Dimensionless
    PVY3: Dimensionless
    PVY4: Dimensionless
    RBY1: Dimensionless | None = None
    RBY2: Dimensionless | None = None
    RBY3: Dimensionless = 0.0
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
    PTY1: Dimensionless
    PTY2: Positive


class Aligning(Description):
    """Section [ALIGNING_COEFFICIENTS]: Q.. of the pneumatic trail and the residual moment, S.. of the arm of F_x."""

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
    QEZ1: Dimensionless
    QEZ2: Dimensionless
    QEZ3: Dimensionless
    QEZ4: Dimensionless
    QEZ5: Dimensionless
    QHZ1: Dimensionless
    QHZ2: Dimensionless
    QHZ3: Dimensionless
    QHZ4: Dimensionless
    SSZ1: Dimensionless = 0.0
    SSZ2: Dimensionless = 0.0
    SSZ3: Dimensionless = 0.0
    SSZ4: Dimensionless = 0.0


class Overturning(Description):
    """Section [OVERTURNING_COEFFICIENTS]; without it there is no overturning moment."""

    QSX1: Dimensionless = 0.0
    QSX2: Dimensionless = 0.0
    QSX3: Dimensionless = 0.0


class Rolling(Description):
    """Section [ROLLING_COEFFICIENTS]; without it there is no rolling resistance."""

    QSY1: Dimensionless = 0.0
    QSY2: Dimensionless = 0.0
    QSY3: Dimensionless = 0.0
    QSY4: Dimensionless = 0.0


class Scaling(Description):
    """Section [SCALING_COEFFICIENTS]: factors on the coefficients, 1 where the file gives none."""

    LFZO: Positive = 1.0
    LCX: Positive = 1.0
    LMUX: Positive = 1.0
    LEX: Dimensionless = 1.0
    LKX: Positive = 1.0
    LHX: Dimensionless = 1.0
    LVX: Dimensionless = 1.0
    LGAX: Dimensionless = 1.0
    LCY: Positive = 1.0
    LMUY: Positive = 1.0
    LEY: Dimensionless = 1.0
    LKY: Positive = 1.0
    LHY: Dimensionless = 1.0
    LVY: Dimensionless = 1.0
    LGAY: Dimensionless = 1.0
    LTR: Dimensionless = 1.0
    LRES: Dimensionless = 1.0
    LGAZ: Dimensionless = 1.0
    LXAL: Dimensionless = 1.0
    LYKA: Dimensionless = 1.0
    LVYKA: Dimensionless = 1.0
    LS: Dimensionless = 1.0
    LSGKP: Dimensionless = 1.0
    LSGAL: Dimensionless = 1.0
    LMX: Dimensionless = 1.0
    LVMX: Dimensionless = 1.0
    LMY: Dimensionless = 1.0
