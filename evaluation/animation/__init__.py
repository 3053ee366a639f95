"""Video of runs: quarter cars, whole cars, cars that drive freely; several configurations at once, drawn from their
runs.

The picture is a model of its own, posed from a run; the physics are not touched. Drawing happens in a process of its
own, because OpenGL without a screen has to be chosen before MuJoCo is imported.

`window` chooses the stretch of the runs. `quarter`, `oscillation` and `handling` each have a `scene` that poses and
draws their cars from meshes of `shapes`, and a `hud` with the texts and traces around it; `style` says from where and
how fine; `film` puts the frames together, and `render` orders the film from this process. Another kind of car is
another `Kind` with its `Scene` and its `Hud`, entered in `film.KINDS`; what another manoeuvre puts on the road is
another entry in `handling.world`; another camera is another entry in `cameras`.
"""
