"""Video of runs: quarter or whole cars of several configurations side by side, drawn from their runs, with what was measured.

The picture is a model of its own, posed from a run; the physics are not touched. Drawing happens in a process of its own,
because OpenGL without a screen has to be chosen before MuJoCo is imported.

`window` chooses the stretch of the runs, `quarter_scene` and `car_scene` pose and draw a car, `quarter_hud` and `car_hud` the
texts and traces around it, `film` puts the frames together, and `render` orders the film from this process. Another kind of car
is another scene with a `picture` method and another `Hud`, entered in `film.KINDS`.
"""

from __future__ import annotations

from .clip import Clip
from .render import can_render, render_video

__all__ = ["Clip", "can_render", "render_video"]
