"""Scopes: variables, environment, and what is set for all nodes; and the ledger of which variables are used.

As upstream, an include shares the scope of the place it stands in, so what it sets stays set. Such a value is marked
as leaked, and reading it gives a warning. A file that does nothing but set values is included for their sake.

A scope is not copied where another one begins in it: it keeps a journal of its changes, which are taken back where the
inner scope ends. So a description costs as much as it is long, however much is set around it.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.description.text import Pieces
from orchestra.errors import Code, Problems
from orchestra.fields import field
from orchestra.resolve.bounded import with_change, with_parameter
from orchestra.resolve.context import POISON, Read, Tracing, Value, Variable, new_variable, noted_of, notes_of
from orchestra.resolve.ledger import Ledger
from orchestra.resolve.model import EnvironmentChange, InlineParameter, ParameterSource, ResolvedRemap
from orchestra.resolve.scalars import flow

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from orchestra.location import Location, Span
    from orchestra.resolve.context import Evaluated, ReadKind, Setter


NAMESPACE = "ros_namespace"

_ABSENT: Final = object()

_Names: TypeAlias = set[str]


@dataclass(frozen=True, slots=True)
class SavedEnvironment:
    """The environment at one place, and what the description had changed in it."""

    environment: dict[str, str]
    changes: dict[str, tuple[EnvironmentChange, ...]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class SavedSettings:
    """Variables, and what was set for all nodes, at one place."""

    variables: dict[str, Variable] = field(default_factory=dict)
    parameters: tuple[ParameterSource, ...] = ()
    parameter_texts: dict[str, str] = field(default_factory=dict)
    remaps: tuple[ResolvedRemap, ...] = ()


@dataclass(slots=True)
class Scope:
    """What is set at one place of a description."""

    problems: Problems
    ledger: Ledger
    environment: dict[str, str]
    variables: dict[str, Variable] = field(default_factory=dict)
    changes: dict[str, tuple[EnvironmentChange, ...]] = field(default_factory=dict)
    parameters: tuple[ParameterSource, ...] = ()
    parameter_texts: dict[str, str] = field(default_factory=dict)
    remaps: tuple[ResolvedRemap, ...] = ()
    left_open: bool = False  # a launch file that is not here may have set anything
    saved_environments: list[SavedEnvironment] = field(default_factory=list)
    saved_settings: list[SavedSettings] = field(default_factory=list)
    environment_copy: dict[str, str] | None = None  # where somebody has made one, until that is changed
    _noted: dict[tuple[str, ...], tuple[Read, ...]] = field(default_factory=dict)  # until a variable is set
    _filled: dict[int | str, tuple[str, tuple[Read, ...], Any]] = field(default_factory=dict)  # as long
    _journal: list[tuple[dict[str, Any], str, Any]] = field(default_factory=list)
    _reads: list[Read] | None = None

    def get(self, name: str, reader: Location) -> Evaluated | None:
        """Return a variable's value, None where it is unset."""
        self.ledger.read.add(name)
        variable = self.variables.get(name)
        if variable is None:
            return None
        if variable.leaked_from is not None:
            self._warn_of_leak(name, variable, reader)
        if self._reads is not None and (read := noted_of(name, variable)) is not None:
            self._reads += read
        return variable.value

    def known(self, names: Sequence[str]) -> tuple[Read, ...] | None:
        """Return what is noted of each variable, its value with it; None where there is something to tell of one."""
        key = tuple(names)
        found = self._noted.get(key)
        if found is None:
            found = notes_of(key, self.variables)
            if found is None:
                return None
            self._noted[key] = found
        self.ledger.read.update(names)
        if self._reads is not None:
            self._reads += found
        return found

    def filled(self, pieces: Pieces, raw: str) -> tuple[str, tuple[Read, ...]] | None:
        """Return what variables alone make of a text, and what is noted of them; None as `known`, or for any other."""
        key = id(pieces) if type(pieces) is Pieces else raw  # which code puts together are others each time
        found = self._filled.get(key)
        if found is None:
            reads = None if pieces.variables is None else self.known(pieces.variables)
            if reads is None:
                return None
            text = pieces.filled([read.value for read in reads])
            self._filled[key] = text, reads, pieces
            return text, reads
        self.ledger.read.update(pieces.variables or ())
        if self._reads is not None:
            self._reads += found[1]
        return found[0], found[1]

    def note(self, kind: ReadKind, name: str, value: str) -> None:
        """Note that something other than a variable is read."""
        if self._reads is None:
            return
        if kind == "environment" and (changes := self.changes.get(name)):
            read = Read(kind, name, value, "environment", changes[-1].location, changes[-1].through)
        elif kind == "environment":
            read = Read(kind, name, value, "caller", None)
        else:
            found = [item for item in self.parameters if getattr(item, "name", None) == name]
            at, through = (found[-1].location, found[-1].through) if found else (None, ())
            read = Read(kind, name, value, "parameter", at, through)
        self._reads.append(read)

    def removes(self, name: str) -> bool:
        """Return whether the description has removed an environment variable."""
        return any(change.value is None for change in self.changes.get(name, ())[-1:])

    def tracing(self) -> Tracing:
        """Collect what is read meanwhile."""
        return Tracing(self)

    def names(self) -> tuple[str, ...]:
        """Return the names of the variables that are set."""
        return tuple(self.variables)

    def set(self, name: str, value: Evaluated, location: Location, setter: Setter = "let") -> None:
        """Set a variable."""
        self._put(self.variables, name, new_variable(value, location, setter=setter))

    def settle(self, name: str, location: Location) -> None:
        """Note where a variable is declared or set with no condition around that."""
        if (variable := self.variables.get(name)) is not None:
            self._put(self.variables, name, _changed(variable, variable.leaked_from, location))

    def forget(self, name: str) -> None:
        """Unset a variable."""
        self._put(self.variables, name, _ABSENT)

    def change(
        self, name: str, value: str | None, location: Location, through: tuple[Read, ...] = ()
    ) -> None:
        """Set or remove an environment variable."""
        change = EnvironmentChange(value, location, through)
        self._put(self.changes, name, with_change(self.changes.get(name, ()), change))
        self._put(self.environment, name, _ABSENT if value is None else value)

    def set_parameter(self, parameter: InlineParameter) -> None:
        """Set a parameter of every node."""
        self.parameters = with_parameter(self.parameters, parameter, self.parameter_texts)
        self._put(self.parameter_texts, parameter.name, flow(parameter.value))

    def save_environment(self) -> None:
        """Save the environment, to be restored later."""
        self.saved_environments.append(SavedEnvironment(dict(self.environment), dict(self.changes)))

    def restore_environment(self, saved: SavedEnvironment) -> None:
        """Make the environment what it was."""
        self._fill(self.environment, saved.environment)
        self._fill(self.changes, saved.changes)

    def save_settings(self) -> None:
        """Save variables, and what is set for all nodes."""
        saved = SavedSettings(dict(self.variables), self.parameters, dict(self.parameter_texts), self.remaps)
        self.saved_settings.append(saved)

    def restore_settings(self, saved: SavedSettings) -> None:
        """Make variables, and what is set for all nodes, what they were."""
        self._fill(self.variables, saved.variables)
        self._fill(self.parameter_texts, saved.parameter_texts)
        self.parameters, self.remaps = saved.parameters, saved.remaps

    def namespace(self, reader: Location) -> Evaluated | None:
        """Return the pushed namespace; `reader` is the place that asks."""
        if (variable := self.variables.get(NAMESPACE)) is None:
            return None
        if variable.leaked_from is not None:
            self._warn_of_leak(NAMESPACE, variable, reader)
        return variable.value

    @contextmanager
    def nested(self) -> Iterator[None]:
        """Begin an inner scope: what is set in it is gone where it ends."""
        mark, parameters, remaps = self.mark(), self.parameters, self.remaps
        heights, left_open = (len(self.saved_environments), len(self.saved_settings)), self.left_open
        try:
            yield
        finally:
            self.left_open = left_open
            while len(self._journal) > mark:
                self._write(*self._journal.pop())
            self.parameters, self.remaps = parameters, remaps
            del self.saved_environments[heights[0] :], self.saved_settings[heights[1] :]

    @contextmanager
    def reading(self) -> Iterator[_Names]:
        """Note which variables are read meanwhile."""
        ledger, before = self.ledger, self.ledger.read
        ledger.read = set()
        try:
            yield ledger.read
        finally:
            before |= ledger.read
            ledger.read = before

    def mark(self) -> int:
        """Return a mark of the present state."""
        return len(self._journal)

    def unchanged_since(self, mark: int) -> bool:
        """Return whether variables, environment and parameters are what they were at a mark."""
        return not any(
            _comparable(earlier) != _comparable(table.get(name, _ABSENT))
            for table, name, earlier in self._earliest(mark)
            if table is not self.changes
        )

    def mark_leaks(self, mark: int, include: Span, *, wanted: bool) -> None:
        """Mark what an include has set, where it differs from what stood there before.

        Where its variables are `wanted`, only a namespace that is left behind is a surprise.
        """
        changes = reversed(self._journal[mark:])  # of each name the earliest counts, which comes last
        earliest = {name: earlier for table, name, earlier in changes if table is self.variables}
        for name, earlier in earliest.items():
            variable = self.variables.get(name)
            if variable is None or variable.leaked_from is not None:
                continue
            if not isinstance(variable.value, Value) or (wanted and name != NAMESPACE):
                continue
            if _comparable(earlier) != _comparable(variable):
                self._put(self.variables, name, _changed(variable, include, variable.settled))

    def _put(self, table: dict[str, Any], name: str, value: object) -> None:
        self._journal.append((table, name, table.get(name, _ABSENT)))
        self._write(table, name, value)

    def _write(self, table: dict[str, Any], name: str, value: object) -> None:
        if table is self.variables:
            self._noted.clear()
            self._filled.clear()
        elif table is self.environment:
            self.environment_copy = None
        if value is _ABSENT:
            table.pop(name, None)
        else:
            table[name] = value

    def _fill(self, table: dict[str, Any], content: Mapping[str, Any]) -> None:
        """Make a table hold nothing but this."""
        for name in [name for name in table if name not in content]:
            self._put(table, name, _ABSENT)
        for name, value in content.items():
            if table.get(name, _ABSENT) is not value:
                self._put(table, name, value)

    def _earliest(self, mark: int) -> list[tuple[dict[str, Any], str, Any]]:
        """Return what has changed since a mark, with what stood there at the mark."""
        changes: dict[tuple[int, str], tuple[dict[str, Any], str, Any]] = {}
        for table, name, earlier in self._journal[mark:]:
            changes.setdefault((id(table), name), (table, name, earlier))
        return list(changes.values())

    def _warn_of_leak(self, name: str, variable: Variable, reader: Location) -> None:
        self.problems.warning(
            Code.LEAKED_VALUE,
            f"'{name}' has the value that an include left behind",
            reader,
            notes=(f"set at {variable.location}", f"included at {variable.leaked_from}"),
        )
        self._put(self.variables, name, _changed(variable, None, variable.settled))


def _changed(old: Variable, leaked_from: Span | None, settled: Location | None) -> Variable:
    return new_variable(old.value, old.location, leaked_from, old.setter, settled, old.noted)


def _comparable(value: object) -> object:
    if not isinstance(value, Variable):
        return value
    return value.value.text if isinstance(value.value, Value) else POISON
