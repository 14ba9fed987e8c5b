"""Parts that several actions share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, ClassVar, Final, TypeAlias, TypeVar

from orchestra.description.conflict import Conflict
from orchestra.description.entity import Entity, set_beside, set_values
from orchestra.description.fields import AnyValue, Flag, Seconds, Text, word, worded
from orchestra.description.marks import Plain
from orchestra.description.model import Model, field
from orchestra.description.ranges import BUDGET, GROWTH, SHARE
from orchestra.description.text import Template

CONDITIONS = ("started", "ready", "completed", "exited")
POLICIES = ("no", "on-failure", "always")
VALUE_TYPES = (
    "str",
    "bool",
    "int",
    "float",
    "list_of_str",
    "list_of_bool",
    "list_of_int",
    "list_of_float",
    "yaml",
)

# The words of ROS, of C++ and of JSON for these types.
_TYPES_ELSEWHERE = {
    "string": "str",
    "text": "str",
    "boolean": "bool",
    "integer": "int",
    "double": "float",
    "number": "float",
    "str[]": "list_of_str",
    "bool[]": "list_of_bool",
    "int[]": "list_of_int",
    "float[]": "list_of_float",
    "string[]": "list_of_str",
    "integer[]": "list_of_int",
    "double[]": "list_of_float",
    "boolean[]": "list_of_bool",
    "list[str]": "list_of_str",
    "list[bool]": "list_of_bool",
    "list[int]": "list_of_int",
    "list[float]": "list_of_float",
    "string_array": "list_of_str",
    "bool_array": "list_of_bool",
    "integer_array": "list_of_int",
    "double_array": "list_of_float",
    "list_of_string": "list_of_str",
    "list_of_double": "list_of_float",
}

# The words of container engines and of service managers.
_CONDITIONS_ELSEWHERE = {
    "done": "completed",
    "finished": "completed",
    "healthy": "ready",
    "process_completed": "exited",
    "process_completed_successfully": "completed",
    "process_healthy": "ready",
    "process_started": "started",
    "running": "started",
    "service_completed_successfully": "completed",
    "service_healthy": "ready",
    "service_started": "started",
    "succeeded": "completed",
}
_POLICIES_ELSEWHERE = {
    "false": "no",
    "never": "no",
    "on-abnormal": "on-failure",
    "on_error": "on-failure",
    "true": "always",
    "unless-stopped": "always",
    "yes": "always",
}

TypeWord: TypeAlias = Annotated[
    Template, Plain(word(*VALUE_TYPES, elsewhere=_TYPES_ELSEWHERE)), worded(*VALUE_TYPES)
]


class Pair(Entity):
    """A name and a value."""

    name: Text = field(description="The name.")
    value: Text = field(description="The value.")


class Remap(Entity):
    """One remapping rule of a topic, a service or an action."""

    from_: Text = field(alias="from", description="The name that the node uses.")
    to: Text = field(description="The name that it shall use instead.")


class Param(Entity):
    """A parameter: a name with a value, a name with nested parameters, or a file (`from`)."""

    name: Text | None = field(
        default=None, description="Name of the parameter, or of the level above `param`."
    )
    value: AnyValue | None = field(default=None, description="A scalar or a list of scalars of one type.")
    type: TypeWord | None = field(
        default=None, description="Read the value as this type instead of by its looks."
    )
    param: tuple[Param, ...] | None = field(default=None, description="Nested parameters.")
    from_: Text | None = field(default=None, alias="from", description="A parameter file.")
    allow_substs: Flag | None = field(default=None, description="Whether `$(...)` in the file is evaluated.")

    def conflict(self) -> Conflict | None:
        """Return what keeps this from being one of the three forms."""
        forms = (self.value is not None) + (self.param is not None) + (self.from_ is not None)
        if forms != 1:
            return Conflict(
                "a param has one of `value`, `param` and `from`", ("value", "param", "from") if forms else ()
            )
        if (self.name is None) != (self.from_ is not None):
            return Conflict(
                "a param has either a `name` or a file (`from`)",
                () if self.name is None else ("name", "from"),
            )
        if self.allow_substs is not None and self.from_ is None:
            return Conflict("`allow_substs` goes with `from`", ("allow_substs",))
        typeless = self.type is not None and self.value is None
        return Conflict("`type` goes with `value`", ("type",)) if typeless else None


class Late:
    """A part that is known by its two sides, and becomes an ordinary one when somebody asks for anything of it.

    Its row has the two, each a literal or a text, then what makes fields of the row, and what is known beside them.
    """

    __slots__ = ()

    ordinary: ClassVar[type[Entity]]

    def __getattribute__(self, name: str) -> Any:  # noqa: ANN401 - any attribute
        kind: Any = type(self)
        row = row_of(self)
        object.__setattr__(self, "__class__", kind.ordinary)
        made: Any = self
        values, beside = row[2](row)
        set_values(made, values)
        set_beside(made, beside)
        return getattr(made, name)

    def __hash__(self) -> int:
        return self.__hash__()


class LateRemap(Late, Remap):
    """A rule by its two sides."""

    __slots__ = ()

    ordinary = Remap


class LateParam(Late, Param):
    """A parameter by its name, and a value that has its type or is a text."""

    __slots__ = ()

    ordinary = Param


_LateT = TypeVar("_LateT", LateRemap, LateParam)
_new: Final = object.__new__
_set_row: Final[Callable[[Any, tuple[Any, ...]], None]] = vars(Model)["__pydantic_extra__"].__set__
row_of: Final[Callable[[Any], tuple[Any, ...]]] = vars(Model)["__pydantic_extra__"].__get__


def late(kind: type[_LateT], row: tuple[Any, ...]) -> _LateT:
    """Return a part of which only the row is known."""
    made = _new(kind)
    _set_row(made, row)
    return made


class Override(Param):
    """A parameter that upstream hands over as `-p`, which is for every node in the process (`Parameter` in Python)."""


class DependsOn(Entity):
    """Something that must have come about before this process starts."""

    node: Text | None = field(
        default=None, description="A node, by its name seen from this node's namespace."
    )
    process: Text | None = field(default=None, description="A process, by its name.")
    label: Text | None = field(default=None, description="Every process of the include with this label.")
    condition: (
        Annotated[Template, Plain(word(*CONDITIONS, elsewhere=_CONDITIONS_ELSEWHERE)), worded(*CONDITIONS)]
        | None
    ) = field(default=None, description="What is waited for; `started` where nothing is said.")
    timeout: Seconds | None = field(default=None, description="How long to wait, in seconds.")
    required: Flag | None = field(
        default=None,
        description="Whether it starts only then; else it starts too once that cannot come about.",
    )

    def conflict(self) -> Conflict | None:
        """Return what keeps this from naming one thing."""
        targets = sum(target is not None for target in (self.node, self.process, self.label))
        if targets == 1:
            return None
        too_many = ("node", "process", "label") if targets else ()
        return Conflict("a dependency names one of `node`, `process` and `label`", too_many)


class Restart(Entity):
    """When an ended process is started again."""

    policy: Annotated[Template, Plain(word(*POLICIES, elsewhere=_POLICIES_ELSEWHERE)), worded(*POLICIES)] = (
        field(description="`no`, after a failure alone, or whenever it ends.")
    )
    delay: Seconds | None = field(default=None, description="Least delay before a new start, in seconds.")
    max_delay: Seconds | None = field(
        default=None, description="What the growing delay stops at, in seconds."
    )
    min_uptime: Seconds | None = field(
        default=None, description="A run this long resets the delay, in seconds."
    )
    growth: Annotated[Template, GROWTH] | None = field(
        default=None, description="Factor from one delay to the next; 2 where absent."
    )
    jitter: Annotated[Template, SHARE] | None = field(
        default=None, description="Share of a delay that is added at random, at most; from 0 to 1."
    )
    budget: Annotated[Template, BUDGET] | None = field(
        default=None, description="How often it may start again; for ever where absent."
    )


class Stop(Entity):
    """How a process is ended."""

    signal: Text | None = field(default=None, description="First signal; SIGINT where absent.")
    timeout: Seconds | None = field(default=None, description="Seconds until SIGTERM follows.")
    kill_timeout: Seconds | None = field(
        default=None, description="Seconds from SIGTERM until SIGKILL follows."
    )
