"""`ForEachVar` and `ForLoopIndex`: the value of one turn of a loop (newer ROS releases)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from orchestra.compat.described import described
from orchestra.compat.launch.utilities.perform_substitutions_impl import perform_substitutions
from orchestra.compat.performed import PerformedSubstitution
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Self

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class ForEachVar(PerformedSubstitution):
    """The value of a variable in the turn that is going on, else the default. `ForEach` puts it among the locals."""

    _parameters: ClassVar[tuple[str, ...]] = ("name", "default_value")

    def __init__(self, name: Sub, *, default_value: Sub | None = None) -> None:
        super().__init__()
        self.__name = normalized(name)
        self.__default_value = None if default_value is None else normalized(default_value)

    @classmethod
    def parse(cls, data: Sequence[Sub]) -> tuple[type[Self], dict[str, Any]]:
        """Return the class and the keywords of its constructor. Raises `TypeError` for too few or too many."""
        if not 0 < len(data) <= len(cls._parameters):
            raise TypeError(
                f"{cls.__name__} takes {' and '.join(cls._parameters)}, found {len(data)} arguments"
            )
        return cls, dict(zip(cls._parameters, data, strict=False))

    @staticmethod
    def get_local_arg_name(name: str) -> str:
        """Return the name of the local that holds the variable."""
        return f"ForEachVar__{name}"

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    @property
    def default_value(self) -> list[Substitution] | None:
        """What stands for a variable without a value, None: that is an error."""
        return self.__default_value

    def describe(self) -> str:
        """Return the name and the default."""
        default = described(self.default_value or [])
        return f"{type(self).__name__}(name={described(self.name)}, default_value={default})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value. Raises `RuntimeError` where there is none, and no default."""
        name = perform_substitutions(context, self.name)
        known = context.get_locals_as_dict()
        local = self.get_local_arg_name(name)
        if local in known:
            return str(known[local])
        if self.default_value is None:
            raise RuntimeError(f"the loop has no value for '{name}', and there is no default")
        return perform_substitutions(context, self.default_value)

    def _made_of(self) -> Sequence[Sequence[Substitution]]:
        return (self.name, self.default_value or ())


class ForLoopIndex(ForEachVar):
    """The index of the turn of a `ForLoop`."""

    _parameters = ("name",)

    def __init__(self, name: Sub) -> None:
        super().__init__(name)
