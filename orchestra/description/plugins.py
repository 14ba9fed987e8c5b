"""Keeps plug-ins of pydantic away from the models.

They are for those who want to see what becomes of data, which is not what a launch file is. To look for them, pydantic
reads the metadata of every distribution that is installed: 30 ms of the processor beside the wheels of ROS, a third of
what all models take to be made. The variable that turns them off (PYDANTIC_DISABLE_PLUGINS) would be one of the nodes'
environment too, so the table that pydantic keeps is filled with nothing instead, before it looks.
"""

from __future__ import annotations


def keep_away() -> None:
    """Let pydantic have found no plug-ins; where it keeps them otherwise than expected nothing changes but the time."""
    try:
        from pydantic.plugin import _loader  # noqa: PLC0415 - not of the public interface
    except ImportError:
        return
    if getattr(_loader, "_plugins", {}) is None:
        _loader._plugins = {}  # noqa: SLF001 - as above
