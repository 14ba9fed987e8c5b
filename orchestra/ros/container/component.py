"""Makes the node of a component, and takes it away so that nothing of it stays in the graph."""

from __future__ import annotations

import gc
import traceback
from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node

from orchestra.dataclass import dataclass
from orchestra.ros.container.given import making
from orchestra.ros.container.lifecycle_errors import tell_errors
from orchestra.ros.container.plugins import wanted
from orchestra.ros.container.refusal import RefusalError

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.ros.container.given import Given
    from orchestra.ros.container.plugins import Make

    Say = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Component:
    """A node, and all the nodes that its constructor made, it among them."""

    node: Node
    nodes: Sequence[Node]

    @property
    def name(self) -> str:
        """The full name of the node."""
        return str(self.node.get_fully_qualified_name())


def made(make: Make, name: str, given: Given, say: Say) -> Component:
    """Make a component; `say` gets the traceback where that fails.

    Raises:
        RefusalError: with what the constructor raised; nothing that it made is left in the graph.
    """
    options = wanted(make, name)
    with making(given, make) as made_here:
        try:
            node: Any = make(**options)
        except (Exception, SystemExit) as error:  # noqa: BLE001 - whatever a component's own code does
            say(traceback.format_exc())
            reason = f"Component constructor threw an exception: {_told(error)}"
        else:
            reason = "" if isinstance(node, Node) else f"'{make.__qualname__}' gives no node: {_kind(node)}"
    if not reason:
        tell_errors(node)
        return Component(node, made_here.nodes or [node])
    node = None
    take_away(made_here.nodes, say)
    made_here.nodes.clear()
    gc.collect()  # a node whose own constructor has failed halfway is let go of with its last reference
    raise RefusalError(reason)


def take_away(nodes: Sequence[Node], say: Say) -> None:
    """Destroy nodes, the last one first, and whatever they still have in the graph."""
    for node in reversed(nodes):
        try:
            node.destroy_node()  # a component's own, as it has it
        except InvalidHandle:
            pass  # it was destroyed before
        except Exception:  # noqa: BLE001 - a component's own code
            say(traceback.format_exc())
        _destroy_rest(node)


def _destroy_rest(node: Node) -> None:
    """Destroy what rclpy leaves: actions, the machine of a lifecycle; all of it, where a component's own left it."""
    for waitable in [*node.waitables]:
        with suppress(Exception):  # some have been destroyed, some cannot be
            waitable.destroy()
    with suppress(Exception):  # it was destroyed, or never whole
        Node.destroy_node(node)
    machine = getattr(node, "_state_machine", None)
    if machine is not None:
        with suppress(InvalidHandle):
            machine.destroy_when_not_in_use()


def _told(error: BaseException) -> str:
    text = str(error)
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def _kind(thing: object) -> str:
    return f"it is of type '{type(thing).__name__}'"
