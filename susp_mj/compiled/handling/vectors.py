"""Vectors and small angles, for compiled code: triples of numbers, rotation matrices by rows."""

from __future__ import annotations

import math

from ..memory import plain


@plain
def combined(a, u, b, v, c, w):
    """Sum of three vectors times numbers."""
    return (a * u[0] + b * v[0] + c * w[0], a * u[1] + b * v[1] + c * w[1], a * u[2] + b * v[2] + c * w[2])


@plain
def cross(a, b):
    """Vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@plain
def dot(a, b):
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@plain
def turned(r, v):
    """Body to inertial axes; r is a rotation matrix by rows."""
    return (
        r[0] * v[0] + r[1] * v[1] + r[2] * v[2],
        r[3] * v[0] + r[4] * v[1] + r[5] * v[2],
        r[6] * v[0] + r[7] * v[1] + r[8] * v[2],
    )


@plain
def turned_back(r, v):
    """Inertial to body axes."""
    return (
        r[0] * v[0] + r[3] * v[1] + r[6] * v[2],
        r[1] * v[0] + r[4] * v[1] + r[7] * v[2],
        r[2] * v[0] + r[5] * v[1] + r[8] * v[2],
    )


@plain
def sine_cosine(angle):
    """Sine and cosine; the angles of wheels are small, where seven terms of the series are exact and quicker."""
    if abs(angle) > 0.35:
        return math.sin(angle), math.cos(angle)
    s = angle * angle
    sine = 1.0 - s / 42.0 * (1.0 - s / 72.0 * (1.0 - s / 110.0 * (1.0 - s / 156.0)))
    cosine = 1.0 - s / 56.0 * (1.0 - s / 90.0 * (1.0 - s / 132.0 * (1.0 - s / 182.0)))
    sine = angle * (1.0 - s / 6.0 * (1.0 - s / 20.0 * sine))
    cosine = 1.0 - s / 2.0 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * cosine))
    return sine, cosine


@plain
def arc_sine(x):
    """Arc sine; for the small leans of wheels by its series."""
    if abs(x) > 0.15:
        return math.asin(min(max(x, -1.0), 1.0))
    s = x * x
    high = 35.0 / 1152.0 + s * (63.0 / 2816.0 + s * (231.0 / 13312.0))
    return x * (1.0 + s * (1.0 / 6.0 + s * (3.0 / 40.0 + s * (5.0 / 112.0 + s * high))))
