"""Scopes: variables, environment, and what is set for all nodes; and the ledger of which variables are used.

As upstream, an include shares the scope of the place it stands in, so what it sets stays set. Such a value is marked
as leaked, and reading it gives a warning.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from orchestra.errors import Code, Problems
from orchestra.location import Location, Span
from orchestra.resolve.context import POISON, Evaluated, Value
from orchestra.resolve.model import EnvironmentChange, InlineParameter, ResolvedRemap

NAMESPACE = "ros_namespace"


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable's value; `leaked_from` is the include that set it where that include has ended."""

    value: Evaluated
    location: Location
    leaked_from: Span | None = None


@dataclass(slots=True)
class Ledger:
    """Which variables are read and declared, and which declared ones are left at their default."""

    read: set[str] = field(default_factory=set)
    declared: set[str] = field(default_factory=set)
    defaulted: set[str] = field(default_factory=set)

    def absorb(self, other: Ledger) -> None:
        """Take over what an include did."""
        self.read |= other.read
        self.declared |= other.declared
        self.defaulted |= other.defaulted


@dataclass(slots=True)
class Scope:
    """What is set at one place of a description."""

    problems: Problems
    ledger: Ledger
    environment: dict[str, str]
    variables: dict[str, Variable] = field(default_factory=dict)
    changes: dict[str, tuple[EnvironmentChange, ...]] = field(default_factory=dict)
    parameters: tuple[InlineParameter, ...] = ()
    remaps: tuple[ResolvedRemap, ...] = ()

    def get(self, name: str, reader: Location) -> Evaluated | None:
        """Return a variable's value, None where it is unset."""
        self.ledger.read.add(name)
        variable = self.variables.get(name)
        if variable is None:
            return None
        if variable.leaked_from is not None:
            self._warn_of_leak(name, variable, reader)
        return variable.value

    def names(self) -> tuple[str, ...]:
        """Return the names of the variables that are set."""
        return tuple(self.variables)

    def set(self, name: str, value: Evaluated, location: Location) -> None:
        """Set a variable."""
        self.variables[name] = Variable(value, location)

    def change(self, name: str, value: str | None, location: Location) -> None:
        """Set or remove an environment variable."""
        self.changes[name] = (*self.changes.get(name, ()), EnvironmentChange(value, location))
        if value is None:
            self.environment.pop(name, None)
        else:
            self.environment[name] = value

    @property
    def namespace(self) -> Value | None:
        """The pushed namespace."""
        variable = self.variables.get(NAMESPACE)
        return variable.value if variable is not None and isinstance(variable.value, Value) else None

    def copy(self) -> Scope:
        """Return a scope whose changes leave this one as it is."""
        return replace(
            self,
            environment=dict(self.environment),
            variables=dict(self.variables),
            changes=dict(self.changes),
        )

    def mark_leaks(self, before: dict[str, Variable], include: Span) -> None:
        """Mark what an include has set, where it differs from what stood there before."""
        for name, variable in self.variables.items():
            earlier = before.get(name)
            if earlier is variable or variable.leaked_from is not None:
                continue
            if earlier is None or _text(earlier) != _text(variable):
                self.variables[name] = replace(variable, leaked_from=include)

    def _warn_of_leak(self, name: str, variable: Variable, reader: Location) -> None:
        self.problems.warning(
            Code.LEAKED_VALUE,
            f"'{name}' has the value that an include left behind",
            reader,
            notes=(f"set at {variable.location}", f"included at {variable.leaked_from}"),
        )
        self.variables[name] = replace(variable, leaked_from=None)


def _text(variable: Variable) -> object:
    return variable.value.text if isinstance(variable.value, Value) else POISON
