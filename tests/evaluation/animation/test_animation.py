"""The video shows what the runs say: geometry, contact, length, and a file that is there complete or not at all."""

from __future__ import annotations

import re
import subprocess

import mujoco
import numpy as np
import pytest

from evaluation.animation import kinds, render, video
from evaluation.animation.clip import Clip, tyre_deflection
from evaluation.animation.oscillation.hud import liveliest_angle
from evaluation.animation.oscillation.pose import WHEEL_RADIUS as CAR_WHEEL_RADIUS
from evaluation.animation.oscillation.pose import Layout, OscillationPose, road_speed
from evaluation.animation.oscillation.scene import place as place_car
from evaluation.animation.oscillation.shapes import oscillation_spec
from evaluation.animation.quarter.scene import place, pose_at, stretch_coil
from evaluation.animation.quarter.shapes import COIL_LENGTH, WHEEL_RADIUS, quarter_spec
from evaluation.animation.render import can_render, render_video
from evaluation.animation.titles import describe
from evaluation.animation.wheels_hud import plan
from evaluation.animation.window import LONGEST_CLIP, window_of
from evaluation.colours import COLOURS, rgb
from manoeuvres import Bump, LateralForce, RandomRoad, RoadStep, UnevenRoad, VerticalSweep
from susp_mj import InputError, SuspMjError, simulate
from susp_mj.names import channel_name
from susp_mj.run import Run, described
from vehicles import load_vehicle
from vehicles.mjcf import OSCILLATION, build

from ...builders.runs import titled

SIZE, FPS = (320, 180), 10


def run_of(characteristics, model="quarter_1dof", manoeuvre=None):
    return simulate(build(load_vehicle("chapter3", characteristics), model), manoeuvre or Bump(duration=1.6))


@pytest.fixture(scope="module")
def clips():
    return [Clip(name, run_of(name)) for name in ("linear", "nonlinear")]


@pytest.fixture
def drawing():
    missing = can_render()
    if missing:
        pytest.fail(missing)


@pytest.fixture(scope="module")
def film(clips, tmp_path_factory):
    """The file, its fractions done, and its frames decoded again: (frames, height, width, 3)."""
    missing = can_render()
    if missing:
        pytest.fail(missing)
    done = []
    path = render_video(
        clips, tmp_path_factory.mktemp("film") / "deep" / "bump.mp4", size=SIZE, fps=FPS, progress=done.append
    )
    return path, done, decoded(path)


def decoded(path):
    raw = ffmpeg("-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-").stdout
    return np.frombuffer(raw, np.uint8).reshape(-1, SIZE[1], SIZE[0], 3)


def alarm(frame, side):
    """Red pixels at the foot of the left (0) or right (1) scene."""
    panel = frame[112:130, side * 160 : side * 160 + 140].astype(int)
    return int(((panel[..., 0] > 170) & (panel[..., 1] < 90) & (panel[..., 2] < 90)).sum())


def ffmpeg(*arguments):
    return subprocess.run([video.ffmpeg_program() or "ffmpeg", *arguments], capture_output=True, check=False)


def test_file_is_h264_that_every_player_shows(film):
    path, _, _ = film
    assert re.search(rb"Video: h264.*yuv420p\(tv, bt709.*320x180.*10 fps", ffmpeg("-i", str(path)).stderr)
    assert path.read_bytes().index(b"moov") < path.read_bytes().index(b"mdat"), "faststart puts the index first"
    assert [each.name for each in path.parent.iterdir()] == ["bump.mp4"]


def test_frame_count_and_progress_follow_the_window(film, clips):
    _, done, frames = film
    window = window_of([clip.run for clip in clips], FPS, None)
    assert (window.start, window.end, window.playback) == pytest.approx((0.1, 1.5, 0.2))
    assert len(frames) == len(window.times) == 71
    assert len(done) == 71 and done[-1] == 1.0 and done == sorted(done)


def test_frames_change_in_both_scenes(film):
    frames = film[2].astype(float)
    for left in (0, SIZE[0] // 2):
        scene = frames[:, 15:128, left : left + 140]
        assert np.abs(np.diff(scene[5:20], axis=0)).mean(axis=(1, 2, 3)).min() > 1.0


def test_no_contact_is_red_at_the_right_instant_and_side(film, clips):
    times = window_of([clip.run for clip in clips], FPS, None).times
    lifted = [k for k in range(len(times)) if alarm(film[2][k], 0) > 60]
    assert times[lifted] == pytest.approx([0.30, 0.32, 0.34]), (
        "contact is lost from 0.299 s to 0.336 s; a frame shows what happened since the last"
    )
    assert all(alarm(frame, 1) == 0 for frame in film[2])


def test_each_configuration_has_its_colour(film):
    for number in range(2):
        scene = film[2][0][25:110, number * 160 : number * 160 + 140].reshape(-1, 3).astype(float)
        paint = np.array(rgb(COLOURS[number]), float)
        alike = scene @ paint / np.linalg.norm(scene, axis=1) / np.linalg.norm(paint) > 0.99
        assert alike.mean() > 0.1


@pytest.mark.parametrize("model", ["quarter_1dof", "quarter_2dof"])
def test_coil_is_as_long_as_the_suspension_says(model):
    run = run_of("nonlinear", model)
    window = window_of([run], FPS, None)
    drawn = quarter_spec(run, COLOURS[0], SIZE, window).compile()
    data, scene = mujoco.MjData(drawn), mujoco.MjvScene(drawn, maxgeom=400)
    coil = drawn.geom("coil").id
    mesh = drawn.mesh("coil")
    vertices = drawn.mesh_vert[mesh.vertadr[0] : mesh.vertadr[0] + mesh.vertnum[0]]
    for time in (0.0, 0.25, 0.3, 0.6):
        pose = pose_at(run, time)
        place(drawn, data, pose)
        mujoco.mjv_updateScene(
            drawn, data, mujoco.MjvOption(), None, mujoco.MjvCamera(), mujoco.mjtCatBit.mjCAT_ALL, scene
        )
        stretch_coil(drawn, data, scene, pose)
        geom = next(
            each
            for each in scene.geoms[: scene.ngeom]
            if each.objid == coil and each.objtype == mujoco.mjtObj.mjOBJ_GEOM
        )
        height = (vertices @ geom.mat.reshape(3, 3).T + geom.pos)[:, 2]
        expected = COIL_LENGTH - np.interp(time, run.time, run["suspension_deflection"])
        assert height.max() - height.min() == pytest.approx(expected, abs=1e-4)
        assert height.min() == pytest.approx(data.site("coil_foot").xpos[2], abs=1e-4)
    assert run["suspension_deflection"].max() > 0.05


def test_tyre_touches_the_road_exactly_while_it_carries():
    run = run_of("linear", "quarter_2dof")
    gap = run["wheel_displacement"] - run["road_height"] - tyre_deflection(run)
    assert 0.02 < tyre_deflection(run) < 0.04
    lifted = run["wheel_load"] <= 0
    assert lifted.any() and gap[lifted].min() > -1e-6 and gap[~lifted].max() < 1e-6


def test_wheel_rolls_without_slip_and_stands_still_on_the_rig():
    driving = pose_at(run_of("linear"), 0.5)
    assert driving.travelled == pytest.approx(0.5 * 50 / 3.6)
    assert driving.spin * WHEEL_RADIUS == pytest.approx(driving.travelled)
    standing = pose_at(run_of("linear", manoeuvre=RoadStep(duration=1.0)), 0.5)
    assert (standing.spin, standing.travelled, standing.slope) == (0, 0, 0)
    assert standing.road == standing.wheel == pytest.approx(0.03)


def test_long_excitation_shows_where_the_wheel_load_varies_most():
    run = run_of("linear", "quarter_2dof", VerticalSweep(duration=12.0))
    window = window_of([run], 30, None)
    peak = run.time[np.argmax(np.abs(run["wheel_load"] - run["wheel_load"][0]))]
    assert 0 <= window.start < peak < window.end <= run.time[-1] + 1e-9
    assert (window.end - window.start) / window.playback <= LONGEST_CLIP


def test_same_runs_same_file(drawing, clips, tmp_path, monkeypatch):
    monkeypatch.delenv("MUJOCO_GL", raising=False)
    one, other = (
        render_video(clips[:1], tmp_path / name, size=(160, 160), fps=3, playback=1.0).read_bytes()
        for name in ("1.mp4", "2.mp4")
    )
    assert one == other


def test_value_of_the_environment_that_does_not_work_is_passed_over(drawing, monkeypatch):
    monkeypatch.setenv("MUJOCO_GL", "nonsense")
    video.gl_backend.cache_clear()
    assert video.gl_backend() in ("egl", "osmesa")


def test_without_opengl_the_packages_are_named(clips, tmp_path, monkeypatch):
    monkeypatch.setattr(video, "_draws", lambda backend: False)
    video.gl_backend.cache_clear()
    try:
        assert "libegl1" in (can_render() or "") and "libosmesa6" in (can_render() or "")
        with pytest.raises(SuspMjError, match="install the Debian packages libegl1"):
            render_video(clips, tmp_path / "bump.mp4")
    finally:
        video.gl_backend.cache_clear()
    assert list(tmp_path.iterdir()) == []


def test_without_ffmpeg_the_package_is_named(drawing, monkeypatch):
    monkeypatch.setattr(render, "ffmpeg_program", lambda: None)
    assert "install the Debian package ffmpeg" in (can_render() or "")


def test_place_that_cannot_be_written(clips, tmp_path):
    (tmp_path / "file").write_text("kept")
    with pytest.raises(InputError, match=r"file/bump\.mp4: cannot be written"):
        render_video(clips, tmp_path / "file" / "bump.mp4")
    with pytest.raises(InputError, match=r"must end in \.mp4"):
        render_video(clips, tmp_path / "bump.avi")
    assert [each.name for each in tmp_path.iterdir()] == ["file"]


def test_failure_while_drawing_leaves_nothing_and_says_why(drawing, clips, tmp_path, monkeypatch):
    monkeypatch.setattr(
        render, "gl_environment", lambda backend: {**video.gl_environment(backend), "MUJOCO_GL": "nonsense"}
    )
    with pytest.raises(SuspMjError, match=r"could not be rendered: .*nonsense"):
        render_video(clips, tmp_path / "bump.mp4")
    assert list(tmp_path.iterdir()) == []


def test_ffmpeg_that_fails_is_quoted(drawing, tmp_path):
    with (
        pytest.raises(SuspMjError, match=r"ffmpeg failed: .*No such file"),
        video.Encoder(tmp_path / "no" / "a.mp4", (160, 160), 10) as encoder,
    ):
        for _ in range(100):
            encoder.write(bytes(160 * 160 * 3))


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"size": (321, 180)}, "must be even"),
        ({"fps": 0}, "frames per second"),
        ({"playback": 0.0}, "real time"),
        ({"playback": float("nan")}, "real time"),
    ],
)
def test_values_that_are_not_allowed(clips, tmp_path, values, text):
    with pytest.raises(InputError, match=text):
        render_video(clips, tmp_path / "bump.mp4", **values)
    with pytest.raises(InputError, match="from 1 to 8"):
        render_video([], tmp_path / "bump.mp4")


# ---- cars with several wheels ----------------------------------------------------------------------------------------

PLACES = {
    "full": {"fl": (0.0, 0.7), "fr": (0.0, -0.7), "rl": (-3.0, 0.65), "rr": (-3.0, -0.65)},
    "axle": {"rl": (0.0, 0.7), "rr": (0.0, -0.7)},
    "pitch": {"front": (0.0, 0.0), "rear": (-3.0, 0.0)},
}
TYRE_RATE, SPEED = 2e5, 20.0


def car_run(kind="full", *, sprung=True, speed=SPEED, lifted=(), phase=0.0):
    """A car that heaves, pitches and rolls over tracks that differ: what a simulation would leave behind, made up.

    `lifted`: the right rear wheel is held off the road from the first to the second of these times [s].
    """
    time = np.arange(0.0, 1.6, 0.002)
    places = PLACES[kind]
    cg_x = 0.0 if kind == "axle" else -1.4
    heave, pitch, roll = (
        a * np.sin(w * time + phase)
        for a, w in ((0.03, 8.0), (0.02 * (kind != "axle"), 6.0), (0.04 * (kind != "pitch"), 7.0))
    )
    channels = {
        "body_displacement": described("body_displacement", heave),
        "body_acceleration": described("body_acceleration", -64 * heave),
    }
    channels |= {"pitch_angle": described("pitch_angle", pitch)} if kind != "axle" else {}
    channels |= {"roll_angle": described("roll_angle", roll)} if kind != "pitch" else {}
    for station, (x, y) in places.items():
        distance = 10.0 * (time + (x / speed if speed else 0.0) - 0.3)
        road = np.where(
            (distance > 0) & (distance < 2 * np.pi), 0.02 * (1 + 0.8 * np.sign(y)) * (1 - np.cos(distance)), 0.0
        )
        off = (time >= lifted[0]) & (time < lifted[1]) if lifted and station == "rr" else np.zeros(len(time), bool)
        load = np.where(off, 0.0, 4000.0 + 1500 * np.sin(9 * time + x))
        wheel = road - (load - 4000.0) / TYRE_RATE + 0.03 * off if sprung else road
        values = {
            "wheel_load": load,
            "road_height": road,
            "suspension_deflection": wheel - (heave + roll * y - pitch * (x - cg_x)),
        }
        values |= {"wheel_displacement": wheel} if sprung else {}
        channels |= {
            channel_name(station, quantity): described(quantity, value, station) for quantity, value in values.items()
        }
    manoeuvre = {"kind": "bump", "speed": speed} if speed else {"kind": "lateral_force"}
    return Run(time, channels, {"model": kind, "manoeuvre": manoeuvre, "places": places, "facts": {"cg_x": cg_x}})


def drawn_car(run):
    layout = Layout.of(run)
    model = oscillation_spec(run, layout, COLOURS[0], SIZE, window_of([run], FPS, None)).compile()
    return layout, model, mujoco.MjData(model)


def drawn_vertices(model, data, geom, mesh=None):
    """(n, 3) vertices of a mesh where the picture shows them [m]."""
    mesh, geom = model.mesh(mesh or geom), model.geom(geom).id
    vertices = model.mesh_vert[mesh.vertadr[0] : mesh.vertadr[0] + mesh.vertnum[0]]
    return vertices @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]


@pytest.mark.parametrize("sprung", [False, True])
@pytest.mark.parametrize("kind", list(PLACES))
def test_wheels_and_spring_ends_of_every_corner_follow_the_channels(kind, sprung):
    run = car_run(kind, sprung=sprung)
    layout, model, data = drawn_car(run)
    for time in (0.0, 0.2, 0.5, 0.9):
        pose = OscillationPose.of(run, layout, time)
        place_car(model, data, pose)

        def now(quantity, time=time):
            return float(np.interp(time, run.time, run[quantity])) if quantity in run else 0.0

        for station, (x, y) in layout.places.items():
            wheel = now(channel_name(station, "wheel_displacement" if sprung else "road_height"))
            assert data.body(f"{station}_wheel").xpos == pytest.approx([x, y, CAR_WHEEL_RADIUS + wheel])
            foot, head = data.body(f"{station}_foot").xpos, data.body(f"{station}_head").xpos
            _, at_y, rest = layout.mount(station, layout.strut.head)
            lifted = now("body_displacement") + at_y * now("roll_angle") - (x - layout.cg[0]) * now("pitch_angle")
            assert head[2] - rest == pytest.approx(lifted, abs=2e-3), "of second order in the angles"
            coil = drawn_vertices(model, data, f"{station}_coil", "coil")
            along = (coil - foot) @ (head - foot) / np.linalg.norm(head - foot)
            assert along.min() == pytest.approx(layout.strut.seat, abs=1e-3), "the coil stands on its lower seat"
            assert along.max() == pytest.approx(np.linalg.norm(head - foot), abs=1e-3), "and reaches the upper one"
            shortened = layout.strut.coil - pose.coil_length(station)
            inboard = layout.strut.inset * (abs(now("roll_angle")) + abs(pose.camber))
            assert shortened == pytest.approx(now(channel_name(station, "suspension_deflection")), abs=2e-3 + inboard)


def test_positive_roll_lifts_the_left_side_and_positive_pitch_lowers_the_nose():
    layout, level = Layout.of(car_run()), dict.fromkeys(PLACES["full"], 0.0)
    rolled = OscillationPose(layout, 0.0, 0.0, 0.03, level, level, level, 0.0)
    assert rolled.strut_head("fl")[2] > rolled.strut_head("fr")[2] + 0.02
    pitched = OscillationPose(layout, 0.0, 0.03, 0.0, level, level, level, 0.0)
    assert pitched.strut_head("fl")[2] < pitched.strut_head("rl")[2] - 0.08


@pytest.mark.parametrize("kind", list(PLACES))
def test_every_wheel_stands_on_its_own_track(kind):
    run = car_run(kind)
    layout, model, data = drawn_car(run)
    for time in (0.1, 0.45, 0.62):
        place_car(model, data, OscillationPose.of(run, layout, time))
        for station, (x, y) in layout.places.items():
            half = drawn_vertices(model, data, f"{'left' if layout.side(station) > 0 else 'right'}_asphalt")
            upper = half[(half[:, 2] > -0.05) & (np.abs(half[:, 0] - x) < 0.2)]
            upper = upper[np.argsort(upper[:, 0])]
            assert half[:, 1].min() - 1e-9 <= y <= half[:, 1].max() + 1e-9
            height = float(np.interp(time, run.time, run[channel_name(station, "road_height")]))
            assert np.interp(x, upper[:, 0], upper[:, 2]) == pytest.approx(height, abs=1e-3)
            radius = CAR_WHEEL_RADIUS + tyre_deflection(run, station)
            bottom = data.body(f"{station}_wheel").xpos[2] - radius
            squeezed = float(np.interp(time, run.time, run[channel_name(station, "wheel_load")])) / TYRE_RATE
            assert height - bottom == pytest.approx(squeezed, abs=2e-4)


@pytest.mark.parametrize(
    "model", [model for model, topology in OSCILLATION.items() if topology.axles * topology.sides > 1]
)
def test_every_model_with_several_wheels_can_be_shown(model):
    run = simulate(build(load_vehicle("s_class", "configuration_4"), model), Bump(duration=0.6))
    assert kinds.kind_of([Clip(model, run)]) is kinds.OSCILLATION
    layout, drawn, data = drawn_car(run)
    assert road_speed(run, layout) == pytest.approx(50 / 3.6)
    for time in (0.0, 0.3, 0.5):
        pose = OscillationPose.of(run, layout, time)
        place_car(drawn, data, pose)
        for station in layout.places:
            deflection = np.interp(time, run.time, run[channel_name(station, "suspension_deflection")])
            assert layout.strut.coil - pose.coil_length(station) == pytest.approx(deflection, abs=3e-3)
            if tyre_deflection(run, station) > 0:
                bottom = data.body(f"{station}_wheel").xpos[2] - CAR_WHEEL_RADIUS - tyre_deflection(run, station)
                load = np.interp(time, run.time, run[channel_name(station, "wheel_load")])
                assert pose.roads[station] - bottom == pytest.approx(load / 176000, abs=2e-4)


def test_wheels_that_do_not_follow_one_road_stand_on_a_rig():
    run = car_run()
    swapped = {**run.channels, "rl_road_height": described("road_height", -run["rl_road_height"], "rl")}
    assert road_speed(run, Layout.of(run)) == SPEED
    assert road_speed(Run(run.time, swapped, run.meta), Layout.of(run)) == 0.0


@pytest.mark.parametrize(
    ("manoeuvre", "text"),
    [
        (Bump(), "Bump  ·  +80 mm  ·  2 m long  ·  at 50 km/h"),
        (UnevenRoad(), "Uneven road  ·  left +30 mm  ·  right −30 mm  ·  4 m long  ·  at 50 km/h"),
        (RandomRoad(), "Random road  ·  class C  ·  at 80 km/h"),
        (LateralForce(), "Lateral force  ·  +4 m/s²  ·  within 200 ms"),
    ],
)
def test_header_says_what_is_done(manoeuvre, text):
    assert describe(titled(manoeuvre)) == text


def test_what_a_run_does_not_say_is_taken_from_a_usual_car():
    run = car_run()
    layout = Layout.of(Run(run.time, run.channels, {}))
    assert layout.cg[0] == pytest.approx((layout.front + layout.rear) / 2) and layout.front > layout.rear
    assert [layout.side(station) for station in layout.places] == [1, -1, 1, -1]
    assert Layout.of(car_run("pitch")).one_sided and Layout.of(car_run("axle")).one_axle


def test_load_bars_lie_as_the_wheels_do():
    assert plan(["fl", "fr", "rl", "rr"]) == {"fl": (0, 0), "fr": (0, 1), "rl": (1, 0), "rr": (1, 1)}
    assert plan(["rl", "rr"]) == {"rl": (0, 0), "rr": (0, 1)}
    assert plan(["front", "rear"]) == {"front": (0, 0), "rear": (1, 0)}


def test_trace_shows_the_angle_that_moves_more():
    runs = {kind: Clip(kind, car_run(kind)) for kind in PLACES}
    whole = window_of([clip.run for clip in runs.values()], FPS, None)
    assert [liveliest_angle([clip], whole) for clip in runs.values()] == ["roll_angle", "roll_angle", "pitch_angle"]
    still = car_run("axle")
    still = Run(still.time, {**still.channels, "roll_angle": described("roll_angle", 0 * still.time)}, still.meta)
    assert liveliest_angle([Clip("still", still)], whole) is None


@pytest.mark.parametrize("speed", [SPEED, 0.0])
def test_video_of_cars_shows_which_wheel_lifts_and_when(drawing, tmp_path, speed):
    clips = [Clip("lifts", car_run(speed=speed, lifted=(0.5, 0.7))), Clip("holds", car_run(speed=speed, phase=1.0))]
    path = render_video(clips, tmp_path / "car.mp4", size=SIZE, fps=FPS, playback=1.0)
    frames, times = decoded(path), window_of([clip.run for clip in clips], FPS, 1.0).times
    assert len(frames) == len(times)
    lifted = np.array([alarm(frame, 0) > 60 for frame in frames])
    expected = (times >= 0.5) & (times - 0.1 < 0.698)  # a frame shows what happened since the last
    assert (
        (lifted == expected).all()
        and lifted.any()
        and not lifted.all()
        and all(alarm(frame, 1) == 0 for frame in frames)
    )
    scene = frames.astype(float)[:, 15:128, :120]
    assert np.abs(np.diff(scene, axis=0)).mean(axis=(1, 2, 3)).min() > 0.3


def test_runs_that_cannot_be_shown_together_or_at_all(clips, tmp_path):
    with pytest.raises(InputError, match="'linear' has one wheel and 'car' has several wheels"):
        render_video([clips[0], Clip("car", car_run())], tmp_path / "mixed.mp4")
    run = car_run()
    poor = Run(
        run.time, {name: channel for name, channel in run.channels.items() if name != "rl_road_height"}, run.meta
    )
    with pytest.raises(InputError, match=r"'poor': .*full has no channel rl_road_height"):
        render_video([Clip("poor", poor)], tmp_path / "poor.mp4")
    assert list(tmp_path.iterdir()) == []
