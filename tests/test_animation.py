"""The video shows what the runs say: geometry, contact, length, and a file that is there complete or not at all."""

from __future__ import annotations

import re
import subprocess

import mujoco
import numpy as np
import pytest

from evaluation import video
from evaluation.animation import Clip, can_render, render, render_video
from evaluation.animation.clip import tyre_deflection
from evaluation.animation.quarter_scene import place, pose_at, stretch_coil
from evaluation.animation.quarter_shapes import COIL_LENGTH, WHEEL_RADIUS, quarter_spec
from evaluation.animation.window import LONGEST_CLIP, window_of
from evaluation.colours import COLOURS, rgb
from manoeuvres import Bump, RoadStep, VerticalSweep
from susp_mj import InputError, SuspMjError, simulate
from vehicles import load_vehicle
from vehicles.mjcf import build

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
        pytest.skip(missing)


@pytest.fixture(scope="module")
def film(clips, tmp_path_factory):
    """The file, its fractions done, and its frames decoded again: (frames, height, width, 3)."""
    missing = can_render()
    if missing:
        pytest.skip(missing)
    done = []
    path = render_video(clips, tmp_path_factory.mktemp("film") / "deep" / "bump.mp4", size=SIZE, fps=FPS, progress=done.append)
    return path, done, decoded(path)


def decoded(path):
    raw = ffmpeg("-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-").stdout
    return np.frombuffer(raw, np.uint8).reshape(-1, SIZE[1], SIZE[0], 3)


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
    def alarm(frame, side):
        panel = frame[112:130, side * 160 : side * 160 + 140].astype(int)
        return int(((panel[..., 0] > 170) & (panel[..., 1] < 90) & (panel[..., 2] < 90)).sum())

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
        mujoco.mjv_updateScene(drawn, data, mujoco.MjvOption(), None, mujoco.MjvCamera(), mujoco.mjtCatBit.mjCAT_ALL, scene)
        stretch_coil(drawn, data, scene, pose)
        geom = next(each for each in scene.geoms[: scene.ngeom] if each.objid == coil and each.objtype == mujoco.mjtObj.mjOBJ_GEOM)
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
        render_video(clips[:1], tmp_path / name, size=(160, 160), fps=3, playback=1.0).read_bytes() for name in ("1.mp4", "2.mp4")
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
    monkeypatch.setattr(render, "gl_environment", lambda backend: {**video.gl_environment(backend), "MUJOCO_GL": "nonsense"})
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
