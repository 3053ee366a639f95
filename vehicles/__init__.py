"""What a car is: `load_vehicle` reads a TOML file into a validated `Vehicle`."""

from __future__ import annotations

from .reading import VehicleFile, available_vehicles, load_vehicle, with_overrides
from .vehicle import Axle, LoadCase, Vehicle

__all__ = ["Axle", "LoadCase", "Vehicle", "VehicleFile", "available_vehicles", "load_vehicle", "with_overrides"]
