"""An entity of a Python launch file that only its own code can carry out."""

from __future__ import annotations

from typing import Any

from orchestra.description.entity import Action


class OpaqueAction(Action):
    """A Python entity. It has no name in the launch language: only Python makes one."""

    target: Any
