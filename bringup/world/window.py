"""MuJoCo's own viewer, for those who have a display."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bringup.world.simulation import Simulation


class NoWindowError(RuntimeError):
    """No window can be opened here; the message says why."""


def open_window(simulation: Simulation) -> Any:  # noqa: ANN401 - MuJoCo's handle has no type
    """Show the world in a window: `sync()` redraws it, `is_running()` tells whether it is open, `close()` closes it.

    Raises NoWindowError where there is no display or no viewer.
    """
    try:
        # Here, because headless runs need no rendering libraries.
        import glfw  # noqa: PLC0415
        import mujoco.viewer  # noqa: PLC0415
    except (ImportError, RuntimeError) as error:
        raise NoWindowError(f"the viewer cannot be loaded ({error}); run with headless:=true") from error
    # The viewer itself would end the process from another thread.
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        if not glfw.init():
            reasons = "; ".join(str(warning.message) for warning in said) or "GLFW does not start"
            raise NoWindowError(f"no window can be opened ({reasons}); run with headless:=true")
    return mujoco.viewer.launch_passive(simulation.model.physics, simulation.data)
