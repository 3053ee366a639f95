"""Run: what a simulation leaves behind, with names, units and frames, saved as NetCDF-4."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import InputError, choices
from .files import whole
from .names import QUANTITIES

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class Channel:
    """One recorded signal.

    Attributes:
        values: (n,) array over the run's time.
        quantity: what it measures, a key of `names.QUANTITIES`.
        station: where on the car (``fl``, ``rear`` …), empty for the body or the only wheel.
        unit: SI unit.
        frame: frame and positive direction.
        description: one phrase.
    """

    values: np.ndarray
    quantity: str
    station: str = ""
    unit: str = ""
    frame: str = ""
    description: str = ""


@dataclass(frozen=True)
class Run:
    """Result of one simulation.

    Attributes:
        time: (n,) [s], evenly spaced.
        channels: signals by full name.
        meta: what was run: vehicle, load, model, manoeuvre, limits, versions; plain JSON values.
    """

    time: np.ndarray
    channels: Mapping[str, Channel]
    meta: Mapping[str, Any] = field(default_factory=dict)

    def __getitem__(self, name: str) -> np.ndarray:
        """Values of a channel.

        Raises:
            InputError: no such channel; the text lists those there are.
        """
        if name not in self.channels:
            raise InputError(f"no channel '{name}'; {choices(self.channels, name)}", source="run")
        return self.channels[name].values

    def __contains__(self, name: object) -> bool:
        return name in self.channels

    def __iter__(self) -> Iterator[str]:
        return iter(self.channels)

    def stations(self, quantity: str) -> dict[str, np.ndarray]:
        """Values of one quantity by station, in the order of the car's wheels; empty if it was not recorded."""
        return {c.station: c.values for c in self.channels.values() if c.quantity == quantity}

    @property
    def step(self) -> float:
        """Spacing of the records [s]."""
        return float(self.time[1] - self.time[0])

    def save(self, path: str | Path) -> Path:
        """Write the run as NetCDF-4; the file appears complete or not at all.

        Raises:
            InputError: the place cannot be written.
        """
        import netCDF4

        with whole(path) as unfinished, netCDF4.Dataset(unfinished, "w", format="NETCDF4") as file:
            title = str(self.meta.get("title", "susp_mj run"))
            file.setncatts({"Conventions": "CF-1.11", "title": title, "meta": json.dumps(self.meta)})
            file.createDimension("time", len(self.time))
            axis = file.createVariable("time", "f8", ("time",))
            axis.units, axis[:] = "s", self.time
            for name, channel in self.channels.items():
                variable = file.createVariable(name, "f8", ("time",), compression="zlib", complevel=1, shuffle=True)
                variable.setncatts(
                    {
                        "units": channel.unit,
                        "long_name": channel.description,
                        "quantity": channel.quantity,
                        "station": channel.station,
                        "frame": channel.frame,
                    }
                )
                variable[:] = channel.values
        return Path(path)

    @classmethod
    def load(cls, path: str | Path) -> Run:
        """Read a run that `save` wrote.

        Raises:
            InputError: no such file, or not a run.
        """
        import netCDF4

        if not Path(path).is_file():
            raise InputError("no such file", source=str(path))
        try:
            with netCDF4.Dataset(path) as file:
                file.set_auto_mask(False)
                time = np.array(file["time"][:])
                channels = {
                    name: Channel(np.array(v[:]), v.quantity, v.station, v.units, v.frame, v.long_name)
                    for name, v in file.variables.items()
                    if name != "time"
                }
                return cls(time, channels, json.loads(file.meta))
        except (OSError, RuntimeError, AttributeError, IndexError, ValueError) as error:
            raise InputError(f"is not a run of susp_mj, or damaged: {error}", source=str(path)) from None

    def to_xarray(self) -> xarray.Dataset:
        """The run as an xarray Dataset; needs the package xarray."""
        try:
            import xarray
        except ImportError:
            raise InputError("to_xarray() needs the package xarray: pip install xarray") from None
        attributes = {
            name: {"units": c.unit, "long_name": c.description, "frame": c.frame} for name, c in self.channels.items()
        }
        return xarray.Dataset(
            {name: ("time", channel.values, attributes[name]) for name, channel in self.channels.items()},
            coords={"time": ("time", self.time, {"units": "s"})},
            attrs={"meta": json.dumps(self.meta)},
        )


def described(quantity: str, values: np.ndarray, station: str = "") -> Channel:
    """Channel of a known quantity, with its unit and frame from `names.QUANTITIES`."""
    unit, frame, description = QUANTITIES[quantity]
    return Channel(values, quantity, station, unit, frame, description)
