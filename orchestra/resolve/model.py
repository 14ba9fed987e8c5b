"""What a description comes to: no substitution left, every value with the place that set it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from orchestra.dataclass import dataclass, leave_open, maker
from orchestra.description.text import Constant, Items, Template, span_of
from orchestra.fields import field
from orchestra.load.offsets import is_on_one_line
from orchestra.location import Location, Span, new_location
from orchestra.resolve.awaited import ResolvedAlive, ResolvedReady
from orchestra.resolve.context import Read, Value
from orchestra.resolve.rcl.sections import Entry, Section
from orchestra.resolve.reactions import ResolvedTrigger
from orchestra.values import Condition, Limits, ParameterValue, Restart, Stop

if TYPE_CHECKING:
    from orchestra.description.entity import Entity

DependencyKind: TypeAlias = Literal["node", "process", "label", "action"]
Kind: TypeAlias = Literal["process", "node", "lifecycle_node", "container"]


@dataclass(frozen=True, slots=True)
class ResolvedArgument:
    """A declared launch argument; `value` is None where it is required and was not given.

    `given`: the include of its file sets it, so that no caller can.
    """

    name: str
    default: str | None
    value: str | None
    description: str | None
    choices: tuple[str, ...] | None
    location: Location
    given: bool = False


class _Written:
    """What is written, where the places of something are not worked out yet."""

    __slots__ = ("_written",)


@dataclass(frozen=True, slots=True)
class InlineParameter(_Written):
    """A parameter written in the description; `everywhere` where it was set for all nodes of a scope.

    `keys` are the names it is written with, from the outermost level inwards: each as far as it goes, and its place.
    `items` are the places of a list's items, as far as they are known. Few places are asked for: see `plainly`.
    """

    name: str
    value: ParameterValue
    location: Location
    everywhere: bool = False
    keys: tuple[tuple[str, Location], ...] = ()
    items: tuple[Location, ...] = ()
    through: tuple[Read, ...] = field(default=(), compare=False, repr=False)

    if not TYPE_CHECKING:  # for type checkers there are the fields above and no others

        def __getattr__(self, name: str) -> object:
            if name not in ("items", "keys", "location"):
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            param, chain = self._written
            items = param.value if isinstance(param.value, Items) else ()
            object.__setattr__(self, "location", place_of(param.value, param, chain))
            object.__setattr__(self, "keys", ((self.name, param.name.location(chain)),))
            object.__setattr__(self, "items", tuple([item.location(chain) for item in items]))
            return object.__getattribute__(self, name)


def place_of(
    value: Template | Constant | tuple[Template | Constant, ...] | None,
    param: Entity,
    chain: tuple[Span, ...],
) -> Location:
    """Return where a value stands: all of a list that is on one line, else its first item."""
    if isinstance(value, Template):
        return value.location(chain)
    at = value.span if isinstance(value, Items) and is_on_one_line(value.span) else span_of(value or ())
    return new_location(at or param.span, chain)


@dataclass(frozen=True, slots=True)
class FileParameters(_Written):
    """The sections of a parameter file, as far as it could be read; `everywhere` as with a single parameter.

    `plain` are the parameters of a file that has no sections at all, which only components take. `through` is what was
    read to make its path, `within` what was read for the substitutions in it, by their places. One that is not `sound`
    has values that could not be read.
    """

    path: str
    sections: tuple[Section, ...]
    location: Location
    everywhere: bool = False
    plain: tuple[Entry, ...] = ()
    through: tuple[Read, ...] = field(default=(), compare=False, repr=False)
    within: tuple[tuple[Span, tuple[Read, ...]], ...] = field(default=(), compare=False, repr=False)
    sound: bool = True

    if not TYPE_CHECKING:  # as above: what is written is the value that is the path

        def __getattr__(self, name: str) -> object:
            if name != "location":
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            object.__setattr__(self, name, self._written.location)
            return self.location


@dataclass(frozen=True, slots=True)
class ResolvedRemap:
    """One remapping rule."""

    source: Value
    target: Value

    @property
    def texts(self) -> tuple[str, str]:
        """Both sides."""
        return self.source.text, self.target.text


# What a resolution makes thousands of; processes are filled in where they are made.
new_parameter = maker(InlineParameter)
new_file = maker(FileParameters)
new_remap = maker(ResolvedRemap)

ParameterSource: TypeAlias = InlineParameter | FileParameters


@dataclass(frozen=True, slots=True)
class NamedSchema:
    """What a node names as the declaration of its parameters: the file at `path`, or a `model` that code has defined.

    `text` is the name as it is written.
    """

    text: str
    location: Location
    path: str | None = None
    model: Any = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class ResolvedDependency:
    """What a process waits for, by name; the plan finds the processes.

    `action` is the object of a Python launch file, every process that comes out of which is meant; `name` then only
    serves people.
    """

    kind: DependencyKind
    name: Value
    condition: Condition
    timeout: float | None
    required: bool = True
    action: Any = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class EnvironmentChange:
    """An environment variable that the description sets, or removes where `value` is None."""

    value: str | None
    location: Location
    through: tuple[Read, ...] = field(default=(), compare=False, repr=False)


@dataclass(frozen=True, kw_only=True)
class ResolvedProcess:
    """One process. `program` starts it; a node's arguments and ROS arguments are added by the plan.

    It has no slots: few say more than a third of it, and what is not said is as the class has it. How it runs is filled
    in by `add_process`, before anybody else has it. `conditional` tells that a condition, which is true, stands on it
    or around it. `faulty` marks a process of which something has been reported: what follows from it is not reported
    again. `parameter_arguments` are what the node's own arguments say of its parameters, on the command line before
    `parameters`, and so many of the first `remaps` stand there. Without `inherit_environment` it gets nothing but
    `environment`. `stdin` is the place that says that it reads what is typed. `through` was read to make the words of
    its command line. `share` is the share folder of its package, where that is here. `origin` is the object of a Python
    launch file that made it, `around` are those that it came out of, this one included.
    """

    kind: Kind
    executable: str
    program: tuple[str, ...]
    location: Location
    package: str | None = None
    name: Value | None = None
    namespace: Value | None = None
    label: str | None = None
    arguments: tuple[str, ...] = ()
    ros_arguments: tuple[str, ...] | None = None
    parameters: tuple[ParameterSource, ...] = ()
    parameter_arguments: tuple[FileParameters, ...] = ()
    remaps: tuple[ResolvedRemap, ...] = ()
    remaps_among_words: int = 0
    autostart: bool = False
    through: tuple[Read, ...] = field(default=(), compare=False, repr=False)
    params_schema: NamedSchema | None = None
    share: str | None = None
    faulty: bool = False
    prefix: tuple[str, ...] = ()
    shell: bool = False
    cwd: str | None = None
    environment: Mapping[str, tuple[EnvironmentChange, ...]] = field(default_factory=dict)
    inherit_environment: bool = True
    output: str | dict[str, tuple[str, ...]] | None = None
    emulate_tty: bool | None = None
    restart: Restart | None = None
    required: bool = False
    shutdown_on_exit: bool = False
    success_exit_codes: tuple[int, ...] | None = None
    ready: ResolvedReady | None = None
    alive: ResolvedAlive | None = None
    stop: Stop | None = None
    depends_on: tuple[ResolvedDependency, ...] = ()
    labels: tuple[str, ...] = ()
    conditional: bool = False
    limits: Limits | None = None
    stdin: Location | None = None
    warm: bool | None = None
    origin: Any = field(default=None, compare=False, repr=False)
    around: tuple[Any, ...] = field(default=(), compare=False, repr=False)


leave_open(ResolvedProcess)


@dataclass(frozen=True, slots=True, kw_only=True)
class ResolvedComponent:
    """A component to load into a container.

    The container is known by its full name, by the index of its process, or by the object of a Python launch file that
    starts it. `delayed`: it is
    not loaded with the start of its container but where a `ResolvedLoad` says so.
    """

    package: str
    plugin: str
    name: Value | None
    namespace: Value | None
    container: Value | None
    container_process: int | None
    container_origin: Any = field(default=None, compare=False, repr=False)
    parameters: tuple[ParameterSource, ...]
    extra_arguments: tuple[ParameterSource, ...]
    remaps: tuple[ResolvedRemap, ...]
    autostart: bool
    delayed: bool
    location: Location
    conditional: bool
    faulty: bool
    params_schema: NamedSchema | None = None
    share: str | None = None
    origin: Any = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class ResolvedSkip:
    """An action that its condition left out."""

    action: str
    name: str | None
    condition: Literal["if", "unless"]
    expression: str
    value: str
    location: Location


@dataclass(frozen=True, slots=True)
class GivenSections:
    """Parameters of the command line, which win over all others. `strict`: it is an error if they are for no node."""

    sections: tuple[Section, ...]
    location: Location
    strict: bool


@dataclass(frozen=True, slots=True)
class Resolved:
    """Everything a description comes to.

    `lost` has the words of what has been left out for its faults, `incomplete` tells that whole files are missing.
    """

    file: str
    arguments: tuple[ResolvedArgument, ...]
    processes: tuple[ResolvedProcess, ...]
    triggers: tuple[ResolvedTrigger, ...]
    skipped: tuple[ResolvedSkip, ...]
    given: tuple[GivenSections, ...]
    lost: frozenset[str] = frozenset()
    incomplete: bool = False
    components: tuple[ResolvedComponent, ...] = ()
