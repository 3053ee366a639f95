"""The cars of the thesis for the reference: the quarter car of chapter 3, the saloon of appendix 9."""

from __future__ import annotations

from .reference import QuarterCar, constant_frequency_spring, linear_spring, progressive_spring, zoned_damper
from .reference_car import AxleData, CarData

CHAPTER_3 = {
    "linear": QuarterCar(483.5, linear_spring(4743, 1.2), zoned_damper([3000], [])),
    "nonlinear": QuarterCar(483.5, constant_frequency_spring(4743, 1.2), zoned_damper([3000, 600], [0.2], 1, 2)),
    "soft_linear": QuarterCar(483.5, linear_spring(4743, 1.2), zoned_damper([1200], [])),
}
"""By set of characteristics."""


def s_class_axle(frequency, rebound_force, damper, bar, base, roll_centre):
    """An axle of the shipped car: constant frequency in compression, straight in rebound, mount and frictions."""

    def spring(preload):
        top = constant_frequency_spring(preload, frequency)(0.1)
        return progressive_spring(
            preload, frequency, lower=(-0.1, rebound_force), upper=(0.1, top), onset=0.0, exponent=2.0
        )

    return AxleData(spring, damper, (-0.1, 0.1, 1e7), 1.5e6, 25.0, 150.0, bar, 1.4, base, roll_centre)


# values of the shipped car that are only estimated, held here whatever becomes of them there
PLACES = {
    "front.roll_centre_height": 0.08,
    "rear.roll_centre_height": 0.12,
    "front.spring_base": 1.4,
    "rear.spring_base": 1.1,
    "wheel_radius": 0.32,
}
S_CLASS_LOADS = {
    "ko": (1913.0, (-1.5572, 0.0, 0.3259), (769.0, 3928.0)),
    "empty": (1663.0, (-1.5244, 0.0, 0.3010), (768.0, 3810.0)),
    "full": (2063.0, (-1.6680, 0.0, 0.3022), (769.0, 4276.0)),
}
DAMPER_3, DAMPER_4 = zoned_damper([1500, 900], [0.2], 1, 2), zoned_damper([4000, 1200], [0.2], 1, 2)
S_CLASS = {
    "configuration_3_step_1": CarData(
        3.081,
        0.32,
        S_CLASS_LOADS,
        s_class_axle(1.2, 2211.0, DAMPER_3, 0.0, 1.4, 0.08),
        s_class_axle(1.1, 3017.0, DAMPER_3, 0.0, 1.1, 0.12),
    ),
    "configuration_3": CarData(
        3.081,
        0.32,
        S_CLASS_LOADS,
        s_class_axle(1.2, 2211.0, DAMPER_4, 25286.0, 1.4, 0.08),
        s_class_axle(1.1, 3017.0, DAMPER_4, 14387.0, 1.1, 0.12),
    ),
    "configuration_4": CarData(
        3.081,
        0.32,
        S_CLASS_LOADS,
        s_class_axle(1.4, 188.0, DAMPER_4, 7118.0, 1.4, 0.08),
        s_class_axle(1.3, 1551.0, DAMPER_4, 0.0, 1.1, 0.12),
    ),
}
