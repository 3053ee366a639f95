"""Vehicle: axles with characteristics effective at the wheel, load cases, and where every value comes from."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from susp_mj.components import MotionRatio
from susp_mj.description import Description, validate, wrong
from susp_mj.elements import (
    GRAVITY,
    Aerodynamics,
    AntiRollBar,
    AnyDamper,
    AnySpring,
    AnyTyre,
    Brakes,
    Compliance,
    Kinematics,
    LinkageFriction,
    Powertrain,
    Spring,
    Steering,
    Tyre,
)
from susp_mj.elements.tyres.contact import AnyContactTyre
from susp_mj.errors import InputError, choices
from susp_mj.units import Inertia, Length, Mass, PositiveLength

AxleName = Literal["front", "rear"]
FOLDER = Path(__file__).parent
DESIGN_LOAD = "ko"
"""Name of the load case of the design position (Konstruktionslage), which every vehicle has."""
TYRES = FOLDER / "tyres"
"""Where the tyre property files that ship lie."""
HANDLING_AXLE = ("track", "unsprung_mass", "wheel_inertia", "kinematics", "compliance", "handling_tyre")
HANDLING_CAR = ("steering", "powertrain", "brakes", "aerodynamics")
"""What model `handling` needs of each axle and of the car, beyond what the oscillation models need."""


def _status(text: str) -> str:
    status, _, reason = text.partition(":")
    if status not in ("measured", "cited", "estimated") or not reason.strip():
        raise PydanticCustomError(
            "wrong", "{text}", {"text": f"'{text}' must read 'measured: …', 'cited: …' or 'estimated: …'"}
        )
    return text


Provenance = Annotated[str, AfterValidator(_status)]


class Axle(Description):
    """One axle; every value is for one wheel and effective at the wheel.

    Attributes:
        track: lateral distance of the wheel centres [m].
        spring_base: lateral distance of the springs of a rigid axle [m]; None puts them at the wheels.
        roll_centre_height: of the axle above the ground [m]; None leaves lateral forces out.
        unsprung_mass: mass [kg] that moves with one wheel.
        roll_inertia: of a rigid axle about its middle [kg m²]; None concentrates its mass in the wheels.
        anti_roll_bar: or None.
        spring, damper, tyre: see `susp_mj.elements`.
        friction: linkage friction, or None.
        kinematics, compliance: how the wheel moves over travel, steering and forces; model `handling` only.
        handling_tyre: tyre with slip; model `handling` only, the oscillation models take `tyre`. A file of it is looked
            for beside the vehicle file, then among the tyres that ship.
        wheel_inertia: of one wheel about its spin axis [kg m²], brake disc included; model `handling` only.
        spring_ratio, damper_ratio: component travel per wheel travel, for sheets of the components; the car needs
            neither.
    """

    track: PositiveLength | None = None
    spring_base: PositiveLength | None = None
    roll_centre_height: Length | None = None
    unsprung_mass: Mass | None = None
    roll_inertia: Inertia | None = None
    anti_roll_bar: AntiRollBar | None = None
    spring: AnySpring
    damper: AnyDamper
    friction: LinkageFriction | None = None
    tyre: AnyTyre | None = None
    kinematics: Kinematics | None = None
    compliance: Compliance | None = None
    handling_tyre: AnyContactTyre | None = None
    wheel_inertia: Inertia | None = None
    spring_ratio: MotionRatio | None = None
    damper_ratio: MotionRatio | None = None


class LoadCase(Description):
    """A state of loading: the whole sprung body, or only the sprung mass on one wheel of an axle.

    Attributes:
        sprung_mass: [kg].
        cg: centre of gravity [m] from the reference point (front axle, wheel-centre height): x forward, y left, z up.
        inertia: Jxx, Jyy, Jzz [kg m²] about the centre of gravity.
        corner_mass: sprung mass [kg] on one wheel, by axle; for cars known only as a quarter.
    """

    sprung_mass: Mass | None = None
    cg: tuple[Length, Length, Length] | None = None
    inertia: tuple[Inertia, Inertia, Inertia] | None = None
    corner_mass: dict[AxleName, Mass] | None = None

    @model_validator(mode="after")
    def _one_form(self) -> LoadCase:
        body = (self.sprung_mass, self.cg, self.inertia)
        if self.corner_mass is None and None in body:
            raise wrong("give sprung_mass, cg and inertia together, or corner_mass")
        if self.corner_mass is not None and any(part is not None for part in body):
            raise wrong("give either corner_mass or sprung_mass, cg and inertia, not both")
        return self


class Vehicle(Description):
    """A car, one set of characteristics chosen.

    Attributes:
        name: the file's name without ending; `source` is the file itself.
        title: one line for reports.
        characteristics: name of the chosen set, empty if the file has none.
        wheelbase: [m], needed by models with two axles.
        wheel_radius: height of the wheel centres above the ground in the design position [m].
        driver: the driver's seat [m] from the reference point, as a load case's cg.
        front, rear: the axles; a quarter car may have one only.
        steering, powertrain, brakes, aerodynamics: of the whole car, for model `handling` only.
        loads: load cases by name; ``ko`` is the design position.
        sources: dotted path -> 'measured: …', 'cited: …' or 'estimated: …', for every value of the file.
    """

    name: str
    source: str
    title: str
    characteristics: str = ""
    wheelbase: PositiveLength | None = None
    wheel_radius: PositiveLength | None = None
    driver: tuple[Length, Length, Length] | None = None
    front: Axle | None = None
    rear: Axle | None = None
    steering: Steering | None = None
    powertrain: Powertrain | None = None
    brakes: Brakes | None = None
    aerodynamics: Aerodynamics | None = None
    loads: dict[str, LoadCase] = Field(min_length=1)
    sources: dict[str, Provenance] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _complete(self) -> Vehicle:
        if DESIGN_LOAD not in self.loads:
            raise wrong(f"the load case '{DESIGN_LOAD}' (design position) is required", "loads")
        if self.front is None and self.rear is None:
            raise wrong("at least one axle is required", "front")
        return self

    @model_validator(mode="after")
    def _kinematics_reach(self) -> Vehicle:
        for name in ("front", "rear"):
            axle: Axle | None = getattr(self, name)
            if axle is None or axle.kinematics is None:
                continue
            key = f"{name}.kinematics"
            axle.kinematics.check_covers(axle.spring.stops, key)
            if name == "rear" and axle.kinematics.steer:
                raise wrong("is not allowed; only the front wheels are steered", f"{key}.steer")
            if name == "front" and self.steering is not None:
                axle.kinematics.check_covers_steering(self.steering.largest_wheel_angle, key)
        return self

    def axle(self, name: str) -> Axle:
        """The axle, its spring and tyre carrying their design loads.

        Raises:
            InputError: the car has no such axle, or an element does not fit its design load.
        """
        axle: Axle | None = getattr(self, name) if name in ("front", "rear") else None
        if axle is None:
            there = [each for each in ("front", "rear") if getattr(self, each) is not None]
            raise InputError(f"no axle '{name}'; {choices(there)}", key="axle", source=self.source)
        corner = self.corner_mass(name, DESIGN_LOAD)
        spring = self._settled(Spring.at_preload, axle.spring, corner * GRAVITY, f"{name}.spring")
        tyre = axle.tyre
        if tyre is not None:
            tyre = self._settled(
                Tyre.at_static_load, tyre, (corner + (axle.unsprung_mass or 0.0)) * GRAVITY, f"{name}.tyre"
            )
        return axle.model_copy(update={"spring": spring, "tyre": tyre})

    def _settled(self, method: Any, element: Any, force: float, key: str) -> Any:
        from pydantic import ValidationError

        from susp_mj.description import input_error

        try:
            return getattr(element, method.__name__)(force)
        except ValidationError as error:
            raise input_error(error, source=self.source, key=key) from None

    def load(self, name: str) -> LoadCase:
        """A load case by name.

        Raises:
            InputError: no such load case.
        """
        if name not in self.loads:
            raise InputError(f"no load case '{name}'; {choices(self.loads, name)}", key="load", source=self.source)
        return self.loads[name]

    def handling_needs(self) -> list[str]:
        """Dotted paths of what model `handling` still needs, in the order of the file; empty for a complete car.

        A compliance may be an empty table (a rigid suspension), but must be there.
        """
        missing = [key for key in ("wheelbase", "wheel_radius") if getattr(self, key) is None]
        missing += [f"loads.{name}.sprung_mass" for name, case in self.loads.items() if case.sprung_mass is None]
        for name in ("front", "rear"):
            axle: Axle | None = getattr(self, name)
            missing += (
                [name] if axle is None else [f"{name}.{key}" for key in HANDLING_AXLE if getattr(axle, key) is None]
            )
        return missing + [key for key in HANDLING_CAR if getattr(self, key) is None]

    def check_handling(self) -> None:
        """Refuse a car that model `handling` cannot drive.

        Raises:
            InputError: naming everything that is missing.
        """
        missing = self.handling_needs()
        if missing:
            raise InputError(
                f"model 'handling' needs what this car does not give: {', '.join(missing)}", source=self.source
            )

    def without_friction(self) -> Vehicle:
        """The same car without linkage and damper friction, for linearisation and closed forms."""
        axles = {}
        for name in ("front", "rear"):
            axle: Axle | None = getattr(self, name)
            if axle is not None:
                damper = axle.damper.model_copy(update={"friction": 0.0})
                axles[name] = axle.model_copy(update={"friction": None, "damper": damper})
        return self.model_copy(update=axles)

    def cg_height(self, load: str) -> float | None:
        """Height of the sprung mass' centre of gravity above the ground [m]; None if the car does not tell."""
        cg = self.load(load).cg
        return None if cg is None or self.wheel_radius is None else self.wheel_radius + cg[2]

    def corner_mass(self, axle: str, load: str) -> float:
        """Sprung mass [kg] carried by one wheel of an axle: ``m l_other / (l_front + l_rear) / 2``.

        Raises:
            InputError: the load case does not tell.
        """
        case = self.load(load)
        if case.corner_mass is not None:
            if axle not in case.corner_mass:
                raise InputError(
                    f"gives no mass for the {axle} axle", key=f"loads.{load}.corner_mass", source=self.source
                )
            return case.corner_mass[axle]
        if self.wheelbase is None:
            raise InputError(
                "is required to share the sprung mass between the axles", key="wheelbase", source=self.source
            )
        assert case.sprung_mass is not None and case.cg is not None
        behind_front = -case.cg[0]
        if not 0 < behind_front < self.wheelbase:
            raise InputError(
                f"{case.cg[0]} m is not allowed; the centre of gravity lies between the axles, from 0 to "
                f"-{self.wheelbase} m",
                key=f"loads.{load}.cg.0",
                source=self.source,
            )
        share = behind_front / self.wheelbase
        return case.sprung_mass * (share if axle == "rear" else 1 - share) / 2


def available_vehicles() -> list[str]:
    """Names of the cars that come with susp_mj."""
    return sorted(path.stem for path in FOLDER.glob("*.toml"))


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
    path = find_vehicle(name)
    data = read_toml(path)
    sets = data.pop("characteristics", {})
    default = data.pop("default", "")
    if not isinstance(sets, dict) or not all(isinstance(each, dict) for each in sets.values()):
        raise InputError("must hold one table for each set", key="characteristics", source=path.name)
    chosen = default if characteristics is None else characteristics
    if chosen:
        if chosen not in sets:
            raise InputError(
                f"no set '{chosen}'; {choices(sets or ['none'], chosen)}", key="characteristics", source=path.name
            )
        _merge(data, {key: value for key, value in sets[chosen].items() if key != "title"})
    elif sets:
        raise InputError(f"choose a set of characteristics: {', '.join(sets)}", key="characteristics", source=path.name)
    for key, value in (overrides or {}).items():
        if key.split(".")[0] in ("characteristics", "default", ""):
            raise InputError(
                "cannot be overridden; write the path as it stands below a set, like rear.damper.ratio",
                key=key,
                source=path.name,
            )
        set_by_path(data, key, value, source=path.name)
    for reserved in ("name", "source"):
        if reserved in data:
            raise InputError("unknown key; a car is named by its file", key=reserved, source=path.name)
    _find_tyres(data, path)
    return validate(
        Vehicle, {**data, "name": path.stem, "source": path.name, "characteristics": chosen}, source=path.name
    )


def characteristic_sets(name: str | Path) -> dict[str, str]:
    """Names and titles of the sets of characteristics in a vehicle file; empty if it has one car only."""
    sets = read_toml(find_vehicle(name)).get("characteristics", {})
    if not isinstance(sets, dict) or not all(isinstance(each, dict) for each in sets.values()):
        raise InputError("must hold one table for each set", key="characteristics", source=str(name))
    return {key: str(value.get("title", key)) for key, value in sets.items()}


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


def set_by_path(data: dict[str, Any], path: str, value: Any, *, source: str) -> None:
    """Put `value` at a dotted path into nested tables, making tables on the way; a number addresses a list's item.

    Raises:
        InputError: the path runs through something that is not a table.
    """
    *parents, last = path.split(".")
    here: Any = data
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


def leaves(data: Mapping[str, Any], prefix: str = "") -> Iterator[str]:
    """Dotted paths of all values in nested tables."""
    for key, value in data.items():
        path = f"{prefix}.{key}" if prefix else key
        if isinstance(value, Mapping):
            yield from leaves(value, path)
        else:
            yield path


def find_vehicle(name: str | Path) -> Path:
    """Path of a shipped car or of the file given.

    Raises:
        InputError: neither exists.
    """
    text = str(name)
    if text.endswith(".toml"):
        path = Path(text)
        if not _is_file(path):
            raise InputError("no such file", source=text[:100])
        return path
    if text not in available_vehicles():
        raise InputError(
            f"no vehicle '{text}'; {choices(available_vehicles(), text)}, or give a .toml file", key="vehicle"
        )
    return FOLDER / f"{text}.toml"


def _find_tyres(data: dict[str, Any], path: Path) -> None:
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
                source=path.name,
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
