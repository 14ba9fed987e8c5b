"""Lets an event handler wait no more. It has no name in the launch language: only Python makes one."""

from __future__ import annotations

from typing import Any

from orchestra.description.entity import Action


class UnregisterEventHandler(Action):
    """From here on an event handler, known by its object, waits no more."""

    handler: Any
