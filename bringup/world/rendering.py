"""Pictures of the world, rendered without a window, where a GL library can do that.

MuJoCo's own Renderer takes its GL backend from the environment when it is imported; here the first one that the machine
has is taken, so that nobody has to set a variable.
"""

from __future__ import annotations

import ctypes
import importlib
import os
from typing import TYPE_CHECKING, Any

import numpy as np

from bringup.world.physics import mujoco

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bringup.world.model import Model

# In the order in which they are looked for: EGL uses a graphics card if there is one.
LIBRARIES = {"egl": ("libEGL.so.1",), "osmesa": ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so")}
HINT = "install the system's libegl1 or libosmesa6 and Python's mujoco with its rendering, or render nothing"
MOST_SHAPES = 10_000


class NoRenderingError(RuntimeError):
    """Nothing can be rendered here; the message says why."""


class Renderer:
    """Renders what a model's cameras see, in pictures of up to a size in pixels; for one thread.

    Raises NoRenderingError.
    """

    def __init__(self, model: Model, width: int, height: int) -> None:
        self._physics = model.physics
        backend = _backend()
        try:
            self._canvas = importlib.import_module(f"mujoco.{backend}").GLContext(width, height)
            self._canvas.make_current()
            self._context = mujoco.MjrContext(self._physics, mujoco.mjtFontScale.mjFONTSCALE_100)
        # A GL library that is not well raises whatever comes to it: OpenGL's own errors, AttributeError, ...
        except Exception as error:
            told = " ".join(str(error).split()) or type(error).__name__
            raise NoRenderingError(f"nothing can be rendered with {backend} ({told}); {HINT}") from error
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._context)
        self._scene = mujoco.MjvScene(self._physics, maxgeom=MOST_SHAPES)
        self._options = mujoco.MjvOption()
        self._camera = mujoco.MjvCamera()
        self._camera.type = mujoco.mjtCamera.mjCAMERA_FIXED
        # They take three quarters of the time and show nothing of use.
        for flag in (mujoco.mjtRndFlag.mjRND_SHADOW, mujoco.mjtRndFlag.mjRND_REFLECTION):
            self._scene.flags[flag] = 0

    def render(self, data: Any, camera: str, width: int, height: int) -> NDArray[np.uint8]:  # noqa: ANN401 - MjData has no type
        """What a camera sees: rows of pixels from the top, each red, green and blue."""
        self._camera.fixedcamid = self._physics.camera(camera).id
        mujoco.mjv_updateScene(
            self._physics, data, self._options, None, self._camera, mujoco.mjtCatBit.mjCAT_ALL, self._scene
        )
        field = mujoco.MjrRect(0, 0, width, height)
        mujoco.mjr_render(field, self._scene, self._context)
        image = np.empty((height, width, 3), np.uint8)
        mujoco.mjr_readPixels(image, None, field, self._context)
        return image[::-1]

    def close(self) -> None:
        """Give back what GL holds."""
        self._context.free()
        self._canvas.free()


def _backend() -> str:
    """What MUJOCO_GL asks for, or the first backend whose library is here. Raises NoRenderingError: none is."""
    asked = os.environ.get("MUJOCO_GL", "").lower()
    if asked in LIBRARIES:
        return asked
    for backend, names in LIBRARIES.items():
        if any(_loads(name) for name in names):
            return backend
    raise NoRenderingError(f"nothing can be rendered: there is no EGL and no OSMesa here; {HINT}")


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True
