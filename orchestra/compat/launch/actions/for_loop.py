"""`ForEach` and `ForLoop` (newer ROS releases): entities made by a function, once per value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import yaml

from orchestra.compat.launch.action import Action
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class ForEach(Action):
    """Call `function(**values)` for each mapping in a text, and visit the entities that it returns.

    The text is YAML mappings with semicolons between them.
    """

    SEPARATOR = ";"

    def __init__(self, input_values: Sub, *, function: Callable[..., Any], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._input_values = normalized(input_values)
        self._function = function

    @property
    def input_values(self) -> list[Substitution]:
        """The text."""
        return self._input_values

    @property
    def function(self) -> Callable[..., Any]:
        """The function."""
        return self._function

    def describe(self) -> str:
        """Return what the action is."""
        return f"{type(self).__name__}(input_values='{self._input_values}', function={self._function})"

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Call the function for each mapping. Raises `yaml.YAMLError` for what is no YAML."""
        text = "".join(sub.perform(context) for sub in self.input_values)
        mappings = [yaml.safe_load(piece) for piece in text.split(self.SEPARATOR) if piece.strip()]
        return [
            entity for mapping in mappings if mapping is not None for entity in self.function(**mapping) or ()
        ]


class ForLoop(Action):
    """Call `function(i=...)` for each number from 0 up to `length`, and visit the entities that it returns."""

    def __init__(
        self, length: Sub, *, function: Callable[..., Any], name: str | None = None, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self._length = normalized(length)
        self._function = function
        self._name = name

    @property
    def length(self) -> list[Substitution]:
        """How often."""
        return self._length

    @property
    def function(self) -> Callable[..., Any]:
        """The function."""
        return self._function

    @property
    def name(self) -> str | None:
        """The name of the index in launch files of the front ends."""
        return self._name

    def describe(self) -> str:
        """Return what the action is."""
        return (
            f"{type(self).__name__}(length='{self._length}', name='{self._name}', function={self._function})"
        )

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Call the function for each number. Raises `ValueError` for a length that is no whole number."""
        length = int("".join(sub.perform(context) for sub in self.length))
        return [entity for index in range(length) for entity in self.function(i=index) or ()]
