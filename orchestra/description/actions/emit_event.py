"""Lets an event happen. It has no name in the launch language: only Python makes one."""

from __future__ import annotations

from typing import Any

from orchestra.description.entity import Action


class EmitEvent(Action):
    """An event of `launch.events`, or one of the user's own, happens after what is being visited."""

    event: Any
