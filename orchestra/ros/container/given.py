"""What a component is given beside its own constructor: names, remaps, parameters.

A node class of rclpy calls `Node.__init__` with what it decides itself, most with nothing but a name, so what the
container is told of a component must be added there. Rejected: to require constructors that pass keywords on, which
hardly any has; and a class of ours in front of `Node` in the order of base classes, which `LifecycleNode` and others
pass by.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import wraps
from typing import TYPE_CHECKING, Any

from rclpy.node import Node
from rclpy.parameter import Parameter

from orchestra.dataclass import dataclass
from orchestra.fields import field

if TYPE_CHECKING:
    from collections.abc import Iterator


@dataclass(frozen=True, slots=True)
class Given:
    """`arguments` are those of a command line, `overrides` are parameters; `of_all` those of the container too."""

    arguments: Sequence[str] = ()
    overrides: Sequence[Parameter] = ()
    of_all: bool = False


@dataclass(slots=True)
class Making:
    """A component that is being made: the first node of its class gets what is given. `nodes` are all that it made."""

    given: Given
    kind: object
    nodes: list[Node] = field(default_factory=list)
    done: bool = False

    def takes(self, node: Node) -> bool:
        """Tell whether a node is the component itself, and not another one that it makes."""
        return not self.done and (type(node) is self.kind or not isinstance(self.kind, type))


_MAKING: ContextVar[Making | None] = ContextVar("making", default=None)


def install() -> None:
    """Have every node of this process made with what it is given, from now on.

    No node listens to the arguments of the process unless it is told to, since they rename the container;
    `rclpy.create_node` asks for them in any case.
    """
    original = Node.__init__

    @wraps(original)
    def __init__(self: Node, *words: Any, **options: Any) -> None:  # noqa: ANN401, N807 - of an untyped package
        making = _MAKING.get()
        if making is None:
            original(self, *words, **{**options, "use_global_arguments": False})
            return
        making.nodes.append(self)
        if not making.takes(self):
            original(self, *words, **{**options, "use_global_arguments": making.given.of_all})
            return
        making.done = True
        original(self, *words, **_with(making.given, options))

    Node.__init__ = __init__


@contextmanager
def making(given: Given, kind: object) -> Iterator[Making]:
    """Give this to the first node of a kind that is made inside."""
    found = Making(given, kind)
    token = _MAKING.set(found)
    try:
        yield found
    finally:
        _MAKING.reset(token)


def _with(given: Given, options: dict[str, Any]) -> dict[str, Any]:
    """Return the options of a node with what is given: of remaps the first that matches counts, of values the last."""
    own = options.get("cli_args") or []
    overrides = options.get("parameter_overrides") or []
    return {
        **options,
        "cli_args": [*given.arguments, *(("--", *own) if own else ())],
        "parameter_overrides": [*overrides, *given.overrides],
        "use_global_arguments": given.of_all,
    }
