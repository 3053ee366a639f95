"""Order a video: check what is asked for, draw it in a process with OpenGL, and put the finished file in its place."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path

from susp_mj.errors import InputError, SuspMjError
from susp_mj.files import whole

from ..colours import COLOURS
from .cameras import CAMERAS
from .clip import Clip
from .kinds import kind_of
from .style import Style
from .video import NO_FFMPEG, NO_GL, ffmpeg_program, gl_backend, gl_environment


def can_render() -> str | None:
    """None if videos can be made here, else one sentence that names what to install."""
    if gl_backend() is None:
        return NO_GL
    return None if ffmpeg_program() else NO_FFMPEG


def render_video(
    clips: Sequence[Clip],
    path: str | Path,
    *,
    size: tuple[int, int] = (1280, 720),
    fps: int = 30,
    playback: float | None = None,
    camera: str | None = Style.camera,
    layout: str = Style.layout,
    quality: str = Style.quality,
    progress: Callable[[float], None] | None = None,
) -> Path:
    """Draw the runs into an MP4 file; it appears complete or not at all. Same runs, same file.

    Args:
        clips: one to eight configurations; their order fixes their colours.
        path: the file, ``.mp4``.
        size: (width, height) [px], both even.
        fps: frames per second of the video.
        playback: seconds of the run per second of video; None chooses slow motion that suits the runs.
        camera: one of `CAMERAS`, for cars that drive freely; None chooses what suits the manoeuvre.
        layout: one of `LAYOUTS`; ``ghost`` is for cars that drive freely.
        quality: one of `QUALITIES`.
        progress: called with the fraction done.

    Raises:
        InputError: a value that is not allowed, or a place that cannot be written.
        SuspMjError: this machine cannot render, or rendering failed.
    """
    path, style = Path(path), Style(camera, layout, quality)
    _check(clips, path, size, fps, playback)
    style.check(clips)
    with whole(path) as unfinished:
        unfinished.write_bytes(b"")
        missing = can_render()
        if missing:
            raise SuspMjError(missing)
        with tempfile.TemporaryDirectory(prefix="susp_mj_") as folder:
            order = {
                "labels": [clip.label for clip in clips],
                "path": str(unfinished.resolve()),
                "size": size,
                "fps": fps,
                "playback": playback,
                "style": asdict(style),
                "cameras": {name: asdict(each) for name, each in CAMERAS.items()},
            }
            for number, clip in enumerate(clips):
                clip.run.save(Path(folder, f"{number}.nc"))
            Path(folder, "order.json").write_text(json.dumps(order), encoding="utf-8")
            _film_in_process(folder, progress)
    return path


def _check(clips: Sequence[Clip], path: Path, size: tuple[int, int], fps: int, playback: float | None) -> None:
    if path.suffix.lower() != ".mp4":
        raise InputError("is not allowed; the name of a video must end in .mp4", source=str(path))
    if not 1 <= len(clips) <= len(COLOURS):
        raise InputError(
            f"{len(clips)} configurations are not allowed; from 1 to {len(COLOURS)} fit a frame", source="video"
        )
    if any(side < 160 or side > 4096 or side % 2 for side in size):
        raise InputError(
            f"{size[0]} x {size[1]} is not allowed; both must be even and from 160 to 4096 pixels",
            key="size",
            source="video",
        )
    if not 1 <= fps <= 120:
        raise InputError(f"{fps} is not allowed; choose 1 to 120 frames per second", key="fps", source="video")
    if playback is not None and not 0.001 <= playback <= 100:
        raise InputError(
            f"{playback} is not allowed; choose 0.001 (slow motion) to 100, 1 is real time",
            key="playback",
            source="video",
        )
    kind_of(clips)


def _film_in_process(folder: str, progress: Callable[[float], None] | None) -> None:
    """Draw what `folder` orders in a process with OpenGL; its last line says what went wrong, if anything."""
    backend = gl_backend()
    assert backend is not None
    command = [sys.executable, "-m", "evaluation.animation", folder]
    said = ""
    with (
        tempfile.TemporaryFile() as noise,
        subprocess.Popen(
            command, env=gl_environment(backend), stdout=subprocess.PIPE, stderr=noise, text=True
        ) as process,
    ):
        assert process.stdout is not None
        try:
            for line in process.stdout:
                said = line.strip()
                if progress is not None and said.startswith("done "):
                    progress(float(said.removeprefix("done ")))
        except BaseException:
            process.kill()
            raise
        if process.wait():
            noise.seek(0)
            lines = noise.read().decode(errors="replace").strip().splitlines()
            reason = (
                said.removeprefix("failed ")
                if said.startswith("failed ")
                else (lines or [f"exit status {process.returncode}"])[-1]
            )
            raise SuspMjError(f"the video could not be rendered: {reason}")
