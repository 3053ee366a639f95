"""Tables of `handling.block.table`, for compiled code."""

from __future__ import annotations

from numba import types

from ..memory import doubles, plain


@plain
def cubic(v0, m0, v1, m1, u):
    """Value and slope of the cubic from v0 to v1 with slopes m0 and m1 at a share u of the way; straight on beyond
    it."""
    if u < 0.0:
        return v0 + m0 * u, m0
    if u > 1.0:
        return v1 + m1 * (u - 1.0), m1
    rise = v1 - v0
    c, d = 3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise
    return v0 + u * (m0 + u * (c + u * d)), m0 + u * (2.0 * c + 3.0 * u * d)


@plain
def looked_up(table, x):
    """Value and slope of a table with one curve."""
    place = (x - table[0]) * table[1]
    i = min(max(int(place), 0), int(table[2]) - 2)
    at = 3 + 2 * i
    value, slope = cubic(table[at], table[at + 1], table[at + 2], table[at + 3], place - i)
    return value, slope * table[1]


@plain
def both_looked_up(table, x):
    """Values and slopes of a table with two curves."""
    place = (x - table[0]) * table[1]
    i = min(max(int(place), 0), int(table[2]) - 2)
    at, u = 3 + 4 * i, place - i
    first, first_slope = cubic(table[at], table[at + 1], table[at + 4], table[at + 5], u)
    second, second_slope = cubic(table[at + 2], table[at + 3], table[at + 6], table[at + 7], u)
    return first, first_slope * table[1], second, second_slope * table[1]


@plain
def both_between(address, x, s):
    """As `both_looked_up`, of tables for even values of s; linear between them, held outside."""
    head = doubles(address)
    rows, stride = int(head[2]), int(head[3])
    first = address + types.uint64(32)
    if rows == 1:
        return both_looked_up(doubles(first), x)
    place = min(max((s - head[0]) * head[1], 0.0), rows - 1.0)
    j = min(int(place), rows - 2)
    share = place - j
    v, m, w, n = both_looked_up(doubles(first + types.uint64(8 * stride * j)), x)
    v1, m1, w1, n1 = both_looked_up(doubles(first + types.uint64(8 * stride * (j + 1))), x)
    return v + share * (v1 - v), m + share * (m1 - m), w + share * (w1 - w), n + share * (n1 - n)
