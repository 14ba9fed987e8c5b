"""`interface proto`: a message as its class makes it. No rclpy."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.ros.tools.messages.plain import plain
from orchestra.ros.tools.messages.text import yaml_text
from orchestra.ros.tools.messages.types import interface_type
from orchestra.ros.tools.telling import tell

if TYPE_CHECKING:
    from argparse import Namespace


def proto(options: Namespace) -> int:
    """Write a message, the request of a service or the goal of an action, with its defaults."""
    kind = interface_type(options.type)
    made = plain(getattr(kind, "Request", getattr(kind, "Goal", kind))())
    text = yaml_text(made)
    tell(options, f"{text}\n" if options.no_quotes else f'"{text}"\n', made)
    return 0
