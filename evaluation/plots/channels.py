"""Which channels of a comparison are drawn, and what a reader calls them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from susp_mj.names import QUANTITIES

from ..display import shown

if TYPE_CHECKING:
    from ..compare import Configuration

STATIONS = {
    "fl": "front left",
    "fr": "front right",
    "rl": "rear left",
    "rr": "rear right",
    "l": "left",
    "r": "right",
    "front": "front axle",
    "rear": "rear axle",
}
"""Stations as a reader calls them."""


def quantity_label(quantity: str) -> str:
    """Quantity and shown unit, as an axis is named."""
    unit = shown(QUANTITIES[quantity][0]).unit
    return f"{quantity.replace('_', ' ')} [{unit}]"


def station_name(station: str) -> str:
    """What a reader calls a station."""
    return STATIONS.get(station, station)


def stations_with(configurations: Sequence[Configuration], quantity: str) -> list[str]:
    """Stations at which any configuration recorded the quantity."""
    return list(dict.fromkeys(station for each in configurations for station in each.run.stations(quantity)))


def stands_still(configurations: Sequence[Configuration], quantity: str) -> bool:
    """Whether an input is not used in any configuration."""
    return all(np.ptp(values) < 1e-12 for each in configurations for values in each.run.stations(quantity).values())
