"""Lets an event handler wait for its event. It has no name in the launch language: only Python makes one."""

from __future__ import annotations

from typing import Annotated

from orchestra.description.entity import Action
from orchestra.description.handlers import Handler
from orchestra.description.marks import Instance


class RegisterEventHandler(Action):
    """From here on an event handler waits, before those that wait already; it may look for several events."""

    handlers: tuple[Annotated[Handler, Instance()], ...]
