"""Rotations of bodies; x forwards, y to the left, z up."""

from __future__ import annotations

import numpy as np


def about_x(angle: float) -> np.ndarray:
    """(3, 3) rotation about the longitudinal axis; positive lifts the left side."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0, 0], [0, c, -s], [0, s, c]])


def about_y(angle: float) -> np.ndarray:
    """(3, 3) rotation about the lateral axis; positive lowers the front."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1.0, 0], [-s, 0, c]])


def about_z(angle: float) -> np.ndarray:
    """(3, 3) rotation about the vertical axis; positive to the left."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


def upright(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """(3, 3) rotation whose z axis points from `start` to `end`, its x axis as far forward as can be."""
    z = (end - start) / np.linalg.norm(end - start)
    y = np.cross(z, [1.0, 0.0, 0.0])
    y /= np.linalg.norm(y)
    return np.column_stack([np.cross(y, z), y, z])
