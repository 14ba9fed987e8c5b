"""What an evaluation sees: variables, environment, the current file, packages, and the collector of problems."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from typing import TYPE_CHECKING, Any, Final, Literal, NamedTuple, Protocol, TypeAlias

from orchestra.dataclass import dataclass, maker
from orchestra.description.text import Opaque
from orchestra.errors import Problems
from orchestra.fields import field
from orchestra.location import Location, Span, new_location
from orchestra.resolve.inputs import Inputs

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from orchestra.description.entity import Entity
    from orchestra.description.text import Template
    from orchestra.resolve.weights import Weights

ReadKind: TypeAlias = Literal["variable", "environment", "parameter", "namespace"]
# Who set what is read: `caller` is the environment in which we were called, `code` that of a launch file in Python.
Setter: TypeAlias = Literal[
    "default",
    "include",
    "command line",
    "let",
    "for_each",
    "environment",
    "parameter",
    "push",
    "code",
    "caller",
]


@dataclass(frozen=True, slots=True)
class Read:
    """Something that was read to make a value: its own value, who set it and where, and what that came through.

    `written` is the place where the value stands as it is, None where it was made of something else. `source` is the
    value with the text that it was made of.
    """

    kind: ReadKind
    name: str
    value: str
    setter: Setter
    location: Location | None
    through: tuple[Read, ...] = ()
    written: Location | None = None
    source: Value | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Value:
    """A text that evaluation gave, where it was written, and what was read to make it.

    `verbatim` tells that it stands there as it is, so that another text can be put in its place; else `raw` is what
    stands there, where that is known.
    """

    text: str
    location: Location
    through: tuple[Read, ...] = field(default=(), compare=False, repr=False, kw_only=True)
    verbatim: bool = field(default=False, compare=False, repr=False, kw_only=True)
    raw: str | None = field(default=None, compare=False, repr=False, kw_only=True)


# What a resolution makes thousands of.
new_read = maker(Read)
new_value = maker(Value)


class Packaged(NamedTuple):
    """What a node starts: the names of package and executable where they are known, and the words that start it.

    `share` is the share folder of the package, where that is here; `through` was read for the two names.
    """

    package: str | None
    executable: str | None
    words: tuple[str, ...]
    share: str | None
    through: Sequence[Read] = ()
    faulty: bool = False


class Poison:
    """What a faulty value evaluates to: its fault is reported, so nothing that uses it reports again."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "POISON"


POISON: Final = Poison()

Evaluated: TypeAlias = Value | Poison


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable's value; `leaked_from` is the include that set it where that include has ended.

    `settled` is where a file declared or set it with no condition around that. `noted` has what is noted where it is
    read, once that is asked for: it is the same each time.
    """

    value: Evaluated
    location: Location
    leaked_from: Span | None = None
    setter: Setter = "let"
    settled: Location | None = None
    noted: list[tuple[Read]] = field(default_factory=list, compare=False, repr=False)


new_variable = maker(Variable)


def noted_of(name: str, variable: Variable) -> tuple[Read] | None:
    """Return what is noted of a variable where it is read, which is one thing; None for one with a faulty value."""
    if not variable.noted:
        value = variable.value
        if isinstance(value, Poison):
            return None
        setter, at, written = variable.setter, variable.location, value.location if value.verbatim else None
        read = new_read("variable", name, value.text, setter, at, value.through, written, value)
        variable.noted.append((read,))
    return variable.noted[0]


def notes_of(names: Sequence[str], variables: Mapping[str, Variable]) -> tuple[Read, ...] | None:
    """Return what is noted of each variable; None where there is something to tell of one."""
    found: list[Read] = []
    for name in names:
        variable = variables.get(name)
        if variable is None or variable.leaked_from is not None:
            return None
        read = noted_of(name, variable)
        if read is None:
            return None
        found += read
    return tuple(found)


class Tracing:
    """A while in which what is read in a scope is collected; what is around it gets it too."""

    __slots__ = ("_outer", "_reads", "_scope")

    def __init__(self, scope: Any) -> None:  # noqa: ANN401 - a `Scope`
        self._scope = scope
        self._outer: list[Read] | None = None
        self._reads: list[Read] = []

    def __enter__(self) -> list[Read]:
        self._outer, self._scope._reads = self._scope._reads, self._reads  # noqa: SLF001 - a part of it
        return self._reads

    def __exit__(self, *_: object) -> None:
        self._scope._reads = self._outer  # noqa: SLF001 - as above
        if self._outer is not None:
            self._outer += self._reads


class Variables(Protocol):
    """The launch configurations of the current scope."""

    def get(self, name: str, reader: Location) -> Evaluated | None:
        """Return the value, None where it is unset; `reader` is the place that asks."""

    def known(self, names: Sequence[str]) -> tuple[Read, ...] | None:
        """Return what is noted of each variable, its value with it; None where there is something to tell of one."""

    def names(self) -> tuple[str, ...]:
        """Return the names that are set, for suggestions."""

    def note(self, kind: ReadKind, name: str, value: str) -> None:
        """Note that something other than a launch configuration is read."""

    def removes(self, name: str) -> bool:
        """Return whether the description has removed an environment variable."""

    def tracing(self) -> AbstractContextManager[list[Read]]:
        """Collect what is read meanwhile."""


class Packages(Protocol):
    """Where packages are on this machine."""

    def prefix(self, package: str) -> str | None:
        """Return the install prefix, None for an unknown package."""

    def share(self, package: str) -> str | None:
        """Return the share folder, None for an unknown package."""

    def executable(self, package: str, executable: str) -> tuple[str, ...] | None:
        """Return the words of the command that starts it, None where the package has no such executable."""

    def names(self) -> tuple[str, ...]:
        """Return the names of all packages, for suggestions."""

    def executables(self, package: str) -> tuple[str, ...]:
        """Return the names of the package's executables, for suggestions."""


@dataclass(frozen=True, slots=True)
class CommandResult:
    """What a finished command left behind; `failure` says why where it could not run or ran too long."""

    status: int
    stdout: str
    stderr: str
    failure: str | None = None


CommandRunner: TypeAlias = Callable[[tuple[str, ...], Mapping[str, str]], CommandResult]


def _only_python(part: Opaque) -> Evaluated:
    raise TypeError(f"nobody here can perform {part.target!r}")


@dataclass(slots=True)
class Context:
    """The state in which a text is evaluated.

    `file` is the absolute path of the launch file that is being read, `included_from` the chain of includes to it,
    innermost first. `anonymous` remembers the names that `$(anon)` made. `parameters` are the values that
    `set_parameter` put in scope, for `$(param)`. `launching` is false where nothing will be started here. By the
    `inputs` it weighs more or less that a package, a program or a variable is not here; `elsewhere` are those that were
    told. `lost` has the names that something faulty would have set. `perform_opaque` performs what only Python can.
    """

    problems: Problems
    variables: Variables
    environment: Mapping[str, str]
    packages: Packages
    run_command: CommandRunner
    file: str | None = None
    included_from: tuple[Span, ...] = ()
    log_folder: str = "${run}/logs"
    launching: bool = True
    inputs: Inputs = Inputs({})
    anonymous: dict[str, str] = field(default_factory=dict)
    elsewhere: set[str] = field(default_factory=set)
    parameters: Mapping[str, str] = field(default_factory=dict)
    lost: AbstractSet[str] = frozenset()
    perform_opaque: Callable[[Opaque], Evaluated] = _only_python

    @property
    def weights(self) -> Weights:
        """How much it weighs that this machine lacks what another one may have."""
        return self.inputs.weights

    def at(self, span: Span) -> Location:
        """Return the location of a span of the current file."""
        return new_location(span, self.included_from)

    def place(self, written: Template | Entity) -> Location:
        """Return the location of something in the current file, which is worked out when it is asked for."""
        return written.location(self.included_from)
