"""The plan: everything a run needs to know, as frozen data.

The supervisor reads it as JSON (`orchestra.plan.codec`), so this module needs the standard library alone. Lists are
tuples, mappings are plain dicts that nobody changes. `${run}` in a path stands for the run directory.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from orchestra.dataclass import dataclass, maker
from orchestra.errors import Problem
from orchestra.fields import field
from orchestra.location import Location
from orchestra.plan.conditions import Alive, Dependency, Ready
from orchestra.plan.reactions import Trigger
from orchestra.values import Limits, ParameterValue, Restart, Stop

VERSION = 1

Kind: TypeAlias = Literal["process", "node", "lifecycle_node", "container"]
SkipReason: TypeAlias = Literal["if", "unless"]


@dataclass(frozen=True, slots=True)
class Argument:
    """A launch argument that the description declares. `value` is None where the run needs one and has none.

    `given`: the include of the file that declares it sets it, so that no caller can.
    """

    name: str
    default: str | None
    value: str | None
    description: str | None
    choices: tuple[str, ...] | None
    location: Location
    given: bool = False


@dataclass(frozen=True, slots=True)
class ParameterFile:
    """Parameter sections passed on unchanged for other nodes in the process."""

    path: str
    content: str


@dataclass(frozen=True, slots=True)
class Via:
    """What a value came through: something that was read to make it.

    `setter` says who set it: the `default` of an argument, the argument of an `include`, the `command line`, `let`,
    `for_each`, `environment` and `parameter` of the description, `push` of a namespace, `code` of a launch file, the
    environment of the `caller` (which has no place). What one with a greater `depth` is, was read to make the last one
    before it with a lesser one. A long `value` is cut.
    """

    kind: Literal["variable", "environment", "parameter", "namespace"]
    name: str
    value: str
    setter: str
    location: Location | None
    depth: int


@dataclass(frozen=True, slots=True)
class Candidate:
    """A value somebody wrote for a setting, and whether it is the one that counts.

    `rule` says why it does or does not, `through` what was read to make it (or the path of the file that it stands in),
    outermost first.
    """

    value: ParameterValue | None
    location: Location
    won: bool
    rule: str
    through: tuple[Via, ...] = ()


@dataclass(frozen=True, slots=True)
class Provenance:
    """Where the values of a process were written.

    `naming` has all that was written for its `name` and its `namespace`, `remapping_values` what the two sides of each
    rule came through, `command` what was read to make the words of the command line.
    """

    name: Location | None = None
    namespace: Location | None = None
    parameters: dict[str, tuple[Candidate, ...]] = field(default_factory=dict)
    remappings: tuple[Location, ...] = ()
    environment: dict[str, tuple[Candidate, ...]] = field(default_factory=dict)
    naming: dict[str, tuple[Candidate, ...]] = field(default_factory=dict)
    remapping_values: tuple[tuple[Via, ...], ...] = ()
    command: tuple[Via, ...] = ()
    params_schema: Location | None = None


@dataclass(frozen=True, slots=True)
class Warm:
    """Whether the fork server starts a process, and if not, the `reason`.

    If it does: `target` is the path of a script or the name of a module (`kind`), `interpreter` are the words that
    stand for the first `skip` of the command on the command line that is shown, `executable` is the path by which the
    interpreter is found, `comm` the name of the process (prctl(2), PR_SET_NAME).
    """

    warm: bool
    reason: str | None
    kind: Literal["script", "module"] | None = None
    target: str | None = None
    interpreter: tuple[str, ...] = ()
    executable: str | None = None
    skip: int = 0
    comm: str | None = None


@dataclass(frozen=True, slots=True)
class Process:
    """One process to run.

    `id` is the full node name, else namespace and name or executable, with `#2` for repeats in plan order.
    `command` is the exact argv; with `shell` it is joined with spaces and given to the shell. `environment` holds
    what the description adds (text) or removes (None); without `inherit_environment` it is all that the process gets.
    `parameters` are the node's effective values; the file that carries them is `${run}/params/NAME.yaml` and stands
    in `command`. `output` is a word of the launch language, or the places (`screen`, `log`, `own_log`) by stream
    (`stdout`, `stderr`, `both`). `lifecycle` is the state that a lifecycle node is brought to when it has started.
    `params_schema` is what the description names as the declaration of its parameters.
    """

    id: str
    kind: Kind
    package: str | None
    executable: str
    name: str | None
    namespace: str | None
    command: tuple[str, ...]
    shell: bool
    prefix: tuple[str, ...]
    environment: dict[str, str | None]
    inherit_environment: bool
    cwd: str | None
    parameters: dict[str, ParameterValue]
    parameter_files: tuple[ParameterFile, ...]
    remappings: tuple[tuple[str, str], ...]
    arguments: tuple[str, ...]
    output: str | dict[str, tuple[str, ...]] | None
    emulate_tty: bool | None
    stdin: bool | None
    restart: Restart | None
    required: bool
    success_exit_codes: tuple[int, ...] | None
    ready: Ready | None
    alive: Alive | None
    lifecycle: Literal["active"] | None
    depends_on: tuple[Dependency, ...]
    stop: Stop | None
    limits: Limits | None
    warm: Warm | None
    machine: None
    digest: str
    location: Location
    provenance: Provenance
    params_schema: str | None = None


@dataclass(frozen=True, slots=True)
class Skipped:
    """An action that its condition left out; `expression` is the condition as written, `value` what it came to."""

    action: str
    name: str | None
    condition: SkipReason
    expression: str
    value: str
    location: Location


@dataclass(frozen=True, slots=True)
class Component:
    """A component to load into a container.

    `id` is as that of a process. `container` is the full name of the container's node, `process` the id of the
    process that is it, None where it is none of this plan. `condition` is `started` where the component is loaded as
    soon as the container takes orders, `event` where a trigger loads it. `extra_arguments` go along with the request
    (`use_intra_process_comms`). `lifecycle` is the state that it is brought to when it has been loaded.
    """

    id: str
    name: str | None
    namespace: str | None
    package: str
    plugin: str
    container: str
    process: str | None
    condition: Literal["started", "event"]
    parameters: dict[str, ParameterValue]
    remappings: tuple[tuple[str, str], ...]
    extra_arguments: dict[str, ParameterValue]
    lifecycle: Literal["active"] | None
    location: Location
    provenance: Provenance
    params_schema: str | None = None


@dataclass(frozen=True, slots=True)
class Plan:
    """What a run will do."""

    version: int
    file: str
    arguments: tuple[Argument, ...]
    processes: tuple[Process, ...]
    components: tuple[Component, ...]
    triggers: tuple[Trigger, ...]
    skipped: tuple[Skipped, ...]
    problems: tuple[Problem, ...]


def _postponed(record: type, name: str) -> None:
    """Let a field be made when it is first read: what stands there until then is called with the record."""
    slot = vars(record)[name]
    kept, keep = slot.__get__, slot.__set__

    def read(owner: object) -> object:
        value = kept(owner)
        if callable(value):
            value = value(owner)
            keep(owner, value)
        return value

    setattr(record, name, property(read, keep))


# What a run asks for, and hardly anybody who only looks at a plan; where something was written, most ask neither.
_postponed(Process, "digest")
_postponed(Process, "provenance")
_postponed(Component, "provenance")
_postponed(ParameterFile, "content")


# What a plan has many of.
new_process = maker(Process)
new_component = maker(Component)
new_file = maker(ParameterFile)
new_candidate = maker(Candidate)
new_via = maker(Via)
