"""A MuJoCo model that is only looked at: shapes, materials, light and contact shadow, shared by the scenes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..colours import rgb


class Picture:
    """A MuJoCo specification of shapes without mass or contact."""

    def __init__(self) -> None:
        import mujoco

        self.types = mujoco.mjtGeom
        self.spec = mujoco.MjSpec()

    def material(self, name: str, colour: Sequence[float], specular: float = 0.2, shininess: float = 0.3) -> None:
        self.spec.add_material(name=name, rgba=[*colour, 1.0] if len(colour) == 3 else list(colour), specular=specular, shininess=shininess)

    def body(self, name: str, height: float, axis: Sequence[float], parent: Any = None) -> Any:
        """A body on a slide joint of the same name."""
        import mujoco

        body = (parent or self.spec.worldbody).add_body(name=name, pos=[0, 0, height])
        body.mass, body.inertia, body.ipos, body.explicitinertial = 1.0, [1, 1, 1], [0, 0, 0], True
        body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=list(axis))
        return body

    def turning(self, parent: Any, name: str) -> Any:
        """A body on a hinge about y of the same name."""
        import mujoco

        body = parent.add_body(name=name)
        body.mass, body.inertia, body.ipos, body.explicitinertial = 1.0, [1, 1, 1], [0, 0, 0], True
        body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0])
        return body

    def shape(self, body: Any, kind: str, size: Sequence[float], material: str, pos: Sequence[float] = (0, 0, 0), **more: Any) -> None:
        """A plain shape: ``box``, ``cylinder``, ``sphere``, ``ellipsoid``, ``plane``."""
        shape = getattr(self.types, f"mjGEOM_{kind.upper()}")
        body.add_geom(type=shape, size=[*size, 0, 0][:3], material=material, pos=list(pos), mass=0.0, contype=0, conaffinity=0, **more)

    def posed(self, name: str) -> Any:
        """A body that is put in its place as a whole, by `pose`."""
        body = self.spec.worldbody.add_body(name=name, mocap=True)
        body.mass, body.inertia, body.ipos, body.explicitinertial = 1.0, [1, 1, 1], [0, 0, 0], True
        return body

    def mesh(self, body: Any, name: str, surface: Any, material: str, pos: Sequence[float] = (0, 0, 0)) -> None:
        """A triangle mesh from `vehicles.mjcf`, used once."""
        self.asset(name, surface)
        self.copy(body, name, material, pos, name=name)

    def asset(self, name: str, surface: Any) -> None:
        """Triangles that several bodies show."""
        import mujoco

        mesh = self.spec.add_mesh(name=name, inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)
        mesh.uservert, mesh.userface = surface.vertices.ravel(), surface.faces.ravel()

    def copy(self, body: Any, asset: str, material: str, pos: Sequence[float] = (0, 0, 0), **more: Any) -> None:
        """One more of an `asset`."""
        body.add_geom(
            type=self.types.mjGEOM_MESH, meshname=asset, material=material, pos=list(pos), mass=0.0, contype=0, conaffinity=0, **more
        )


def studio(picture: Picture, size: tuple[int, int], extent: float = 2.0) -> None:
    """Light, sky and fog; the fog begins at several times the `extent` [m] of what is shown."""
    import mujoco

    spec = picture.spec
    look = spec.visual
    look.global_.offwidth, look.global_.offheight = size
    look.quality.offsamples = 4
    look.map.znear, look.map.zfar = 0.05, 40.0
    look.map.fogstart, look.map.fogend, look.map.haze = 4.5, 10.0, 0.0
    look.rgba.fog = look.rgba.haze = [0.90, 0.925, 0.95, 1.0]
    look.headlight.ambient, look.headlight.diffuse, look.headlight.specular = [0.42] * 3, [0.26] * 3, [0.08] * 3
    spec.stat.extent, spec.stat.center = extent, [0, 0, 0.5]
    spec.add_texture(
        name="sky",
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.66, 0.76, 0.87],
        rgb2=[0.93, 0.95, 0.97],
        width=256,
        height=1536,
    )
    spec.worldbody.add_light(
        type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
        pos=[1.6, -2.6, 4.2],
        dir=[-0.36, 0.5, -1.0],
        diffuse=[0.62, 0.61, 0.58],
        specular=[0.5, 0.5, 0.5],
        castshadow=False,
    )


def materials(picture: Picture, colour: str) -> None:
    """Every material of the scenes; ``paint`` is the configuration's colour ``#rrggbb``."""
    paint = [value / 255 for value in rgb(colour)]
    for name, tone, specular, shininess in (
        ("paint", paint, 0.55, 0.7),
        ("liner", (0.13, 0.14, 0.16), 0.05, 0.1),
        ("rubber", (0.085, 0.087, 0.092), 0.12, 0.12),
        ("mark", (0.88, 0.88, 0.86), 0.1, 0.1),
        ("alloy", (0.74, 0.76, 0.79), 0.7, 0.7),
        ("steel", (0.56, 0.58, 0.61), 0.8, 0.8),
        ("chrome", (0.86, 0.88, 0.9), 1.0, 0.9),
        ("dark", (0.2, 0.21, 0.23), 0.3, 0.4),
        ("spring", (0.97, 0.77, 0.1), 0.6, 0.6),
        ("caliper", (0.72, 0.12, 0.1), 0.4, 0.5),
        ("asphalt", (0.40, 0.415, 0.435), 0.05, 0.1),
        ("bump", (0.58, 0.575, 0.55), 0.05, 0.1),
        ("line", (0.95, 0.95, 0.93), 0.1, 0.1),
        ("floor", (0.83, 0.855, 0.88), 0.02, 0.1),
        ("rig", (0.30, 0.33, 0.37), 0.3, 0.4),
        ("dais", (0.60, 0.635, 0.675), 0.1, 0.2),
        ("shadow", (0.0, 0.0, 0.0, 0.11), 0.0, 0.0),
    ):
        picture.material(name, tone, specular, shininess)


def contact_shadow(picture: Picture, patch: Any) -> None:
    """Soft shadow of a wheel on a body that lies on the road: a stack of faint discs, far cheaper than a shadow map."""
    for number, radius in enumerate(np.linspace(0.13, 0.30, 8)):
        picture.shape(patch, "ellipsoid", (float(radius), float(0.55 * radius), 0.0004), "shadow", (0, 0.02, 0.004 + 0.0005 * number))
