"""Video files: whether this machine can draw without a screen, and frames into an MP4 file through ffmpeg."""

from __future__ import annotations

import contextlib
import functools
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType

from susp_mj.errors import SuspMjError

NO_GL = (
    "rendering needs OpenGL without a screen, which does not work here: "
    "install the Debian packages libegl1 libopengl0 libgl1-mesa-dri (or libosmesa6)"
)
NO_FFMPEG = "encoding a video needs ffmpeg: install the Debian package ffmpeg, or pip install imageio-ffmpeg"
_PROBE = """
import mujoco
model = mujoco.MjModel.from_xml_string("<mujoco><worldbody><light pos='0 0 2'/><geom size='.1'/></worldbody></mujoco>")
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
with mujoco.Renderer(model, 16, 16) as renderer:
    renderer.update_scene(data)
    raise SystemExit(0 if renderer.render().any() else 1)
"""
_PROBE_LIMIT = 60.0


@functools.cache
def gl_backend() -> str | None:
    """Value of MUJOCO_GL that works here, found in a process of its own; None if none does. SUSP_MJ_GL is tried first.

    MuJoCo cannot even be imported under a value that does not work, so this process never sets it.
    """
    wanted = (os.environ.get("SUSP_MJ_GL") or os.environ.get("MUJOCO_GL", "")).strip().lower()
    usual = ["egl", "osmesa"] if sys.platform.startswith("linux") else [""]
    for backend in dict.fromkeys([wanted, *usual] if wanted else usual):
        if _draws(backend):
            return backend
    return None


def gl_environment(backend: str) -> dict[str, str]:
    """This process' environment with a GL backend chosen, and the same import path."""
    environment = {key: value for key, value in os.environ.items() if key != "PYOPENGL_PLATFORM"}
    environment["MUJOCO_GL"] = backend
    environment["PYTHONPATH"] = os.pathsep.join(part or str(Path.cwd()) for part in sys.path)
    return environment


def _draws(backend: str) -> bool:
    """Whether a process with this backend draws a picture that is not black."""
    try:
        done = subprocess.run(
            [sys.executable, "-c", _PROBE],
            env=gl_environment(backend),
            capture_output=True,
            timeout=_PROBE_LIMIT,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0


def ffmpeg_program() -> str | None:
    """Path of ffmpeg: the one on PATH, else the one that comes with imageio-ffmpeg, else None."""
    found = shutil.which("ffmpeg")
    if found:
        return found
    try:
        import imageio_ffmpeg

        return str(imageio_ffmpeg.get_ffmpeg_exe())
    except (ImportError, RuntimeError):
        return None


class Encoder:
    """Writes frames to an MP4 file (H.264, yuv420p, BT.709) one by one; a context manager.

    Args:
        path: the file; overwritten.
        size: (width, height) in pixels, both even.
        fps: frames per second.
        tags: metadata of the file, e.g. its title.

    Raises:
        SuspMjError: no ffmpeg, or it failed.
    """

    def __init__(self, path: Path, size: tuple[int, int], fps: int, tags: Mapping[str, str] | None = None) -> None:
        program = ffmpeg_program()
        if program is None:
            raise SuspMjError(NO_FFMPEG)
        width, height = size
        source = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(fps), "-i", "-"]
        colour = [
            "-vf",
            "scale=out_color_matrix=bt709:out_range=tv",
            "-colorspace",
            "bt709",
            "-color_primaries",
            "bt709",
            "-color_trc",
            "bt709",
        ]
        coding = [
            "-an",
            "-c:v",
            "libx264",
            "-preset",
            "veryfast",
            "-crf",
            "20",
            "-pix_fmt",
            "yuv420p",
            "-movflags",
            "+faststart",
        ]
        same = ["-fflags", "+bitexact", "-flags:v", "+bitexact"]
        texts = [part for key, value in (tags or {}).items() for part in ("-metadata", f"{key}={value}")]
        command = [
            program,
            "-y",
            "-loglevel",
            "error",
            *source,
            *colour,
            *coding,
            *same,
            *texts,
            "-f",
            "mp4",
            str(path),
        ]
        self._messages = tempfile.TemporaryFile()  # noqa: SIM115 -- closed in __exit__
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=self._messages
        )

    def write(self, frame: bytes) -> None:
        """Append a frame: height x width x 3 bytes."""
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(frame)
        except OSError:
            self._process.wait()
            raise SuspMjError(self._complaint()) from None

    def __enter__(self) -> Encoder:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        assert self._process.stdin is not None
        with contextlib.suppress(OSError):
            self._process.stdin.close()
        code = self._process.wait()
        try:
            if kind is None and code:
                raise SuspMjError(self._complaint())
        finally:
            self._messages.close()

    def _complaint(self) -> str:
        self._messages.seek(0)
        lines = self._messages.read().decode(errors="replace").strip().splitlines()
        return f"ffmpeg failed: {lines[-1] if lines else f'exit status {self._process.returncode}'}"
