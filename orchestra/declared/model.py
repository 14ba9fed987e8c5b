"""Parameters as a node declares them, and what can be wrong with values for them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Protocol, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.declared.rules import Rule
from orchestra.values import ParameterValue

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

RosType: TypeAlias = Literal[
    "bool",
    "integer",
    "double",
    "string",
    "byte_array",
    "bool_array",
    "integer_array",
    "double_array",
    "string_array",
]
FaultKind: TypeAlias = Literal["undeclared", "type", "value", "missing"]
# What becomes of a parameter that is given and that nobody declares: `ignored` where the schema does not say.
Undeclared: TypeAlias = Literal["refused", "ignored", "allowed"]


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter; a `name` with `{}` stands for one of each item of the lists that `keys` name, in their order.

    `types` are those that the node takes, all where there are none; of those that are `tolerated` the schema says
    nothing, but a node that declares one of `types` refuses them. `required`: it has no default, or none that it takes.
    """

    name: str
    types: tuple[RosType, ...] = ()
    tolerated: tuple[RosType, ...] = ()
    required: bool = False
    default: ParameterValue | None = None
    description: str = ""
    read_only: bool = False
    rules: tuple[Rule, ...] = ()
    keys: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Declarations:
    """All parameters of a node.

    `patterns` are regular expressions that are searched for in whole names; all that are found apply. Whatever is below
    one of the `groups` is declared by somebody else.
    """

    parameters: tuple[Parameter, ...]
    patterns: tuple[tuple[str, Parameter], ...] = ()
    groups: tuple[str, ...] = ()
    undeclared: Undeclared = "refused"


@dataclass(frozen=True, slots=True)
class Fault:
    """What is wrong with the parameters of a node.

    `name` is that of the parameter, or of the group, that is meant; `item` the index of an item of a list. `meant` is
    the value or the name that should stand there, as YAML has it. What is not `certain` may be as it is to be; what
    is `whole` is about all values, and nothing where one is given that is not known. `source` is the program in whose
    code it is so, where neither the description nor the package has a schema.
    """

    kind: FaultKind
    name: str
    told: str
    meant: str | None = None
    item: int | None = None
    certain: bool = True
    whole: bool = False
    source: str | None = None


class ParameterSchema(Protocol):
    """What a node takes as parameters, however that is written."""

    def faults(self, values: Mapping[str, ParameterValue]) -> Iterable[Fault]:
        """Return what is wrong with values by dotted name."""
