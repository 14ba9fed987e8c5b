"""The action that includes a launch description; the event of the same name is in `launch.events`."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final, cast

from orchestra.compat.building import models_of, unchecked
from orchestra.compat.extensions import INCLUDED, extension_fields, taken
from orchestra.compat.launch.actions.set_launch_configuration import SetLaunchConfiguration
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
from orchestra.compat.launch.launch_description_source import LaunchDescriptionSource
from orchestra.compat.launch.launch_description_sources.any_launch_description_source import (
    AnyLaunchDescriptionSource,
)
from orchestra.compat.launch.plain_action import PlainAction, text_at
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.substitution_failure import SubstitutionFailure
from orchestra.compat.launch_ros.plain_texts import entity, standing_at
from orchestra.compat.place import Arguments, Key, ValueOf, here
from orchestra.compat.text import normalized
from orchestra.compat.values import pairs
from orchestra.compat.wrong import WrongType
from orchestra.description.actions.include import Include
from orchestra.description.parts import Pair
from orchestra.location import is_file

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class IncludeLaunchDescription(PlainAction):
    """Visit a launch description: a source, or the path of a launch file of any kind.

    `launch_arguments` are pairs of name and value, or a mapping; they are set before, and stay. Orchestra's own keys
    are keywords too (`orchestra.compat.extensions.INCLUDED`).
    """

    _role = "include"
    _plain = (1, ("launch_description_source", "launch_arguments"))
    _more_keywords = INCLUDED

    def __init__(
        self,
        launch_description_source: LaunchDescriptionSource | Sub,
        *,
        launch_arguments: Iterable[tuple[Sub, Sub]] | Mapping[Sub, Sub] | None = None,
        **kwargs: Any,
    ) -> None:
        self.__extensions = taken(kwargs, self._more_keywords)
        super().__init__(**kwargs)
        source = launch_description_source
        self.__is_path = not isinstance(source, LaunchDescriptionSource)
        if not isinstance(source, LaunchDescriptionSource):
            source = AnyLaunchDescriptionSource(source)
        self.__launch_description_source = source
        _check(launch_arguments)
        given = launch_arguments.items() if isinstance(launch_arguments, Mapping) else launch_arguments
        if given is not launch_arguments:
            from orchestra.compat.refused_upstream import tell_no_pairs  # noqa: PLC0415 - only mistakes need it

            tell_no_pairs(launch_arguments, self._place)
        self.__launch_arguments = tuple(given or ())

    @property
    def launch_description_source(self) -> LaunchDescriptionSource:
        """The source."""
        return self.__launch_description_source

    @property
    def launch_arguments(self) -> tuple[tuple[Sub, Sub], ...]:
        """The arguments, as they were given."""
        return self.__launch_arguments

    def describe(self) -> str:
        """Return what is included."""
        return f"{type(self).__name__}({self.__launch_description_source.location})"

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the description, as far as it is known without a visit."""
        found = self.__launch_description_source.try_get_launch_description_without_context()
        return [] if found is None else [found]

    def _get_launch_file(self) -> str:
        """Return the absolute path of the launch file, for subclasses of users."""
        return os.path.abspath(self.__launch_description_source.location)  # noqa: PTH100 - as upstream, no link is followed

    def _get_launch_file_directory(self) -> str:
        """Return the folder of the launch file, for subclasses of users; `<script>` where there is none."""
        location = self.__launch_description_source.location
        return os.path.dirname(self._get_launch_file()) if is_file(location) else "<script>"  # noqa: PTH120

    def _try_get_arguments_names_without_context(self) -> list[str] | None:
        """Return the names of the arguments that are given, None where they depend on a visit."""
        context = LaunchContext()
        try:
            return [
                "".join(item.perform(context) for item in normalized(name))
                for name, _ in self.launch_arguments
            ]
        except SubstitutionFailure:
            return None

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Include the file; return what is to be visited where the description is an object."""
        if self.__launch_description_source._reads_file or self.__extensions:
            return super().execute(context)
        settings = [SetLaunchConfiguration(name, value) for name, value in self.launch_arguments]
        for setting in settings:
            setting._place = self._place
        return [*settings, self.__launch_description_source.get_launch_description(context)]

    def _is_as_described(self) -> bool:
        if not super()._is_as_described():
            return False
        if self._as_given is not None:
            return True
        return self.__launch_description_source._reads_file or bool(self.__extensions)

    def _is_plain(self, given: dict[str, Any]) -> bool:
        source = given.get("launch_description_source")
        if not (
            isinstance(source, LaunchDescriptionSource)
            and source._reads_file
            and given.keys() <= self._plain_names
        ):
            return False
        arguments: Any = given.get("launch_arguments")
        if type(arguments) not in _PAIRS:
            return arguments is None
        given["launch_arguments"] = pairs = tuple(arguments)
        return all(map(_is_pair, pairs))

    def _read(self, given: dict[str, Any], call: Arguments) -> tuple[type[Model], dict[str, Any]]:
        file = given["launch_description_source"]._file()
        arguments = given.get("launch_arguments")
        if not arguments:
            return Include, {"file": file}
        # Names and values apart: a name has the number of its value.
        names, values, beside = Arguments(call.place), Arguments(call.place), standing_at(call, _ARGUMENTS)
        given_to_it = [
            entity(
                Pair,
                {
                    "name": text_at(name, names, "launch_arguments", Key(index)),
                    "value": text_at(value, values, "launch_arguments", ValueOf(index)),
                },
                beside,
            )
            for index, (name, value) in enumerate(arguments)
        ]
        return Include, {"file": file, "arg": tuple(given_to_it)}

    def _of_given(self, given: dict[str, Any], condition: dict[str, Any]) -> Model:
        model = cast("Include", super()._of_given(given, condition))
        return model.read_as(given["launch_description_source"]._language)

    def _made(self, common: Mapping[str, Any]) -> Model:
        span = self._place.span
        try:
            arguments = pairs(self.launch_arguments, self._place.at("launch_arguments"))
        except TypeError as error:
            return self._refused_model(error, common)
        given = self._place.at("launch_description_source") if self.__is_path else None
        file = self.__launch_description_source._file(given)
        condition = unchecked(common)
        if self.__extensions or condition is None:
            extensions = extension_fields(Include, self.__extensions, self._place, file=file)
            include = Include.at(span, file=file, arg=arguments, **extensions, **common)
        else:
            include = Include.made(span, {"file": file, "arg": arguments, **condition}, common["origin"])
        if not self.__launch_description_source._reads_file:
            return include.holding(models_of((_Sourced(self.__launch_description_source),), self._place))
        return include.read_as(self.__launch_description_source._language)

    def _refused_model(self, error: TypeError, common: Mapping[str, Any]) -> Model:
        """Return what raises an error once the condition holds: upstream looks at the arguments at the visit."""
        from orchestra.description.actions.opaque import OpaqueAction  # noqa: PLC0415 - pydantic, only where files are read

        if self.condition is None:
            raise error
        return OpaqueAction.at(self._place.span, **{**common, "target": _Refused(error)})


def _is_pair(item: Any) -> bool:
    """Return whether something is a name and a value that are texts, substitutions, or lists of both."""
    return type(item) is tuple and len(item) == _PAIR and all(map(_is_text, item))


def _is_text(value: Any) -> bool:
    return isinstance(value, str | Substitution) or (
        type(value) is list and all(isinstance(item, str | Substitution) for item in value)
    )


_ARGUMENTS: Final = ("launch_arguments",)
_PAIR: Final = 2
_PAIRS: Final = frozenset({list, tuple, type({}.items())})


def _check(arguments: Any) -> None:
    """Raise `WrongType` for what can be seen to be no pairs of names and values."""
    told_so = None
    if callable(arguments):
        told_so = "the launch_arguments are a method: it is not called"
    elif isinstance(arguments, set) and any(isinstance(item, str) for item in arguments):
        told_so = "the launch_arguments are pairs, this is a set: a dictionary has a colon"
    elif isinstance(arguments, tuple) and any(isinstance(item, str) for item in arguments):
        told_so = f"the launch_arguments are a list of pairs, this is one of them: {arguments!r}"
    if told_so is not None:
        raise WrongType(told_so, path=("launch_arguments",))


class _Refused(LaunchDescriptionEntity):
    """What has faulty arguments."""

    def __init__(self, error: TypeError) -> None:
        self._place = here()
        self.__error = error

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:  # noqa: ARG002 - what entities have
        """Raise the error."""
        raise self.__error


class _Sourced(LaunchDescriptionEntity):
    """The description of a source that only its own code knows."""

    def __init__(self, source: LaunchDescriptionSource) -> None:
        self._place = here()
        self.__source = source

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the description."""
        return [self.__source.get_launch_description(context)]
