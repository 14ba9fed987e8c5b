"""What holds inside of an action, because its condition is true."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.location import Location
from orchestra.resolve.context import Evaluated, Variable

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.location import Span
    from orchestra.resolve.scope import Scope

# A text as far as comparing goes: its constant words, and the names and arguments of its substitutions.
Form: TypeAlias = tuple["str | tuple[str, tuple[Form, ...]]", ...]


@dataclass(frozen=True, slots=True)
class Said:
    """A text that is true, or false.

    `compared` is the constant that a text is equal to, for a condition that compares. `values` are those of the
    variables in it when it was evaluated; `location` tells where.
    """

    form: Form
    truth: bool
    compared: str | None
    values: tuple[tuple[str, Evaluated | None], ...]
    location: Location


class Held:
    """A condition that has just been evaluated, in a file that the includes `chain` have led to.

    What it says is worked out where that is asked for, which few conditions ever are: `said` has it then.
    """

    __slots__ = ("_mark", "_scope", "chain", "said", "template", "truth")

    def __init__(self, template: Template, chain: tuple[Span, ...], scope: Scope, *, truth: bool) -> None:
        self.template = template
        self.chain = chain
        self.truth = truth
        self.said: tuple[Said | None] | None = None
        self._scope = scope
        self._mark = scope.mark()

    def value(self, name: str) -> Evaluated | None:
        """Return the value that a variable had then, None where it was unset."""
        variables = self._scope.variables
        variable = variables.get(name)
        for table, changed, earlier in self._scope._journal[self._mark :]:  # noqa: SLF001 - a mark is a place in it
            if table is variables and changed == name:
                variable = earlier if isinstance(earlier, Variable) else None
                break
        return None if variable is None else variable.value
