"""A car with several wheels: where its parts are in the design position, and where a run puts them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from susp_mj.names import channel_name
from susp_mj.run import Run

from ..clip import at, slope_at, speed_of, stations_of, wheel_height
from ..rotations import about_x, about_y

WHEEL_RADIUS = 0.33
"""Height of the wheel centres above the road in the design position [m]."""
CG_HEIGHT = 0.55
"""Height of the point about which the drawn body turns [m]."""
ONE_SIDE = 0.70
"""How far a one-sided car's plane of symmetry is drawn beside its wheels [m]."""
_SAME_ROAD = 2e-3
_USUAL = {
    "fl": (0.0, 0.7),
    "fr": (0.0, -0.7),
    "rl": (-2.9, 0.7),
    "rr": (-2.9, -0.7),
    "front": (0.0, 0.0),
    "rear": (-2.9, 0.0),
}


@dataclass(frozen=True)
class Strut:
    """Mounts of a spring strut, relative to the road under the design position.

    Attributes:
        inset: how far it stands inside the wheel centre [m].
        foot, head: heights of the mount on the wheel and of the mount on the body [m].
        seat: height of the lower spring seat above the foot [m].
    """

    inset: float
    foot: float
    head: float
    seat: float

    @property
    def coil(self) -> float:
        """Length of the drawn coil in the design position [m]."""
        return self.head - self.foot - self.seat


INDEPENDENT = Strut(inset=0.205, foot=0.30, head=0.93, seat=0.31)
ON_BEAM = Strut(inset=0.24, foot=0.385, head=0.665, seat=0.02)


@dataclass(frozen=True)
class Layout:
    """Where the wheels are, and what kind of car they make.

    Attributes:
        places: (x, y) of the wheels from the front axle [m], by station.
        cg: (x, y) of the centre of gravity [m].
    """

    places: Mapping[str, tuple[float, float]]
    cg: tuple[float, float]

    @classmethod
    def of(cls, run: Run) -> Layout:
        """From what the run says of itself; what it leaves open is taken from a usual car."""
        given, facts = run.meta.get("places", {}), run.meta.get("facts", {})
        stations = stations_of(run)
        places = {station: _pair(given.get(station) or _USUAL.get(station, (0.0, 0.0))) for station in stations}
        middle = np.mean(list(places.values()), axis=0)
        return cls(places, (float(facts.get("cg_x", middle[0])), float(facts.get("cg_y", middle[1]))))

    @cached_property
    def front(self) -> float:
        """Foremost axle [m]."""
        return max(x for x, _ in self.places.values())

    @cached_property
    def rear(self) -> float:
        """Rearmost axle [m]."""
        return min(x for x, _ in self.places.values())

    @cached_property
    def one_sided(self) -> bool:
        """Whether only one side of the car is there; it is drawn as the right one."""
        return len({y for _, y in self.places.values()}) == 1

    @cached_property
    def one_axle(self) -> bool:
        """Whether the model is one rigid axle with the body above it."""
        return not self.one_sided and self.front - self.rear < 0.5

    @cached_property
    def strut(self) -> Strut:
        """Mounts of its struts."""
        return ON_BEAM if self.one_axle else INDEPENDENT

    @cached_property
    def middle(self) -> float:
        """The car's plane of symmetry in y [m]."""
        ys = [y for _, y in self.places.values()]
        return ys[0] + ONE_SIDE if self.one_sided else (max(ys) + min(ys)) / 2

    @cached_property
    def half_track(self) -> float:
        """Largest distance of a wheel from the plane of symmetry [m]."""
        return max(abs(y - self.middle) for _, y in self.places.values())

    def side(self, station: str) -> float:
        """1 for wheels of the left side, -1 for the right side."""
        return 1.0 if self.places[station][1] > self.middle else -1.0

    def leader(self, side: float) -> str:
        """Foremost wheel of a side."""
        return max(
            (station for station in self.places if self.side(station) == side),
            key=lambda station: self.places[station][0],
        )

    def mount(self, station: str, height: float) -> np.ndarray:
        """Point on the axis of a strut in the design position [m]."""
        x, y = self.places[station]
        return np.array([x, y - self.side(station) * self.strut.inset, height])


def road_speed(run: Run, layout: Layout) -> float:
    """Speed at which one road per track passes under all wheels [m/s]; 0 if their heights are not those of one road, as
    on a rig."""
    speed = speed_of(run)
    if speed <= 0:
        return 0.0
    for station, (x, _) in layout.places.items():
        leader = layout.leader(layout.side(station))
        delay = (layout.places[leader][0] - x) / speed
        known = run.time >= run.time[0] + delay
        expected = np.interp(run.time[known] - delay, run.time, run[channel_name(leader, "road_height")])
        if np.any(np.abs(expected - run[channel_name(station, "road_height")][known]) > _SAME_ROAD):
            return 0.0
    return speed


@dataclass(frozen=True)
class OscillationPose:
    """Where a run puts the car at one time.

    Attributes:
        layout: the car.
        heave: of the centre of gravity above the design position [m].
        pitch: positive nose down [rad].
        roll: positive left side up [rad].
        wheels, roads: height of each wheel above its design position and of the road under it [m].
        slopes: of the road under each wheel, rising forwards positive.
        travelled: distance driven [m].
    """

    layout: Layout
    heave: float
    pitch: float
    roll: float
    wheels: Mapping[str, float]
    roads: Mapping[str, float]
    slopes: Mapping[str, float]
    travelled: float

    @classmethod
    def of(cls, run: Run, layout: Layout, time: float) -> OscillationPose:
        """The car of a run at a time [s]."""
        speed = road_speed(run, layout)
        return cls(
            layout,
            heave=at(run, "body_displacement", time),
            pitch=at(run, "pitch_angle", time, 0.0),
            roll=at(run, "roll_angle", time, 0.0),
            wheels={station: at(run, wheel_height(station, run), time) for station in layout.places},
            roads={station: at(run, channel_name(station, "road_height"), time) for station in layout.places},
            slopes={station: slope_at(run, station, time) if speed > 0 else 0.0 for station in layout.places},
            travelled=speed * time,
        )

    @cached_property
    def turned(self) -> np.ndarray:
        """(3, 3) rotation of the body."""
        return about_y(self.pitch) @ about_x(self.roll)

    def on_body(self, point: np.ndarray) -> np.ndarray:
        """Where a point of the body is that lies at `point` in the design position [m]."""
        centre = np.array([*self.layout.cg, CG_HEIGHT])
        return centre + [0.0, 0.0, self.heave] + self.turned @ (point - centre)

    @cached_property
    def camber(self) -> float:
        """Roll of a rigid axle [rad]; 0 for independent wheels."""
        if not self.layout.one_axle:
            return 0.0
        (left, right), ys = self.wheels.values(), [y for _, y in self.layout.places.values()]
        return float(np.arctan2(left - right, ys[0] - ys[1]))

    def wheel_centre(self, station: str) -> np.ndarray:
        """Centre of a wheel [m]."""
        return np.array([*self.layout.places[station], WHEEL_RADIUS + self.wheels[station]])

    def strut_foot(self, station: str) -> np.ndarray:
        """Mount of a strut on its wheel or axle [m]."""
        at_rest = np.array([*self.layout.places[station], WHEEL_RADIUS])
        return self.wheel_centre(station) + about_x(self.camber) @ (
            self.layout.mount(station, self.layout.strut.foot) - at_rest
        )

    def strut_head(self, station: str) -> np.ndarray:
        """Mount of a strut on the body [m]."""
        return self.on_body(self.layout.mount(station, self.layout.strut.head))

    def coil_length(self, station: str) -> float:
        """Length of the drawn coil [m]."""
        return float(np.linalg.norm(self.strut_head(station) - self.strut_foot(station))) - self.layout.strut.seat


def _pair(place: object) -> tuple[float, float]:
    x, y = np.asarray(place, dtype=float)[:2]
    return float(x), float(y)
