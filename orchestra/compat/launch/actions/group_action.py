"""`GroupAction`: actions in a scope of their own."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from orchestra.compat.building import made_of, models_in, models_of
from orchestra.compat.extensions import extension_fields, taken
from orchestra.compat.launch.event_handler import is_of_ours
from orchestra.compat.launch.plain_action import PlainAction, text_at
from orchestra.compat.values import pairs, scalar
from orchestra.description.actions.group import Group

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
    from orchestra.compat.place import Arguments
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class GroupAction(PlainAction):
    """Visit actions; unless told otherwise, what they set ends with the group.

    Without `forwarding` what is set outside is not seen inside, but for `launch_configurations`. With `for_each`, a key
    of Orchestra's own, they are visited once per value: `{"robot": ["robot1", "robot2"]}`.
    """

    _plain = (1, ("actions", "scoped", "forwarding"))
    _more_keywords = ("for_each",)

    def __init__(
        self,
        actions: Iterable[LaunchDescriptionEntity],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: Mapping[Sub, Sub] | None = None,
        **left_over_kwargs: Any,
    ) -> None:
        self.__extensions = taken(left_over_kwargs, self._more_keywords)
        super().__init__(**left_over_kwargs)
        self.__actions = actions
        self.__scoped = scoped
        self.__forwarding = forwarding
        self.__launch_configurations = dict(launch_configurations or {})
        self.__all: list[LaunchDescriptionEntity] | None = None
        if type(scoped) is not bool or type(forwarding) is not bool:
            from orchestra.compat.refused_upstream import tell_counted_as_true  # noqa: PLC0415 - only mistakes need it

            tell_counted_as_true({"scoped": scoped, "forwarding": forwarding}, self._place)
        if launch_configurations is not None and not isinstance(launch_configurations, Mapping):
            from orchestra.compat.refused_upstream import tell_no_mapping  # noqa: PLC0415 - as above

            tell_no_mapping(launch_configurations, self._place)

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the actions, with those that make the scope around them."""
        if self.__all is None:
            from orchestra.compat.around_groups import after, before  # noqa: PLC0415 - few ask for what it imports

            self.__actions = list(self.__actions)
            begin = before(self.__launch_configurations, scoped=self.__scoped, forwarding=self.__forwarding)
            self.__all = [*begin, *self.__actions, *after(scoped=self.__scoped)]
        return self.__all

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Return the actions, with those that make the scope around them; repeated ones are visited at once."""
        return super().execute(context) if self.__extensions else self.get_sub_entities()

    def _is_as_described(self) -> bool:
        return super()._is_as_described() and is_of_ours(self, "get_sub_entities")

    def _is_plain(self, given: dict[str, Any]) -> bool:
        return (
            type(given.get("actions")) is list
            and given.keys() <= self._plain_names
            and type(given.get("scoped", True)) is type(given.get("forwarding", True)) is bool
        )

    def _read(self, given: dict[str, Any], call: Arguments) -> tuple[type[Model], dict[str, Any]]:
        fields: dict[str, Any] = {"children": models_in(given["actions"], call)}
        if given.get("scoped") is False:
            fields["scoped"] = text_at("false", call)
        if given.get("forwarding") is False:
            fields["forwarding"] = text_at("false", call)
        return Group, fields

    def _made(self, common: Mapping[str, Any]) -> Model:
        span = self._place.span
        if isinstance(self.__actions, Iterator):
            self.__actions = list(self.__actions)
        fields: dict[str, Any] = {
            "scoped": None if self.__scoped else scalar(value=False, span=span),
            "forwarding": None if self.__forwarding else scalar(value=False, span=span),
            "keep": pairs(self.__launch_configurations.items(), self._place.at("launch_configurations")),
            "children": models_of(self.__actions, self._place),
        }
        if not self.__extensions:
            return made_of(Group, self._place, fields, common)
        more = extension_fields(Group, self.__extensions, self._place, children=())
        return Group.at(span, **fields, **more, **common)
