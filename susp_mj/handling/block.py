"""Memory of a car that drives freely: which numbers the compiled car reads, and which it writes, by name.

The numbers lie in one custom numeric of the MJCF file, `CAR_NUMERIC`: a head (`HEAD`), four wheels (`WHEEL` each), and
tables and parameters of laws behind them, which head and wheels address by their distance from the beginning.
What the car writes at every stage (`SIGNALS`) lies at the end of mjData's `userdata`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ..names import CORNERS

CAR_MARK = 20070614.0
"""First number of the block of a car that drives freely."""
CAR_NUMERIC = "susp_mj_car"
MOST_GEARS = 12


def _record(*names: str, **arrays: int) -> np.dtype[Any]:
    """Record of doubles by name, those of more than one number last."""
    return np.dtype([*((name, np.float64) for name in names), *((n, np.float64, (k,)) for n, k in arrays.items())])


HEAD = _record(
    *("mark", "length", "freedoms", "rig"),
    # actuators whose `ctrl` are the inputs; -1 where there is none
    *("steering_wheel", "driver", "speed_target", "speed_control", "engine", "brake", "wind_x", "wind_y"),
    *("heave_target", "roll_target", "pitch_target"),
    *("steering_ratio", "steering_limit", "wheelbase", "ground_z"),
    *("control_gain", "control_integral"),
    # laws of brakes and air with their parameters
    *("brake_law", "brake_parameters", "air_law", "air_parameters", "air_x"),
    *("engine_inertia", "idle_speed", "idle_gain", "idle_torque", "coupling", "converter", "coupling_limit"),
    *(
        "final_drive",
        "efficiency",
        "shift_up",
        "shift_down",
        "shift_time",
        "engine_limit",
        "full_torque",
        "drag_torque",
    ),
    # rig that holds the body
    *("design_x", "design_y", "design_z", "rig_stiffness", "rig_damping", "rig_rate_x", "rig_rate_y", "rig_rate_z"),
    *("rig_damping_x", "rig_damping_y", "rig_damping_z"),
    "gears",
    ratios=MOST_GEARS,
)
"""Numbers of the car as a whole; tables are given by their place in the block."""
WHEEL = _record(
    *("side", "front", "x", "y", "z", "travel_freedom", "steer_freedom", "spin_freedom", "tyre", "steering"),
    *("ackermann", "trail", "scrub", "drive_share", "tyre_law", "tyre_parameters", "radius", "stiffness", "damping"),
    *("design_height", "path", "angles", "swing", "elastic_lateral", "elastic_longitudinal", "elastic_aligning"),
    *("rig_longitudinal", "rig_lateral", "rig_aligning"),
)
"""Numbers of one wheel."""
CONTROLS = ("steering_wheel", "driver", "speed_target", "speed_control", "engine", "brake", "wind_x", "wind_y")
RIG_CONTROLS = ("heave_target", "roll_target", "pitch_target")
"""Numbers of the head that are actuators."""
CURVES = {
    "full_torque": 1,
    "drag_torque": 1,
    "path": 2,
    "swing": 1,
    "elastic_lateral": 2,
    "elastic_longitudinal": 1,
    "elastic_aligning": 1,
}
"""Numbers that are places of a `table`, and how many curves it has."""
PARAMETERS = {"tyre_parameters": "tyre_law", "brake_parameters": "brake_law", "air_parameters": "air_law"}
"""Numbers that are places of a law's parameters, and the number that says which law."""
OPTIONAL = ("swing", "elastic_lateral", "elastic_longitudinal", "elastic_aligning")
"""Tables that may be missing: place 0."""
CAR_SIGNALS = _record(
    *("gear", "shift_began", "trim_angle", "trimming", "driver_rate", "control_rate", "engine_rate"),
    *("steering_wheel_angle", "accelerator", "brake_pedal", "engine_speed", "engine_torque", "path_deviation"),
    *("control_force", "speed"),
)
"""What the car writes; `gear`, `shift_began` and `trim_angle` it also remembers from one step to the next. While
`trimming` is not 0 it does not shift, and its pedal knows no limits."""
WHEEL_SIGNALS = _record(
    *("longitudinal_force", "lateral_force", "overturning_moment", "rolling_moment", "aligning_moment"),
    *("relaxation_x", "relaxation_y", "rolling_radius", "wheel_load", "slip_ratio", "slip_angle", "camber_angle"),
    *("steer_angle", "inclination_angle", "wheel_speed", "drive_torque", "brake_torque", "road_height"),
    *("wheel_displacement", "contact_x", "contact_y", "friction"),
    # rates of the wheel's inner states, in their order
    *("slip_ratio_rate", "slip_rate", "brake_rate", "elastic_x_rate", "elastic_y_rate", "elastic_moment_rate"),
)
"""What each wheel writes; `slip_angle` as its tangent."""
WHEEL_STATE = _record("kappa", "tan_alpha", "bristle", "elastic_x", "elastic_y", "elastic_moment")
"""Inner states of a wheel: slips, brake, and F_x, F_y, M_z as the elastic suspension feels them, a little later."""
WHEEL_STATES = len(WHEEL_STATE.fields or ())


def names_of(record: np.dtype[Any]) -> tuple[str, ...]:
    """Names of a record's numbers, in order."""
    return record.names or ()


SIGNALS = (
    *names_of(CAR_SIGNALS),
    *(f"{corner}_{signal}" for corner in CORNERS for signal in names_of(WHEEL_SIGNALS)),
)
"""Names of everything the car writes, in order."""


class CarNumbers:
    """The numbers of a car by name, as views of a block.

    Attributes:
        block: (n,) all of them.
        head: the car as a whole: ``head.steering_ratio``.
        wheels: (4,) the wheels in the order of `CORNERS`: ``wheels.radius``, ``wheels[0].radius``.
    """

    def __init__(self, block: np.ndarray) -> None:
        first, size = HEAD.itemsize // 8, WHEEL.itemsize // 8
        self.block = block
        self.head: Any = block[:first].view(HEAD).view(np.recarray)[0]
        self.wheels: Any = block[first : first + 4 * size].view(WHEEL).view(np.recarray)

    @staticmethod
    def size() -> int:
        """Numbers of head and wheels."""
        return (HEAD.itemsize + 4 * WHEEL.itemsize) // 8

    @classmethod
    def of(cls, numbers: np.ndarray) -> CarNumbers | None:
        """Those of a model whose custom numerics these are; None if it is no car that drives freely."""
        return cls(numbers) if len(numbers) >= cls.size() and numbers[0] == CAR_MARK else None


def table(places: Sequence[float], *curves: Sequence[float] | np.ndarray, smooth: bool, count: int = 33) -> np.ndarray:
    """Curves over one quantity as the compiled car reads them: ``start, 1/spacing, n``, then of each even point, curve
    by curve, its value and ``slope * spacing``. Between the points they are cubic, outside they go straight on.

    Args:
        places: (n,) strictly increasing.
        curves: (n,) each.
        smooth: cubic splines through the given points, for mechanisms; else monotone cubics, for measured force curves,
            which must not overshoot.
        count: number of even points.
    """
    return tables(places, [curves], smooth=smooth, count=count)[0]


def tables(
    places: Sequence[float],
    sets: np.ndarray | Sequence[Sequence[Sequence[float] | np.ndarray]],
    *,
    smooth: bool,
    count: int = 33,
) -> list[np.ndarray]:
    """A `table` of each set of curves over one quantity, all carried by one spline.

    Args:
        places: (n,) as for `table`.
        sets: (m, k, n), k curves in each of m tables.
        smooth, count: as for `table`.
    """
    x, y = np.asarray(places, float), np.array(sets, float)
    even, spacing = np.linspace(x[0], x[-1], count, retstep=True)
    # three points are a dense system to scipy, which takes longer for several curves at once than one by one
    groups = y.reshape(-1, 1, 3) if len(x) == 3 else y.reshape(1, -1, len(x))
    splines = [_spline(x, group, smooth=smooth) for group in groups]
    values, slopes = (np.concatenate([spline(even, order) for spline in splines]) for order in (0, 1))
    numbers = np.stack([values, slopes * spacing], axis=2).reshape(*y.shape[:2], count, 2)
    rows = numbers.swapaxes(1, 2).reshape(len(y), -1)  # point by point, curve by curve
    return [np.concatenate([[even[0], 1 / spacing, count], row]) for row in rows]


def _spline(x: np.ndarray, curves: np.ndarray, *, smooth: bool) -> Callable[[np.ndarray, int], np.ndarray]:
    """Interpolant of (k, n) curves over (n,) places, and of its derivatives."""
    from scipy.interpolate import CubicSpline, PchipInterpolator

    if not smooth:
        return PchipInterpolator(x, curves, axis=1)
    return CubicSpline(x, curves, axis=1, bc_type="not-a-knot" if len(x) > 2 else "natural")


def table_of_tables(start: float, spacing: float, tables: Sequence[np.ndarray]) -> np.ndarray:
    """A `table` for each even value of a second quantity: ``start, 1/spacing, m, length of a table``, then the tables
    one after another."""
    return np.concatenate([[start, 1 / spacing, len(tables), len(tables[0])], *tables])


def signals_of(userdata: np.ndarray) -> np.ndarray:
    """What the compiled car writes, in the order of `SIGNALS`: a view of the end of mjData's `userdata`."""
    return userdata[-len(SIGNALS) :]


def car_signals_of(userdata: np.ndarray) -> Any:
    """The `CAR_SIGNALS` of what the compiled car writes, by name: ``signals.gear``."""
    return signals_of(userdata)[: CAR_SIGNALS.itemsize // 8].view(CAR_SIGNALS).view(np.recarray)[0]


def car_block(
    head: Mapping[str, float | Sequence[float]],
    wheels: Sequence[Mapping[str, float]],
    tables: Sequence[tuple[str, int, np.ndarray]],
) -> np.ndarray:
    """The block: head, wheels, tables.

    Args:
        head, wheels: values by name; names left out are 0, and so is what an array is too short for.
        tables: (name, wheel number or -1 for the head, numbers); each is put behind and its place entered under its
            name. Equal tables share one place.
    """
    car = CarNumbers(np.zeros(CarNumbers.size()))
    for record, values in ((car.head, head), *zip(car.wheels, wheels, strict=True)):
        for name, value in values.items():
            if np.ndim(value):
                record[name][: np.size(value)] = value
            else:
                record[name] = value
    behind: dict[bytes, int] = {}
    parts, length = [car.block], len(car.block)
    for name, wheel, numbers in tables:
        content = np.asarray(numbers, float).tobytes()
        if content not in behind:
            behind[content] = length
            parts.append(np.asarray(numbers, float))
            length += len(numbers)
        (car.head if wheel < 0 else car.wheels[wheel])[name] = behind[content]
    car.head.mark, car.head.length = CAR_MARK, length
    return np.concatenate(parts)
