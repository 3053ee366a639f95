"""What is around the compiled car: the road under a wheel, and the path that a driver follows."""

from __future__ import annotations

import math

from .memory import plain


@plain
def _row(block, first, x_place, last, rows, row, spacing):
    """Height and slope over x of one row of the height field; a cubic through the points, level beyond the ends."""
    if x_place <= 0.0:
        return block[first + row], 0.0
    if x_place >= last:
        return block[first + last * rows + row], 0.0
    i = int(x_place)
    u = x_place - i
    before, after = max(i - 1, 0), min(i + 2, last)
    v0, v1 = block[first + i * rows + row], block[first + (i + 1) * rows + row]
    m0 = 0.5 * (v1 - block[first + before * rows + row])
    m1 = 0.5 * (block[first + after * rows + row] - v0)
    rise = v1 - v0
    c, d = 3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise
    return v0 + u * (m0 + u * (c + u * d)), (m0 + u * (2.0 * c + 3.0 * u * d)) / spacing


@plain
def road_at(block, x, y):
    """Height [m], slopes over x and y, and friction of `roads.Road.block` at a place [m]."""
    columns, rows, patches = int(block[2]), int(block[5]), int(block[8])
    friction = 1.0
    for i in range(patches):
        patch = 9 + 5 * i
        if block[patch] <= x < block[patch + 1] and block[patch + 2] <= y < block[patch + 3]:
            friction = block[patch + 4]
    first = 9 + 5 * patches
    x_place = (x - block[0]) / block[1]
    y_place = min(max((y - block[3]) / block[4], 0.0), rows - 1.0)
    j = min(int(y_place), max(rows - 2, 0))
    height, slope_x = _row(block, first, x_place, columns - 1, rows, j, block[1])
    slope_y = 0.0
    if rows > 1:
        left, left_slope = _row(block, first, x_place, columns - 1, rows, j + 1, block[1])
        share = y_place - j
        if 0.0 < y_place < rows - 1.0:
            slope_y = (left - height) / block[4]
        height, slope_x = height + share * (left - height), slope_x + share * (left_slope - slope_x)
    return height + block[6] * y, slope_x, slope_y + block[6], friction * block[7]


@plain
def _path_at(block, x):
    """The path's y at x [m]; straight on beyond the ends."""
    spacing, last = block[5], int(block[6]) - 1
    place = (x - block[4]) / spacing
    if place <= 0.0:
        return block[7]
    if place >= last:
        return block[7 + last]
    i = int(place)
    return block[7 + i] + (place - i) * (block[8 + i] - block[7 + i])


@plain
def deviation(block, x, y):
    """How far a place is to the left of the path of `Driver.block` [m]."""
    radius = block[3]
    if radius != 0.0:
        inside = abs(radius) - math.hypot(x, y - radius)
        return inside if radius > 0.0 else -inside
    return y - _path_at(block, x)


@plain
def wanted_angle(block, x, y, heading, speed, ratio, wheelbase):
    """Steering wheel angle of the arc from here to the path, `preview_time` ahead; see `driver.Driver`."""
    ahead = max(speed, 2.0) * block[0]
    there_x, there_y = x + ahead * math.cos(heading), y + ahead * math.sin(heading)
    error = -deviation(block, there_x, there_y)
    if block[3] == 0.0:
        error *= math.cos(heading)
    return ratio * (wheelbase + block[2] * speed * speed) * 2.0 * error / (ahead * ahead)
