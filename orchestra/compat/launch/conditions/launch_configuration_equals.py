"""`LaunchConfigurationEquals`: holds where a launch configuration has a value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.described import described
from orchestra.compat.launch.condition import Condition
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.launch.utilities.perform_substitutions_impl import perform_substitutions
from orchestra.compat.place import here
from orchestra.compat.refusing import collector
from orchestra.compat.text import normalized, template
from orchestra.description.text import Call, Opaque, Template
from orchestra.errors import Code
from orchestra.location import Location
from orchestra.nearest import is_slip, nearest

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.text import Sub
    from orchestra.location import Span


class LaunchConfigurationEquals(Condition):
    """Holds where the configuration is exactly the text; None: where it is not set.

    Upstream warns that it is deprecated; launch files are full of it, so it is silent here.
    """

    _wanted = True

    def __init__(self, launch_configuration_name: str, expected_value: Sub | None) -> None:
        self.__name = launch_configuration_name
        self.__expected = None if expected_value is None else normalized(expected_value)
        self.__place = here(self)
        super().__init__(predicate=self._predicate_func)

    def describe(self) -> str:
        """Return the name and the value."""
        expected = "None" if self.__expected is None else described(self.__expected)
        return f"{type(self).__name__}('{self.__name}', {expected})"

    def _predicate_func(self, context: LaunchContext) -> bool:
        value: Any = context.launch_configurations.get(self.__name)
        if not isinstance(self.__name, str):
            self.__report_value()
        elif value is None and self.__expected is not None:
            self.__report_slip(context)
        expected = None if self.__expected is None else perform_substitutions(context, self.__expected)
        return (value == expected) is self._wanted

    def __report_slip(self, context: LaunchContext) -> None:
        """Warn of a configuration that is not set and whose name is a slip for one that is."""
        meant, collecting = nearest(self.__name, context.launch_configurations), collector()
        if collecting is None or meant is None or not is_slip(self.__name, meant):
            return
        problems, chain = collecting
        told = f"no launch argument or variable '{self.__name}' is set here: the condition is always the same"
        at = Location(self.__place.at("launch_configuration_name"), chain)
        problems.warning(Code.UNDEFINED_VARIABLE, told, at, suggestion=meant)

    def __report_value(self) -> None:
        """Warn of what gives the value of a configuration where its name is meant: none is called like that object."""
        # Here, because only mistakes need it, and what it imports.
        from orchestra.compat.rewritten import Rewritten  # noqa: PLC0415

        collecting = collector()
        if collecting is None:
            return
        problems, chain = collecting
        argument = self.__place.at("launch_configuration_name")
        parts: Any = getattr(self.__name, "variable_name", ())
        name = parts[0].text if len(parts) == 1 and isinstance(parts[0], TextSubstitution) else None
        told = "the name of a launch argument or variable is wanted here: the condition is always the same"
        meant = None if name is None else Rewritten(repr(name))
        problems.warning(Code.UNDEFINED_VARIABLE, told, Location(argument, chain), suggestion=meant)

    def _fields(self, span: Span) -> dict[str, Any]:
        """Return an opaque text, of which it is known what it reads: equality of booleans is another thing."""
        (part,) = super()._fields(span)["if"].parts
        name = template(self.__name, span)
        inside = [Template((Call("var", (name, Template((), "", span)), span),), self.describe(), span)]
        if self.__expected is not None:
            inside.append(template(self.__expected, span))
        return {"if": Template((Opaque(part.target, span, tuple(inside)),), self.describe(), span)}
