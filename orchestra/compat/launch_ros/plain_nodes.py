"""Nodes whose arguments are of the usual kinds: as all processes are (`launch/plain_process.py`), by the same walk."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch.actions.execute_process import ExecuteProcess
from orchestra.compat.launch.plain_process import OF_PROCESSES, words_of
from orchestra.compat.launch_ros.made_later import Made, Usual
from orchestra.compat.launch_ros.plain_parameters import parameters, remaps
from orchestra.description.actions.node import Node as NodeModel

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.compat.launch_ros.plain_texts import Readers


class PlainNode(ExecuteProcess):
    """What a node is before somebody asks for more than its model, which may be told what its names have come to."""

    def _construct(self) -> None:
        made: Made = vars(self)["_plain"]
        super()._construct()
        if made.resolved is not None:
            self._resolved_by(made.resolved)

    def _resolved_by(self, names: Callable[[], tuple[Any, ...]]) -> None:
        """Take note of what gives what a visit has come to."""
        made: Made | None = vars(self).get("_plain")
        if made is not None:
            made.resolved = names
        else:
            self._resolved_as(*names())

    def _resolved_as(self, name: str | None, namespace: str | None, rules: Any) -> None:
        """Take note of what a visit has come to; a node does."""


_READ: Final[Readers] = {
    **OF_PROCESSES,
    "package": "pkg",
    "executable": "exec",
    "name": "name",
    "namespace": "namespace",
    "exec_name": "exec_name",
    "parameters": parameters("param"),
    "remappings": remaps,
    "arguments": words_of("args", empty=None),
    "ros_arguments": words_of("ros_args", empty=()),
}
USUAL: Final = Usual(
    NodeModel,
    _READ,
    {
        "parameters": ("params", "param", ()),
        "remappings": ("remaps", "remap", ()),
        "arguments": ("words", "args", None),
        "ros_arguments": ("words", "ros_args", ()),
    },
    ("exec",),
)
