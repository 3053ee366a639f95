"""Component level: what a characteristic at the wheel means for the spring and the damper themselves, and back.

All else in susp_mj is effective at the wheel; here a `MotionRatio` leads to the component and back (thesis appendix 5),
and springs and dampers are made from coils, valves and oil (appendices 2 and 3).
"""

from __future__ import annotations

from .conversion import damper_at_component, damper_at_wheel, spring_at_component, spring_at_wheel
from .hydraulics import BlowOff, Laminar, Orifice, Parallel, Resistance, Series, hydraulic_damper, ring_area, rod_area
from .motion_ratio import MotionRatio
from .progressive import auxiliary_springs, helical_spring, series_springs

__all__ = [
    "BlowOff",
    "Laminar",
    "MotionRatio",
    "Orifice",
    "Parallel",
    "Resistance",
    "Series",
    "auxiliary_springs",
    "damper_at_component",
    "damper_at_wheel",
    "helical_spring",
    "hydraulic_damper",
    "ring_area",
    "rod_area",
    "series_springs",
    "spring_at_component",
    "spring_at_wheel",
]
