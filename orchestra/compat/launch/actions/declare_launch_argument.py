"""`DeclareLaunchArgument`: declares a launch argument."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.explanation import told
from orchestra.compat.launch.plain_action import PlainAction, is_text, text_at
from orchestra.compat.text import Sub, normalized, template
from orchestra.compat.values import optional, written
from orchestra.compat.wrong import WrongRuntime, WrongType
from orchestra.description.actions.arg import Arg
from orchestra.errors import Code
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.place import Arguments
    from orchestra.description.entity import Action as Model


_TEXTS: Final = frozenset({"name", "default_value", "description"})
_OPTIONAL: Final = frozenset({"default_value", "description", "choices"})
_ONE_TEXT: Final = "the choices of a launch argument are a list of texts, this is {!r}"


class DeclareLaunchArgument(PlainAction):
    """Declare an argument of the launch file; a value that somebody has set before is kept.

    Raises `RuntimeError` for no choices, and for a default that is none of them.
    """

    _role = "declaration"
    _plain = (1, ("name", "default_value", "description", "choices"))

    def __init__(
        self,
        name: str,
        *,
        default_value: Sub | float | None = None,
        description: str | None = None,
        choices: Iterable[str] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        if not isinstance(name, str):
            raise WrongType(f"the name of a launch argument is a text, this is {told(name)}", path=("name",))
        self.__name = name
        self.__default_value = None if default_value is None else normalized(_text(default_value))
        self.__choices = None if choices is None else _listed(choices)
        self.__description = _described(description, self.__choices)
        self.__given_description = description
        # Whether a condition decides on the declaration, as `get_launch_arguments` has found.
        self._conditionally_included = False
        _check(name, default_value, self.__choices, choices)
        if isinstance(choices, str):
            from orchestra.compat.remarks import remark_of_value  # noqa: PLC0415 - only mistakes need it

            remark_of_value(_ONE_TEXT.format(choices), choices, self._place, "choices")
        if isinstance(default_value, int | float):
            from orchestra.compat.remarks import remark_of_value  # noqa: PLC0415 - only mistakes need it

            message = (
                f"the default of a launch argument is a text, this is {default_value!r}: ROS 2 refuses it"
            )
            remark_of_value(message, default_value, self._place, "default_value")

    @property
    def name(self) -> str:
        """The name."""
        return self.__name

    @property
    def default_value(self) -> list[Substitution] | None:
        """The value where nobody sets one."""
        return self.__default_value

    @property
    def description(self) -> str:
        """What it is for, and the choices."""
        return self.__description

    @property
    def choices(self) -> list[str] | None:
        """The values that it may have."""
        return self.__choices

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Declare the argument. Raises `RuntimeError` where it has no value, nor one that it may have."""
        super().execute(context)
        if self.name not in context.launch_configurations:
            raise RuntimeError(f"the launch argument '{self.name}' has neither a value nor a default")
        return None

    def _is_plain(self, given: dict[str, Any]) -> bool:
        if type(given.get("name")) is not str:
            return False
        for name, value in given.items():
            if type(value) is str and name in _TEXTS:
                continue
            if value is None and name in _OPTIONAL:
                continue
            if name == "default_value" and is_text(given, name):
                continue
            if name != "choices" or type(value) is not list or not value or {*map(type, value)} != {str}:
                return False
            given[name] = value.copy()
            default = given.get("default_value")
            if type(default) is str and default not in value:
                return False
        return True

    def _read(self, given: dict[str, Any], call: Arguments) -> tuple[type[Model], dict[str, Any]]:
        fields: dict[str, Any] = {"name": text_at(given["name"], call, "name")}
        default, description = given.get("default_value"), given.get("description")
        if default is not None:
            fields["default"] = text_at(default, call, "default_value")
        if description is not None:
            fields["description"] = text_at(description, call, "description")
        listed = given.get("choices")
        if listed is not None:
            choices = [text_at(choice, call, "choices", index) for index, choice in enumerate(listed)]
            fields["choices"] = tuple(choices)
        return Arg, fields

    def _made(self, common: Mapping[str, Any]) -> Model:
        place = self._place
        choices = None
        if self.choices is not None:
            listed = enumerate(self.choices)
            choices = tuple(template(choice, place.at("choices", index)) for index, choice in listed)
        fields: dict[str, Any] = {
            "name": template(self.name, place.at("name")),
            "default": optional(self.default_value, place.at("default_value")),
            "description": optional(self.__given_description, place.at("description")),
            "choices": choices,
        }
        if len(common) > 1 or choices == ():
            return Arg.at(place.span, **fields, **common)
        return Arg.made(place.span, fields, common["origin"])


def _text(default: Any) -> Sub:
    """Return a default as substitutions; truth values are spelt as Python does."""
    return str(default) if isinstance(default, bool) else written(default)


def _listed(choices: Iterable[str]) -> list[str]:
    """Return choices as a list; a text that is one in all but its brackets (`"'a', 'b'"`) is what it lists.

    Upstream takes any part of such a text, so that those launch files run.
    """
    if not isinstance(choices, str):
        return list(choices)
    from orchestra.compat.quoted import quoted  # noqa: PLC0415 - only mistakes need it

    return quoted(choices) or list(choices)


def _check(name: str, default: Any, choices: list[str] | None, given: Any) -> None:
    if choices is None:
        return
    if isinstance(given, str) and choices == list(given):
        raise WrongType(_ONE_TEXT.format(given), path=("choices",))
    if not choices:
        raise WrongRuntime(f"the launch argument '{name}' has no choice at all", path=("choices",))
    if isinstance(default, str) and default not in map(str, choices):
        raise WrongRuntime(
            f"the default '{default}' of the launch argument '{name}' is none of {choices}",
            code=Code.NOT_A_CHOICE,
            path=("default_value",),
            suggestion=nearest(default, filter(lambda choice: isinstance(choice, str), choices)),
        )


def _described(description: str | None, choices: list[str] | None) -> str:
    """Return the description with the choices, in upstream's words: `ros2 launch -s` shows it."""
    if description is None:
        return "no description given" if choices is None else f"One of: {choices}"
    if choices is None:
        return description
    return f"{description.removesuffix('.')}. Valid choices are: {choices}"
