"""`PythonExpression`: the result of a Python expression."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from orchestra.compat.calculating import Calculating, plain
from orchestra.compat.calls import own
from orchestra.compat.described import described
from orchestra.compat.expressions import visible
from orchestra.compat.launch.utilities.perform_substitutions_impl import perform_substitutions
from orchestra.compat.performed import Concatenated
from orchestra.compat.place import IN_CONSTRUCTOR, here
from orchestra.compat.seam import connection, is_connected
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub

_MATH = ("math",)


class PythonExpression(Calculating):
    """The `str` of the result. The expression is unrestricted and sees some modules, `math` without a prefix too."""

    _name = "eval"
    _parameters = ("expression", "python_modules")
    __expression: list[Substitution] = own()
    __python_modules: list[Substitution] = own()

    def __init__(self, expression: Sub, python_modules: Sub = _MATH) -> None:
        self._place = here(self, IN_CONSTRUCTOR)
        self.__expression = normalized(expression)
        self.__python_modules = normalized(python_modules)
        self.__is_default = python_modules in (_MATH, list(_MATH), "math")

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[Self], dict[str, Any]]:
        """Return the class and the keywords of its constructor; the modules stand in one text, with commas."""
        _, keywords = super().parse(data)
        keywords["expression"] = data[0]
        if len(data) > 1:
            keywords["python_modules"] = Concatenated(normalized(data[1]))
        return cls, keywords

    @property
    def expression(self) -> list[Substitution]:
        """The expression."""
        return self.__expression

    @property
    def python_modules(self) -> list[Substitution]:
        """The modules that it sees."""
        return self.__python_modules

    def describe(self) -> str:
        """Return the expression and the modules."""
        modules = ", ".join(item.describe() for item in self.python_modules)
        return f"PythonExpr({described(self.expression)}, [{modules}])"

    def perform(self, context: LaunchContext) -> str:
        """Return the result. Raises whatever the expression does, as upstream."""
        expression = perform_substitutions(context, self.expression).strip()
        modules = perform_substitutions(context, self._listed())
        if is_connected():
            connection().prepare()  # code that only makes expressions is known to change nothing
        return str(eval(expression, visible(modules)))  # noqa: S307 - unrestricted Python is what it is

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.expression,) if self.__is_default else (self.expression, self._listed())

    def _listed(self) -> list[Substitution]:
        """Return the modules as one text, with commas."""
        return normalized(_with_commas(self.python_modules))


plain.add(PythonExpression)


def _with_commas(modules: Iterable[Substitution]) -> Iterable[str | Substitution]:
    for index, module in enumerate(modules):
        if index:
            yield ","
        yield module
