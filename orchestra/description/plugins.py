"""Keeps plug-ins of pydantic away where Orchestra makes models of it.

They are for those who want to see what becomes of data, which is not what a launch file is. To look for them, pydantic
reads the metadata of every distribution that is installed: 30 ms of the processor beside the wheels of ROS, and as much
again for the library that reads it. The variable that turns them off (PYDANTIC_DISABLE_PLUGINS) would be one of the
nodes' environment too, so the module that looks is never imported.
"""

from __future__ import annotations

import sys
from types import ModuleType

_LOADER = "pydantic.plugin._loader"  # not of the public interface: where there is none, nothing changes but the time


def keep_away() -> None:
    """Let pydantic find no plug-ins, unless it has looked already."""
    if _LOADER not in sys.modules:
        nothing = ModuleType(_LOADER, keep_away.__doc__)
        vars(nothing)["get_plugins"] = tuple
        sys.modules[_LOADER] = nothing
