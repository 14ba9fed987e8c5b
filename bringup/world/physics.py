"""MuJoCo without its own rendering.

That one ends the import where MUJOCO_GL names a library that is not here; `bringup.world.rendering` chooses for itself.
"""

import os

_asked = os.environ.get("MUJOCO_GL")
os.environ["MUJOCO_GL"] = "disable"
try:
    import mujoco
finally:
    del os.environ["MUJOCO_GL"]
    if _asked is not None:
        os.environ["MUJOCO_GL"] = _asked

__all__ = ["mujoco"]
