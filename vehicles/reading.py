"""Vehicle files: found by name or path, parsed once; a set of characteristics and overrides go on top."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from susp_mj.description import validate
from susp_mj.errors import InputError, choices
from susp_mj.plugins import load_plugins

from .vehicle import Vehicle

FOLDER = Path(__file__).parent
TYRES = FOLDER / "tyres"
"""Where the tyre property files that ship lie."""
WITH_OVERRIDES = " with overrides"
"""After the name of a file, the source of a car that is not quite what the file says."""


def available_vehicles() -> list[str]:
    """Names of the cars that come with susp_mj."""
    return sorted(path.stem for path in FOLDER.glob("*.toml"))


@dataclass(frozen=True)
class VehicleFile:
    """A vehicle file, opened and parsed once; its `plugins` are loaded.

    Attributes:
        path: of the file; its name without ending is the car's.
        tables: what all sets of characteristics share, as the file has it.
        sets: each set of characteristics as the file has it; none if the file has one car only.
        default: name of the set that is taken where none is asked for; empty if the file names none.
    """

    path: Path
    tables: Mapping[str, Any]
    sets: Mapping[str, Mapping[str, Any]]
    default: str

    @classmethod
    def open(cls, name: str | Path) -> VehicleFile:
        """The file of a shipped car (``"chapter3"``), or the one at a path.

        Raises:
            InputError: no such car or file, not TOML, a plugin that fails, sets that are no tables, or a default that
                is no set.
        """
        path = _find(name)
        tables = read_toml(path)
        load_plugins(tables.pop("plugins", ()), path)
        sets, default = tables.pop("characteristics", {}), tables.pop("default", "")
        if not isinstance(sets, dict) or not all(isinstance(each, dict) for each in sets.values()):
            raise InputError("must hold one table for each set", key="characteristics", source=path.name)
        if default != "" and default not in list(sets):
            raise InputError(
                f"no set '{default}'; {choices(sets or ['none'], default)}", key="default", source=path.name
            )
        return cls(path, tables, sets, default)

    @property
    def name(self) -> str:
        """Name of the car."""
        return self.path.stem

    @property
    def title(self) -> str:
        """The car in one line; its name if the file has none."""
        return str(self.tables.get("title", self.name))

    @property
    def loads(self) -> list[str]:
        """Names of the load cases."""
        loads = self.tables.get("loads", {})
        return list(loads) if isinstance(loads, dict) else []

    def vehicle(self, characteristics: str | None = None, overrides: Mapping[str, Any] | None = None) -> Vehicle:
        """The car with one set of characteristics; arguments and errors as for `load_vehicle`."""
        chosen = self._chosen(characteristics)
        source = self.path.name + (WITH_OVERRIDES if overrides else "")
        tables = deepcopy({**self.tables})
        _merge(tables, deepcopy({key: value for key, value in self.sets.get(chosen, {}).items() if key != "title"}))
        for key, value in (overrides or {}).items():
            override(tables, key, value, source)
        for reserved in ("name", "source"):
            if reserved in tables:
                raise InputError("unknown key; a car is named by its file", key=reserved, source=source)
        _find_tyres(tables, self.path, source)
        here = {"name": self.name, "source": source, "characteristics": chosen}
        return validate(Vehicle, tables | here, source=source)

    def _chosen(self, asked: str | None) -> str:
        """Name of the set asked for, or of the default one; empty if the file has one car only."""
        chosen = self.default if asked is None else asked
        if not chosen and self.sets:
            raise InputError(f"{self.path.name} has several sets; {choices(self.sets)}", key="characteristics")
        if chosen and chosen not in self.sets:
            known = choices(self.sets or ["none"], chosen)
            raise InputError(f"{self.path.name} has no set '{chosen}'; {known}", key="characteristics")
        return chosen


def load_vehicle(
    name: str | Path, characteristics: str | None = None, overrides: Mapping[str, Any] | None = None
) -> Vehicle:
    """Read a car.

    Args:
        name: a shipped car (``"chapter3"``) or the path of a TOML file.
        characteristics: which of the file's sets of characteristics; None takes the file's ``default``.
        overrides: dotted path -> value as a file would have it, applied last: ``{"rear.damper.rates": [1200]}``.

    Raises:
        InputError: file, key, value, and what is allowed.
    """
    return VehicleFile.open(name).vehicle(characteristics, overrides)


def with_overrides(vehicle: Vehicle, overrides: Mapping[str, Any]) -> Vehicle:
    """The same car with some values changed, dotted path -> value as a file would have it.

    Raises:
        InputError: as `load_vehicle`.
    """
    tables = vehicle.model_dump(exclude_none=True, serialize_as_any=True)
    source = vehicle.source.removesuffix(WITH_OVERRIDES) + WITH_OVERRIDES
    for key, value in overrides.items():
        override(tables, key, value, source)
    return validate(Vehicle, {**tables, "source": source}, source=source)


def read_toml(path: Path) -> dict[str, Any]:
    """Parse a TOML file.

    Raises:
        InputError: no such file, not readable, or not TOML (with line and column).
    """
    try:
        with path.open("rb") as file:
            return tomllib.load(file)
    except FileNotFoundError:
        raise InputError("no such file", source=str(path)) from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot be read: {error}", source=str(path)) from None
    except RecursionError:
        raise InputError("is nested too deeply", source=path.name) from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"is not TOML: {error}", source=path.name) from None


def override(tables: dict[str, Any], path: str, value: Any, source: str) -> None:
    """Put `value` at a dotted path into nested tables, making tables on the way; a number addresses a list's item.

    Raises:
        InputError: the path is none below a set of characteristics, or runs through something that is not a table.
    """
    if path.split(".", maxsplit=1)[0] in ("characteristics", "default", ""):
        raise InputError(
            "cannot be overridden; write the path as it stands below a set, like rear.damper.ratio",
            key=path,
            source=source,
        )
    *parents, last = path.split(".")
    here: Any = tables
    for depth, part in enumerate(parents):
        if isinstance(here, dict):
            here = here.setdefault(part, {})
        elif isinstance(here, list) and part.isdecimal() and int(part) < len(here):
            here = here[int(part)]
        else:
            raise InputError(f"'{'.'.join(parents[: depth + 1])}' is not a table", key=path, source=source)
    if isinstance(here, dict):
        here[last] = value
    elif isinstance(here, list) and last.isdecimal() and int(last) < len(here):
        here[int(last)] = value
    else:
        raise InputError(f"'{'.'.join(parents)}' is not a table", key=path, source=source)


def _find(name: str | Path) -> Path:
    """Path of a shipped car or of the file given.

    Raises:
        InputError: neither exists.
    """
    text = str(name)
    if text.endswith(".toml"):
        path = Path(text)
        if not _is_file(path):
            raise InputError(f"'{text[:100]}': no such file", key="vehicle")
        return path
    if text not in available_vehicles():
        raise InputError(
            f"no vehicle '{text}'; {choices(available_vehicles(), text)}, or give a .toml file", key="vehicle"
        )
    return FOLDER / f"{text}.toml"


def _find_tyres(data: dict[str, Any], path: Path, source: str) -> None:
    """Put the path of each tyre property file in place of its name: beside the vehicle file, or one that ships."""
    for axle in ("front", "rear"):
        tables = data.get(axle)
        tyre = tables.get("handling_tyre") if isinstance(tables, dict) else None
        if not isinstance(tables, dict) or not isinstance(tyre, dict) or "file" not in tyre:
            continue
        name = str(tyre["file"])
        found = next((each for each in (path.parent / name, TYRES / name) if _is_file(each)), None)
        if found is None:
            shipped = choices(sorted(each.name for each in TYRES.glob("*.tir")), name)
            raise InputError(
                f"no file '{name}' beside the vehicle file; {shipped}, or give the path of a .tir file",
                key=f"{axle}.handling_tyre.file",
                source=source,
            )
        tables["handling_tyre"] = {**tyre, "file": str(found)}


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def _merge(base: dict[str, Any], over: Mapping[str, Any]) -> None:
    """Lay `over` onto `base`; a table that names a `kind` replaces what was there."""
    for key, value in over.items():
        if isinstance(value, dict) and isinstance(base.get(key), dict) and "kind" not in value:
            _merge(base[key], value)
        else:
            base[key] = value
