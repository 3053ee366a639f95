"""The film: frames of runs, one by one, into a file; in the process that has OpenGL."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np

from susp_mj.run import Run

from ..colours import COLOURS
from . import cameras
from .cameras import Camera
from .clip import Clip
from .handling.hud import HandlingHud
from .handling.scene import HandlingScene
from .hud import Hud
from .kinds import HANDLING, OSCILLATION, QUARTER, Kind, kind_of
from .oscillation.hud import OscillationHud
from .oscillation.scene import OscillationScene
from .quarter.hud import QuarterHud
from .quarter.scene import QuarterScene
from .scene import Scene
from .style import Shot, Style
from .video import Encoder
from .window import Window, window_of

KINDS: dict[Kind, tuple[Callable[[Shot, Window], Scene], type[Hud]]] = {
    QUARTER: (QuarterScene, QuarterHud),
    OSCILLATION: (OscillationScene, OscillationHud),
    HANDLING: (HandlingScene, HandlingHud),
}
"""Scene, and texts around it, of each kind of run that `kind_of` tells apart."""


def frames(clips: Sequence[Clip], window: Window, size: tuple[int, int], style: Style) -> Iterator[np.ndarray]:
    """(height, width, 3) frames one by one; needs a working OpenGL in this process."""
    from PIL import Image

    scene_of, hud_of = KINDS[kind_of(clips)]
    hud = hud_of(clips, window, size, style)
    scenes: list[Scene] = []
    try:
        for number, box in enumerate(hud.views):
            shown = range(len(clips)) if len(hud.views) == 1 else (number,)
            chosen, colours = tuple(clips[k] for k in shown), tuple(COLOURS[k] for k in shown)
            scenes.append(
                scene_of(Shot(chosen, colours, (box.width, box.height), style, clips[0], hud.highest_load), window)
            )
        for time in window.times.tolist():
            frame = hud.background.copy()
            for scene, box in zip(scenes, hud.views, strict=True):
                frame.paste(Image.fromarray(scene.picture(time)), (box.left, box.top))
            hud.draw(frame, time)
            yield np.asarray(frame)
    finally:
        for scene in scenes:
            scene.close()


def film(folder: Path) -> None:
    """Read the order that `render` left in a folder, draw, encode, and print the fraction done.

    The order brings the cameras of the process that gave it, for a plugin's are not known here.
    """
    order = json.loads((folder / "order.json").read_text(encoding="utf-8"))
    for name, camera in order["cameras"].items():
        cameras.register(name, Camera(**camera))
    clips = [Clip(label, Run.load(folder / f"{number}.nc")) for number, label in enumerate(order["labels"])]
    size = (int(order["size"][0]), int(order["size"][1]))
    window = window_of([clip.run for clip in clips], order["fps"], order["playback"])
    with Encoder(Path(order["path"]), size, order["fps"], {"title": " / ".join(order["labels"])}) as encoder:
        for number, frame in enumerate(frames(clips, window, size, Style(**order["style"])), start=1):
            encoder.write(frame.tobytes())
            print(f"done {number / len(window.times):.4f}", flush=True)
