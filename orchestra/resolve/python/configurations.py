"""Launch configurations and the environment of the current scope, as the mappings that user code reads and writes."""

from __future__ import annotations

import os
from collections.abc import Iterator, MutableMapping
from importlib import import_module
from typing import TYPE_CHECKING, Any

from orchestra.compat.place import here
from orchestra.compat.reported import ReportedError
from orchestra.dataclass import dataclass
from orchestra.location import Location
from orchestra.resolve.context import Value
from orchestra.resolve.model import InlineParameter

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.resolve.resolution import Resolution

_PARAMETERS = "global_params"
_REMAPS = "ros_remaps"


@dataclass(frozen=True, slots=True)
class ObjectValue(Value):
    """A configuration that user code has set to something that is no text."""

    kept: Any = None


class Configurations(MutableMapping[str, Any]):
    """The variables. Upstream keeps two lists among them, which are made up here from what the scope has.

    Setting such a list changes the scope; what is done to the list itself does not.
    """

    def __init__(self, run: Resolution) -> None:
        self._run = run

    def __getitem__(self, name: str) -> Any:
        if name in (_PARAMETERS, _REMAPS):
            made_up = self._made_up(name)
            if made_up:
                return made_up
        value = self._run.scope.get(name, self._location())
        if value is None:
            raise KeyError(name)
        if not isinstance(value, Value):
            raise ReportedError(
                f"the launch configuration {name!r} has no value, for a reason that is reported"
            )
        return value.kept if isinstance(value, ObjectValue) else value.text

    def __setitem__(self, name: str, value: Any) -> None:
        location = self._location()
        if name in (_PARAMETERS, _REMAPS) and isinstance(value, list | tuple):
            self._make_up(name, value)
        elif isinstance(value, str):
            self._run.scope.set(name, Value(value, location), location, "code")
        else:
            self._run.scope.set(name, ObjectValue(str(value), location, value), location, "code")

    def __delitem__(self, name: str) -> None:
        if self._run.scope.get(name, self._location()) is None:
            raise KeyError(name)
        self._run.scope.forget(name)

    def __contains__(self, name: object) -> bool:
        """Return whether a value is set; one that is not known for its faults is none."""
        if name in (_PARAMETERS, _REMAPS) and self._made_up(str(name)):
            return True
        self._run.scope.ledger.read.add(str(name))
        return self._has_value(name)

    def _has_value(self, name: object) -> bool:
        variable = self._run.scope.variables.get(str(name))
        return variable is not None and isinstance(variable.value, Value)

    def __iter__(self) -> Iterator[str]:
        self._run.scope.ledger.read.update(self._run.scope.names())
        yield from filter(self._has_value, self._run.scope.names())
        yield from (name for name in (_PARAMETERS, _REMAPS) if self._made_up(name))

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def copy(self) -> dict[str, Any]:
        """Return a dict with what is set now."""
        return dict(self)

    def __repr__(self) -> str:
        return repr(self.copy())

    def __or__(self, other: Any) -> dict[str, Any]:
        return self.copy() | dict(other)

    def _location(self) -> Location:
        return Location(here().span, self._run.context.included_from)

    def _made_up(self, name: str) -> list[Any]:
        if name == _REMAPS:
            return [(rule.source.text, rule.target.text) for rule in self._run.scope.remaps]
        return [
            (item.name, item.value) if isinstance(item, InlineParameter) else item.path
            for item in self._run.scope.parameters
        ]

    def _make_up(self, name: str, items: Sequence[Any]) -> None:
        """Let one of the lists be this: what is new in it is set for all nodes as an action would set it."""
        known = self._made_up(name)
        same = next(
            (index for index, pair in enumerate(zip(known, items, strict=False)) if pair[0] != pair[1]), None
        )
        count = min(len(known), len(items)) if same is None else same
        if name == _REMAPS:
            self._run.scope.remaps = self._run.scope.remaps[:count]
        else:
            self._run.scope.parameters = self._run.scope.parameters[:count]
        self._run.engine.visit([_action(name, item) for item in items[count:]])


def _action(name: str, item: Any) -> Any:
    """Return the action that adds an item to one of the lists: a rule, a name with a value, or the path of a file."""
    actions = import_module("orchestra.compat.launch_ros.actions")  # which few launch files need here
    if name == _REMAPS:
        return actions.SetRemap(*item)
    return (
        actions.SetParameter(*item) if isinstance(item, tuple) else actions.SetParametersFromFile(str(item))
    )


class Environment(MutableMapping[str, str]):
    """The environment variables; `os.environ` has the same while user code runs."""

    def __init__(self, run: Resolution) -> None:
        self._run = run

    def __getitem__(self, name: str) -> str:
        return self._run.scope.environment[name]

    def __setitem__(self, name: str, value: str) -> None:
        os.environ[name] = value  # raises TypeError for what is no text
        self._run.scope.change(name, value, self._location())

    def __delitem__(self, name: str) -> None:
        if name not in self._run.scope.environment:
            raise KeyError(name)
        del os.environ[name]
        self._run.scope.change(name, None, self._location())

    def __iter__(self) -> Iterator[str]:
        return iter(self._run.scope.environment)

    def __len__(self) -> int:
        return len(self._run.scope.environment)

    def copy(self) -> dict[str, str]:
        """Return a dict with what is set now."""
        return dict(self)

    def __repr__(self) -> str:
        return repr(self.copy())

    def _location(self) -> Location:
        return Location(here().span, self._run.context.included_from)
