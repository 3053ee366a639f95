"""The video of cars that drive freely: where the wheels are, what is red at lift, which camera, side by side and as
ghosts."""

from __future__ import annotations

import subprocess
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from evaluation.animation import cameras, video
from evaluation.animation.cameras import CAMERAS
from evaluation.animation.clip import Clip, features_of
from evaluation.animation.handling.camera import Follow, camera_for, inside
from evaluation.animation.handling.hud import HandlingHud
from evaluation.animation.handling.pose import Motion
from evaluation.animation.handling.shapes import add_car, car_materials
from evaluation.animation.handling.world import proving_ground, surroundings
from evaluation.animation.kinds import HANDLING, kind_of
from evaluation.animation.picture import Picture, materials
from evaluation.animation.render import can_render, render_video
from evaluation.animation.scene import put
from evaluation.animation.shapes.saloon import Saloon, saloon
from evaluation.animation.style import Style
from evaluation.animation.titles import describe
from evaluation.animation.window import window_of
from evaluation.colours import COLOURS, rgb
from manoeuvres import Crosswind, LaneChange, SineSteer, SteadyCircle
from susp_mj import InputError, simulate
from susp_mj.features import Bump, Circle, Cones, Course, CrossSlope, Gust, Patch, as_json
from susp_mj.names import CORNERS, channel_name
from susp_mj.run import Run, described
from vehicles import load_vehicle
from vehicles.mjcf import build

from ...builders.runs import titled

SIZE, FPS = (320, 180), 10

WHEELBASE, TRACK, RADIUS, CG_X, CG_HEIGHT = 3.0, 1.5, 0.32, -1.45, 0.56
MASS, TYRE_RATE, STEP = 1900.0, 2.4e5, 0.005
FACTS = {
    "cg_x": CG_X,
    "cg_y": 0.0,
    "cg_height": CG_HEIGHT,
    "wheelbase": WHEELBASE,
    "track_front": TRACK,
    "track_rear": TRACK,
    "steering_ratio": 15.0,
    "wheel_radius_front": RADIUS,
    "wheel_radius_rear": RADIUS,
}


def curve(start, end, value):
    """Value that rises from 0 to `value` between two times."""
    return lambda time: value * np.clip((time - start) / (end - start), 0.0, 1.0)


TO_THE_LIMIT = curve(1.0, 5.0, 9.0)


def driven(
    lateral=TO_THE_LIMIT,
    *,
    speed=20.0,
    duration=6.0,
    soft=1.0,
    front=0.8,
    features=(),
    kind="ramp_steer",
    road=None,
    brake=None,
    wind=None,
):
    """A run of a car that corners as `lateral` says [m/s² over time], steadily at every instant: rolling `soft` times
    as much as usual.

    The front axle carries the share `front` of the load transfer; once its inner wheel is unloaded it lifts, and the
    rear axle takes the rest. `road` gives the road height under a place (x, y), `brake` the longitudinal acceleration
    over time.
    """
    time = np.arange(0.0, duration + STEP / 2, STEP)
    ay = lateral(time) if lateral else 0 * time
    ax = brake(time) if brake else 0 * time
    v = np.maximum(speed + np.cumsum(ax) * STEP, 0.0)
    rate = np.where(v > 0.5, ay / np.maximum(v, 0.5), 0.0)
    yaw = np.cumsum(rate) * STEP
    slip = -0.006 * ay
    x = CG_X + np.concatenate([[0], np.cumsum(v * np.cos(yaw + slip))[:-1]]) * STEP
    y = np.concatenate([[0], np.cumsum(v * np.sin(yaw + slip))[:-1]]) * STEP
    roll, pitch = np.radians(0.62) * soft * ay, -np.radians(0.35) * soft * ax
    values = {
        "position_x": x,
        "position_y": y,
        "yaw_angle": yaw,
        "yaw_rate": rate,
        "speed": v,
        "side_slip_angle": slip,
        "lateral_acceleration": ay,
        "longitudinal_acceleration": ax,
        "roll_angle": roll,
        "pitch_angle": pitch,
        "steering_wheel_angle": 15.0 * (WHEELBASE * rate / np.maximum(v, 1.0) + 0.004 * ay),
        "gear": np.full_like(time, 4.0),
    }
    channels = {name: described(name, value) for name, value in values.items()}
    share = {"f": -CG_X / WHEELBASE, "r": 1 + CG_X / WHEELBASE}
    share = {"f": share["r"], "r": share["f"]}
    transfer = MASS * CG_HEIGHT * ay / TRACK
    static = {end: 9.81 * MASS * part / 2 for end, part in share.items()}
    at_front = np.clip(front * transfer, -static["f"], static["f"])
    across = {"f": at_front, "r": np.clip(transfer - at_front, -static["r"], static["r"])}
    along = MASS * CG_HEIGHT * ax / WHEELBASE / 2
    heave, wheels = 0 * time, {}
    for station in CORNERS:
        left, ahead = (1 if station[1] == "l" else -1), station[0] == "f"
        wx, wy = (0.0 if ahead else -WHEELBASE) - CG_X, left * TRACK / 2
        load = np.maximum(static[station[0]] - left * across[station[0]] - (along if ahead else -along), 0.0)
        height = 0 * time
        if road:
            height = road(x + wx * np.cos(yaw) - wy * np.sin(yaw), y + wx * np.sin(yaw) + wy * np.cos(yaw))
        unloaded = np.maximum(left * (front * transfer if ahead else transfer * (1 - front)) - static[station[0]], 0.0)
        wheel = height - (load - static[station[0]]) / TYRE_RATE + unloaded / 2.4e4 * ahead
        wheels[station] = (wx, wy, load, height, wheel, left)
    if road:
        heave = np.mean([each[3] for each in wheels.values()], axis=0)
    channels["body_displacement"] = described("body_displacement", heave)
    channels["body_acceleration"] = described("body_acceleration", np.gradient(np.gradient(heave, STEP), STEP))
    if wind:
        channels["wind_y"] = described("wind_y", wind(x))
    for station, (wx, wy, load, height, wheel, left) in wheels.items():
        deflection = wheel - (heave + roll * wy - pitch * wx)
        steer = (WHEELBASE * rate / np.maximum(v, 1.0) + 0.004 * ay) if station[0] == "f" else 0.002 * ay
        more = {
            "wheel_load": load,
            "road_height": height,
            "wheel_displacement": wheel,
            "suspension_deflection": deflection,
            "steer_angle": steer + 0 * time,
            "inclination_angle": -0.35 * deflection - np.radians(0.8),
            "wheel_speed": v / (RADIUS - 0.004) + 0 * left,
        }
        channels |= {channel_name(station, name): described(name, value, station) for name, value in more.items()}
    meta = {
        "title": "synthetic",
        "model": "handling",
        "car": "handling",
        "manoeuvre": {"kind": kind, "speed": speed},
        "facts": FACTS,
        "road": {"features": as_json(features)},
        "step": STEP,
    }
    return Run(time, channels, meta)


# ---- where the wheels are --------------------------------------------------------------------------------------------


def rotation(axis, angle):
    c, s = np.cos(angle), np.sin(angle)
    return {
        "x": np.array([[1, 0, 0], [0, c, -s], [0, s, c]]),
        "y": np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
        "z": np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]),
    }[axis]


def moved(run, name, value):
    return Run(
        run.time,
        {**run.channels, name: described(name.removeprefix("fl_"), value, "fl" if name.startswith("fl_") else "")},
        run.meta,
    )


@pytest.mark.parametrize("time", [0.0, 1.7, 3.3, 5.9])
def test_wheel_centres_and_turns_follow_the_channels(time):
    brake = curve(2.0, 4.0, -3.0)
    run = driven(curve(1.0, 5.0, 6.0), brake=brake, soft=1.5)
    pose = Motion(run).pose(time)

    def now(name):
        return float(np.interp(time, run.time, run[name]))

    body = rotation("z", now("yaw_angle")) @ rotation("y", now("pitch_angle")) @ rotation("x", now("roll_angle"))
    cg = np.array([now("position_x"), now("position_y"), CG_HEIGHT + now("body_displacement")])
    for station in CORNERS:
        left, ahead = station[1] == "l", station[0] == "f"
        arm = np.array([(0 if ahead else -WHEELBASE) - CG_X, (TRACK if left else -TRACK) / 2, RADIUS - CG_HEIGHT])
        arm[2] += now(f"{station}_suspension_deflection")
        wheel = pose.wheels[station]
        assert wheel.centre == pytest.approx(cg + body @ arm)
        outwards = now(f"{station}_inclination_angle") * (-1 if left else 1)
        upright = body @ rotation("z", now(f"{station}_steer_angle")) @ rotation("x", outwards)
        spin = trapezoid(run[f"{station}_wheel_speed"], run.time, time)
        assert wheel.turned == pytest.approx(upright @ rotation("y", spin), abs=1e-6)
        assert wheel.load == pytest.approx(now(f"{station}_wheel_load"))


def trapezoid(values, times, until):
    grid = np.append(times[times < until], until)
    return float(np.trapezoid(np.interp(grid, times, values), grid))


def test_signs_of_steer_camber_and_spin():
    run = driven(None, duration=1.0)
    size = np.ones_like(run.time)
    steered = Motion(moved(run, "fl_steer_angle", 0.3 * size)).pose(0.5).wheels["fl"]
    assert steered.upright[:, 0] @ [0, 1, 0] == pytest.approx(np.sin(0.3), rel=1e-3), (
        "a wheel steered to the left points to the left"
    )
    leaning = Motion(moved(run, "fl_inclination_angle", 0.1 * size)).pose(0.5).wheels["fl"]
    assert leaning.upright[:, 2] @ [0, 1, 0] == pytest.approx(np.sin(0.1)), (
        "the top of the left wheel leans to the left"
    )
    early, late = (Motion(run).pose(time).wheels["fl"] for time in (0.0, 0.01))
    top_early, top_late = (wheel.turned @ early.turned.T @ [0, 0, 1.0] for wheel in (early, late))
    assert top_late[0] - top_early[0] == pytest.approx(np.sin(0.2 / (RADIUS - 0.004)), rel=1e-3), (
        "its top rolls forwards"
    )


def test_wheels_roll_on_the_road_and_the_lifted_one_is_off_it():
    run = driven()
    motion, radius = Motion(run), Motion(run).chassis.tyres
    for time in (0.5, 3.0, 4.0, 5.8):
        for station, wheel in motion.pose(time).wheels.items():
            # lowest point of a circle whose axis is tilted: its radius times the cosine of the tilt, below the centre
            low = wheel.centre[2] - radius[station] * np.sqrt(1 - wheel.upright[2, 1] ** 2)
            gap = low - wheel.road
            if wheel.load > 0:
                assert gap == pytest.approx(-wheel.load / TYRE_RATE, abs=0.006), "of second order in the angles"
            else:
                assert gap > 0.002
    assert motion.pose(5.8).wheels["fl"].load == 0


def test_real_car_stands_on_its_road_throughout_a_lane_change():
    run = simulate(build(load_vehicle("s_class", "configuration_4"), "handling"), LaneChange(duration=4.0))
    assert kind_of([Clip("real", run)]) is HANDLING and camera_for(run) is CAMERAS["chase"]
    motion = Motion(run)
    for time in (0.0, 1.0, 2.5, 3.5):
        for station, wheel in motion.pose(time).wheels.items():
            raised = np.interp(time, run.time, run[f"{station}_wheel_displacement"])
            assert wheel.centre[2] - motion.chassis.centres[station][2] == pytest.approx(raised, abs=0.004), (
                "second order in the angles"
            )
            assert wheel.centre[2] - motion.chassis.tyres[station] == pytest.approx(-wheel.load / 176000, abs=0.006)


def test_places_of_the_picture_are_those_of_the_pose():
    run = driven(duration=2.0)
    picture = Picture()
    surroundings(picture, SIZE, 0)
    materials(picture, COLOURS[0])
    car_materials(picture)
    proving_ground(picture, [Motion(run)])
    add_car(picture, Motion(run).chassis, COLOURS[0], "car0_", ghost=False, fine=False)
    model = picture.spec.compile()
    data = mujoco.MjData(model)
    pose = Motion(run).pose(1.8)
    put(model, data, pose.frames("car0_"))
    for station in CORNERS:
        assert data.body(f"car0_{station}_wheel").xpos == pytest.approx(pose.wheels[station].centre, abs=1e-6)
        tyre = vertices(model, data, f"car0_{station}_tyre")
        assert np.ptp(tyre @ pose.wheels[station].upright[:, 1]) == pytest.approx(0.22, abs=2e-3), (
            "its axis is the wheel's"
        )
    body = vertices(model, data, "car0_paint") @ pose.turned - pose.origin @ pose.turned
    assert 4.6 < np.ptp(body[:, 0]) < 5.4 and 1.9 < np.ptp(body[:, 1]) < 2.2 and 1.4 < body[:, 2].max() < 1.5


def vertices(model, data, geom):
    number = model.geom(geom).id
    mesh = model.mesh(model.geom_dataid[number])
    local = model.mesh_vert[mesh.vertadr[0] : mesh.vertadr[0] + mesh.vertnum[0]]
    return local @ data.geom_xmat[number].reshape(3, 3).T + data.geom_xpos[number]


@pytest.mark.parametrize(("wheelbase", "half_width"), [(2.3, 0.80), (3.0, 0.9), (3.4, 1.0)])
@pytest.mark.parametrize("fine", [(84, 38), (130, 56)])
def test_saloon_is_mirrored_whole_and_leaves_room_for_its_wheels(wheelbase, half_width, fine):
    shape = Saloon(wheelbase, half_width, 0.32, 0.39, fine)
    parts = saloon(shape)
    assert {"paint", "glass", "lamp", "tail", "grille", "chrome", "plate", "liner", "gap"} <= parts.keys()
    area = 0.0
    for surface in parts.values():
        assert surface.faces.min() >= 0 and surface.faces.max() < len(surface.vertices)
        assert np.linalg.norm(surface.normals, axis=1) == pytest.approx(1.0, abs=1e-6)
        assert surface.vertices[:, 1].max() == pytest.approx(-surface.vertices[:, 1].min(), abs=1e-9)
    for name in ("paint", "glass", "trim", "gloss", "grille"):
        corners = parts[name].vertices[parts[name].faces]
        area += np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
        for axle in (0.0, -wheelbase):
            x, y, z = parts[name].vertices.T
            inside = (np.hypot(x - axle, z - 0.32) < 0.37) & (np.abs(y) > 0.5 * half_width) & (z > 0.33)
            assert not inside.any(), f"{name} reaches into a wheel arch"
    assert 18 < area * (3.0 / wheelbase) * (0.9 / half_width) < 32, "about the skin of a car, cut but nothing lost [m²]"


# ---- what is chosen --------------------------------------------------------------------------------------------------

CONES = Cones(((20.0, 1.2), (20.0, -1.2), (32.0, 1.2), (32.0, -1.2)), 0.15)


@pytest.mark.parametrize(
    ("run", "camera", "inner"),
    [
        (driven(), "front", 1.0),
        (driven(curve(1, 2, -5.0), duration=3.0), "front", -1.0),
        (driven(curve(1, 2, 5.0), duration=3.0, features=[CONES]), "chase", 1.0),
        (driven(None, duration=3.0, features=[Gust((20.0, 50.0), 20.0)]), "chase", -1.0),
        (driven(None, duration=3.0, brake=curve(1, 1.2, -7.0)), "side", -1.0),
    ],
)
def test_camera_suits_the_manoeuvre(run, camera, inner):
    assert (camera_for(run), inside(run)) == (CAMERAS[camera], inner)


def test_diagrams_show_what_the_manoeuvre_is_about():
    def subject(run):
        clips = [Clip("one", run)]
        hud = HandlingHud(clips, window_of([run], FPS, None), (1280, 720), Style())
        return [chart.title for chart in hud.traces]

    assert subject(driven()) == ["Lateral acceleration in m/s² (left +)", "Smallest wheel load in kN", "Roll in °"]
    assert subject(driven(None, duration=3.0, brake=curve(1, 1.2, -7.0)))[0] == "Longitudinal acceleration in m/s²"
    assert subject(driven(None, speed=14.0, duration=3.0, road=bump_road, features=[BUMP]))[::2] == [
        "Body displacement in mm",
        "Pitch in °",
    ]
    rig = driven(None, speed=0.0, duration=1.0)
    rolled = moved(rig, "roll_angle", 0.05 * np.sin(rig.time))
    assert (
        subject(rolled)[::2] == ["Roll angle in ° (left side up +)", "Front left travel in mm"]
        and camera_for(rolled) is CAMERAS["front"]
    )


@pytest.mark.parametrize("name", CAMERAS)
@pytest.mark.parametrize("inner", [1.0, -1.0])
def test_camera_stands_where_it_says_and_follows(name, inner):
    run = driven(curve(1.0, 5.0, 6.0 * inner))
    model = mujoco.MjModel.from_xml_string("<mujoco><worldbody><geom size='.1'/></worldbody></mujoco>")
    follow = Follow(model, run, CAMERAS[name], inner, SIZE, 0.0)
    for time in (0.5, 3.0, 5.5):
        camera = follow.aim(time)
        looks = np.radians(camera.azimuth)
        eye = np.array(camera.lookat[:2]) - camera.distance * np.cos(np.radians(camera.elevation)) * np.array(
            [np.cos(looks), np.sin(looks)]
        )
        yaw = float(np.interp(time, run.time, run["yaw_angle"]))
        from_car = rotation("z", -yaw)[:2, :2] @ (eye - Motion(run).pose(time).place)
        bearing, reach = np.radians(CAMERAS[name].bearing), camera.distance * np.cos(np.radians(CAMERAS[name].drop))
        place = [CAMERAS[name].ahead + reach * np.cos(bearing), reach * np.sin(bearing) * inner]
        assert from_car == pytest.approx(place, abs=1.5), "bearings are from ahead, to the inside of the bend"
        if name == "chase":
            assert from_car[0] < -5
        if name in ("front", "side"):
            assert from_car[1] * inner > 2, "on the inside of the bend, where the wheel lifts"
            assert abs(from_car[0]) < 1.5 if name == "side" else from_car[0] > 5


def test_whole_drive_in_real_time_and_a_bump_in_slow_motion():
    drive = window_of([driven(duration=8.0)], 30, None)
    assert (drive.start, drive.end, drive.playback) == pytest.approx((0.0, 8.0, 1.0))
    long = window_of([driven(duration=70.0)], 30, None)
    assert long.playback == 4.0 and len(long.times) / 30 <= 20
    road = bump_road
    bump = window_of([driven(None, duration=4.0, speed=14.0, road=road, features=[BUMP])], 30, None)
    assert bump.playback < 1 and bump.start < 20 / 14 < bump.end < 4.0


BUMP = Bump((20.0, 22.0), 0.08)


def bump_road(x, y):
    return np.where((x > 20) & (x < 22), 0.04 * (1 - np.cos(np.pi * (x - 20))), 0.0)


def test_driver_circle_is_a_feature():
    run = driven(duration=1.0)
    circle = {**run.meta, "manoeuvre": {"kind": "steady_circle", "radius": -40.0}}
    followed = {**run.channels, "path_deviation": described("path_deviation", 0 * run.time)}
    assert features_of(Run(run.time, followed, circle)) == (Circle(-40.0),)
    assert features_of(run) == ()


@pytest.mark.parametrize(
    ("manoeuvre", "text"),
    [
        (
            SineSteer(amplitude="60 deg", frequency=0.5, speed=20.0),
            "Sine steer  ·  amplitude 60°  ·  0.5 Hz  ·  at 72 km/h",
        ),
        (SteadyCircle(radius=100.0, speed=10.0), "Steady circle  ·  radius 100 m  ·  at 36 km/h"),
        (
            Crosswind(wind=20.0, length=30.0, speed=27.78),
            "Crosswind  ·  30 m long  ·  wind 20 m/s  ·  at 100 km/h",
        ),
    ],
)
def test_header_says_how_it_is_driven(manoeuvre, text):
    assert describe(titled(manoeuvre)) == text


# ---- the road --------------------------------------------------------------------------------------------------------


def ground_of(run):
    picture = Picture()
    surroundings(picture, SIZE, 0)
    materials(picture, COLOURS[0])
    proving_ground(picture, [Motion(run)])
    model = picture.spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def test_features_lie_where_the_manoeuvre_says():
    features = [
        CONES,
        Patch((30.0, 60.0), (0.0, 3.0), 0.3),
        Gust((70.0, 95.0), -15.0),
        Course((0.0, 40.0, 80.0), (0.0, 2.0, 0.0)),
    ]
    model, data = ground_of(driven(None, duration=5.0, features=features))
    cones = [k for k in range(model.ngeom) if model.geom_dataid[k] == model.mesh("feature0_cone").id]
    assert sorted(map(tuple, np.round(data.geom_xpos[cones][:, :2], 3).tolist())) == sorted(map(tuple, CONES.points))
    patch = vertices(model, data, "feature1")
    assert patch.min(axis=0)[:2] == pytest.approx([30, 0], abs=1e-6) and patch.max(axis=0)[:2] == pytest.approx(
        [60, 3], abs=1e-6
    )
    gust = vertices(model, data, "feature2")
    assert (gust[:, 0].min(), gust[:, 0].max()) == pytest.approx((70, 95))
    path = vertices(model, data, "path")
    assert path[np.argmin(np.abs(path[:, 0] - 40)), 1] == pytest.approx(2.0, abs=0.15)


def test_circle_passes_under_the_car():
    model, data = ground_of(driven(lambda t: 0 * t + 8.0, duration=5.0, features=[Circle(50.0)]))
    middle = vertices(model, data, "middle")
    assert np.hypot(middle[:, 0], middle[:, 1] - 50.0) == pytest.approx(50.0, abs=0.06)


def test_bump_is_as_high_as_the_road_under_the_wheels():
    run = driven(None, speed=14.0, duration=3.0, road=bump_road, features=[BUMP])
    model, data = ground_of(run)
    for side in ("fl", "fr"):
        track = vertices(model, data, f"track0_{side}")
        top = track[track[:, 2] > -0.01]
        near = top[np.argsort(top[:, 0])]
        for x in (18.0, 20.5, 21.0, 21.7, 24.0):
            assert np.interp(x, near[:, 0], near[:, 2]) == pytest.approx(float(bump_road(x, 0.0)), abs=0.004)


def test_sloping_road_passes_under_the_wheels():
    slope = 0.03
    run = driven(None, duration=3.0, road=lambda x, y: slope * y, features=[CrossSlope((0.0, 1.0), slope)])
    model, data = ground_of(run)
    base = data.body("ground").xmat.reshape(3, 3)
    for station, wheel in Motion(run).pose(1.0).wheels.items():
        assert wheel.road == pytest.approx(wheel.centre[1] * base[2, 1] / base[1, 1], abs=1e-6), station
    assert "track0_fl" not in [model.mesh(k).name for k in range(model.nmesh)]


# ---- frames ----------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def pictures():
    """Frames of a video, decoded again, by what was asked for."""
    missing = can_render()
    if missing:
        pytest.fail(missing)
    return {}


def frames_of(clips, folder, **options):
    path = render_video(clips, folder / "drive.mp4", size=SIZE, fps=FPS, **{"quality": "draft", **options})
    raw = subprocess.run(
        [video.ffmpeg_program() or "ffmpeg", "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
        capture_output=True,
        check=True,
    ).stdout
    return np.frombuffer(raw, np.uint8).reshape(-1, SIZE[1], SIZE[0], 3)


@pytest.fixture(scope="module")
def side_by_side(pictures, tmp_path_factory):
    clips = [Clip("stiff at front", driven()), Clip("even", driven(front=0.5, soft=1.5))]
    return clips, frames_of(clips, tmp_path_factory.mktemp("drive"))


def red(frame):
    """Pixels of the colour of a wheel that has left the road."""
    values = frame.astype(int)
    return int(((values[..., 0] > 170) & (values[..., 1] < 90) & (values[..., 2] < 100)).sum())


def halves(frame):
    scene = frame[14:130]
    return scene[:, : SIZE[0] // 2 - 1], scene[:, SIZE[0] // 2 + 1 :]


def test_red_at_the_lifted_wheel_when_it_lifts_and_only_there(side_by_side):
    clips, frames = side_by_side
    run = clips[0].run
    times = window_of([clip.run for clip in clips], FPS, None).times
    assert len(frames) == len(times)
    first = float(run.time[np.argmax(run["fl_wheel_load"] <= 0)])
    assert 4.0 < first < 5.0 and clips[1].run["fl_wheel_load"].min() > 0
    for time, frame in zip(times, frames, strict=True):
        left, right = halves(frame)
        assert red(right) < 25
        # the alarm at the foot of the scene, and above it the tyre, its mark and its load column
        foot, above = red(left[98:]), red(left[45:98])
        if time >= first:
            assert foot > 60 and above > 60, time
        elif time < first - 0.1:
            assert foot < 10 and above < 25, time


def test_both_scenes_move_and_wear_their_colours(side_by_side):
    frames = side_by_side[1].astype(float)
    for number in range(2):
        scene = np.array([halves(frame)[number] for frame in frames])
        assert np.abs(np.diff(scene, axis=0)).mean(axis=(1, 2, 3)).min() > 1.0
        pixels = scene[3].reshape(-1, 3)
        paint = np.array(rgb(COLOURS[number]), float)
        alike = pixels @ paint / np.maximum(np.linalg.norm(pixels, axis=1), 1) / np.linalg.norm(paint) > 0.975
        other = np.array(rgb(COLOURS[1 - number]), float)
        wrong = pixels @ other / np.maximum(np.linalg.norm(pixels, axis=1), 1) / np.linalg.norm(other) > 0.99
        assert alike.mean() > 0.06 and wrong.mean() < 0.02


def test_ghost_stands_where_its_own_run_is(pictures, tmp_path):
    one, other = driven(curve(0.5, 2.0, 3.0), duration=3.0), driven(curve(0.5, 2.0, 2.0), duration=3.0)
    alone = frames_of([Clip("one", one)], tmp_path, camera="chase")
    ghost = frames_of([Clip("one", one), Clip("other", other)], tmp_path, camera="chase", layout="ghost")

    def orange(frame):
        scene = frame[60:128].astype(int)
        return (scene[..., 0] > scene[..., 2] + 45) & (scene[..., 0] > 90)

    assert len(alone) == len(ghost)
    before, apart = orange(alone[-1]), orange(ghost[-1])
    assert apart.sum() > before.sum() + 300
    assert np.argwhere(apart)[:, 1].mean() > np.argwhere(before)[:, 1].mean() + 10, (
        "the car that turns in less is further right"
    )


def test_same_runs_same_file(pictures, tmp_path):
    clips = [Clip("one", driven(duration=0.5)), Clip("two", driven(duration=0.5, soft=1.5))]
    one, other = (
        render_video(clips, tmp_path / name, size=(320, 180), fps=4, layout=layout, quality="fine").read_bytes()
        for name, layout in (("1.mp4", "ghost"), ("2.mp4", "ghost"))
    )
    assert one == other


def test_a_camera_of_ones_own_is_known_where_the_film_is_drawn(pictures, tmp_path, monkeypatch):
    clips = [Clip("one", driven(duration=0.5))]
    monkeypatch.setitem(CAMERAS, "drone", CAMERAS["chase"])
    one, other = (
        render_video(clips, tmp_path / f"{name}.mp4", size=(320, 180), fps=4, camera=name).read_bytes()
        for name in ("drone", "chase")
    )
    assert one == other


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"bearing": "left"}, "camera: bearing: 'left' is not allowed; it must be a finite number"),
        ({"drop": float("nan")}, "camera: drop: nan is not allowed; it must be a finite number"),
        ({"wide": 0.0}, "camera: wide: 0 m is not allowed; it must be greater than 0"),
    ],
)
def test_a_camera_that_cannot_be(change, line):
    with pytest.raises(InputError) as caught:
        replace(CAMERAS["chase"], **change)
    assert str(caught.value) == line


def test_a_camera_has_one_name():
    cameras.register("chase", CAMERAS["chase"])
    with pytest.raises(InputError, match="camera 'chase' is taken"):
        cameras.register("chase", CAMERAS["side"])


def test_car_that_stands_on_a_rig_is_shown_on_plates(pictures, tmp_path):
    run = driven(None, speed=0.0, duration=0.6, road=lambda x, y: 0.02 + 0 * x)
    assert len(frames_of([Clip("rig", run)], tmp_path, camera="side")) == 7


# ---- what is not allowed ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"camera": "chasse"}, r"video: camera: 'chasse' unknown; did you mean 'chase'\? choose chase, front, side"),
        ({"layout": "ghosts"}, r"video: layout: 'ghosts' unknown; did you mean 'ghost'\?"),
        ({"quality": "best"}, r"video: quality: 'best' unknown; choose draft, fine"),
        ({"layout": "ghost"}, "'ghost' shows up to 2 configurations, not 3"),
    ],
)
def test_unknown_choices_are_one_clear_line(tmp_path, options, text):
    clips = [Clip(name, driven(duration=0.2)) for name in "abc"]
    with pytest.raises(InputError, match=text):
        render_video(clips, tmp_path / "drive.mp4", **options)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("options", "text"),
    [({"camera": "side"}, "camera: 'side' is for runs of model handling"), ({"layout": "ghost"}, "side by side")],
)
def test_other_cars_have_one_camera_and_no_ghosts(tmp_path, options, text):
    time = np.arange(0, 1, 0.01)
    names = ("body_displacement", "body_acceleration", "suspension_deflection", "wheel_load", "road_height")
    quarter = Run(time, {name: described(name, np.sin(time)) for name in names}, {"model": "quarter_1dof"})
    with pytest.raises(InputError, match=text):
        render_video([Clip("quarter", quarter)], tmp_path / "drive.mp4", **options)
    with pytest.raises(InputError, match="'quarter' has one wheel and 'free' drives freely; show them in two videos"):
        render_video([Clip("quarter", quarter), Clip("free", driven(duration=0.2))], tmp_path / "drive.mp4")


def test_missing_channel_and_missing_fact_are_named(tmp_path):
    run = driven(duration=0.2)
    poor = Run(run.time, {name: channel for name, channel in run.channels.items() if name != "yaw_angle"}, run.meta)
    with pytest.raises(InputError, match="'poor': handling has no channel yaw_angle"):
        render_video([Clip("poor", poor)], tmp_path / "drive.mp4")
    unknown = Run(
        run.time,
        run.channels,
        {**run.meta, "facts": {key: value for key, value in FACTS.items() if key != "wheelbase"}},
    )
    with pytest.raises(InputError, match="'bare': the run does not say its wheelbase"):
        render_video([Clip("bare", unknown)], tmp_path / "drive.mp4")
    assert list(tmp_path.iterdir()) == []
