"""A MuJoCo model that is only looked at: shapes, materials, light and contact shadow, shared by the scenes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..colours import rgb

SUN = np.array([-0.36, 0.5, -1.0])
"""Direction in which the light falls."""
SUN_COURSE = float(np.arctan2(SUN[1], SUN[0]))
"""Its course over the ground [rad]."""


class Picture:
    """A MuJoCo specification of shapes without mass or contact."""

    def __init__(self) -> None:
        import mujoco

        self.types = mujoco.mjtGeom
        self.spec = mujoco.MjSpec()

    def material(
        self,
        name: str,
        colour: Sequence[float],
        specular: float = 0.2,
        shininess: float = 0.3,
        *,
        emission: float = 0.0,
    ) -> None:
        tone = [*colour, 1.0] if len(colour) == 3 else list(colour)
        self.spec.add_material(name=name, rgba=tone, specular=specular, shininess=shininess, emission=emission)

    def glossy(self, name: str, colour: Sequence[float], share: float, alpha: float = 1.0) -> None:
        """A material that mirrors ground, horizon and sky by a share from 0 to 1, baked into a texture over the upward
        slope."""
        import mujoco

        upward = np.linspace(-1.0, 1.0, 256)[:, None]
        sky = np.array([0.66, 0.76, 0.88]) + np.exp(-np.abs(upward - 0.04) / 0.20) * np.array([0.34, 0.24, 0.12])
        above = 1 / (1 + np.exp(-(upward - 0.03) / 0.03))
        around = above * sky + (1 - above) * np.array([0.24, 0.25, 0.26])
        mirrored = share * (0.25 + 0.75 * (1 - np.abs(upward)) ** 2)
        tones = (1 - mirrored) * np.array(colour) * (0.82 + 0.18 * upward) + mirrored * around
        image = np.repeat((np.clip(tones, 0, 1) * 255).astype(np.uint8)[:, None, :], 8, axis=1)
        texture = self.spec.add_texture(name=name, type=mujoco.mjtTexture.mjTEXTURE_2D, width=8, height=256, nchannel=3)
        texture.data = image.tobytes()
        material = self.spec.add_material(name=name, rgba=[1, 1, 1, alpha], specular=0.5, shininess=0.75)
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name

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

    def shape(
        self, body: Any, kind: str, size: Sequence[float], material: str, pos: Sequence[float] = (0, 0, 0), **more: Any
    ) -> None:
        """A plain shape: ``box``, ``cylinder``, ``sphere``, ``ellipsoid``, ``plane``."""
        shape = getattr(self.types, f"mjGEOM_{kind.upper()}")
        body.add_geom(
            type=shape,
            size=[*size, 0, 0][:3],
            material=material,
            pos=list(pos),
            mass=0.0,
            contype=0,
            conaffinity=0,
            **more,
        )

    def posed(self, name: str) -> Any:
        """A body that is put in its place as a whole, by `pose`."""
        body = self.spec.worldbody.add_body(name=name, mocap=True)
        body.mass, body.inertia, body.ipos, body.explicitinertial = 1.0, [1, 1, 1], [0, 0, 0], True
        return body

    def mesh(self, body: Any, name: str, surface: Any, material: str, pos: Sequence[float] = (0, 0, 0)) -> None:
        """A triangle mesh from `shapes`, used once."""
        self.asset(name, surface)
        self.copy(body, name, material, pos, name=name)

    def asset(self, name: str, surface: Any) -> None:
        """Triangles that several bodies show; with normals of their own they can wear a `glossy` material."""
        import mujoco

        mesh = self.spec.add_mesh(name=name, inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)
        mesh.uservert, mesh.userface = surface.vertices.ravel(), surface.faces.ravel()
        if surface.normals is not None:
            mesh.usernormal, mesh.userfacenormal = surface.normals.ravel(), surface.faces.ravel()
            upward = 0.5 + 0.49 * np.clip(surface.normals[:, 2], -1.0, 1.0)
            mesh.usertexcoord = np.column_stack([np.full(len(upward), 0.5), upward]).ravel()
            mesh.userfacetexcoord = surface.faces.ravel()

    def copy(self, body: Any, asset: str, material: str, pos: Sequence[float] = (0, 0, 0), **more: Any) -> None:
        """One more of an `asset`."""
        body.add_geom(
            type=self.types.mjGEOM_MESH,
            meshname=asset,
            material=material,
            pos=list(pos),
            mass=0.0,
            contype=0,
            conaffinity=0,
            **more,
        )


def studio(picture: Picture, size: tuple[int, int], extent: float = 2.0, samples: int = 4, *, sun: bool = True) -> None:
    """Light, sky and fog.

    Args:
        picture: what is lit.
        size: (width, height) of the picture [px].
        extent: of what is shown; the fog begins at several times that [m].
        samples: of every pixel.
        sun: whether there is a light that stands still.
    """
    import mujoco

    spec = picture.spec
    look = spec.visual
    look.global_.offwidth, look.global_.offheight = size
    look.quality.offsamples = samples
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
    if sun:
        sunlight(spec.worldbody, 5.2)


def sunlight(body: Any, distance: float) -> None:
    """Light from the right, from so far away [m] above the `body` that it hangs on."""
    import mujoco

    towards = SUN / np.linalg.norm(SUN)
    body.add_light(
        type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
        pos=(-distance * towards).tolist(),
        dir=towards.tolist(),
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
        picture.shape(
            patch,
            "ellipsoid",
            (float(radius), float(0.55 * radius), 0.0004),
            "shadow",
            (0, 0.02, 0.004 + 0.0005 * number),
        )
