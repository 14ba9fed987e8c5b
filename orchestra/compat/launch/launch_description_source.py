"""`launch.LaunchDescriptionSource`: a launch description, or where one comes from."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from orchestra.compat.launch.event_handler import is_of_ours
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.place import IN_CONSTRUCTOR, here
from orchestra.compat.refusing import Refusing
from orchestra.compat.text import Sub, normalized, template

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_description import LaunchDescription
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.description.actions.include import Language
    from orchestra.description.text import Template
    from orchestra.location import Span


class LaunchDescriptionSource(Refusing):
    """A launch description; `location` and `method` tell people where it comes from.

    Subclasses read it from the file at `location`, once. Users' own have `_get_launch_description(location)`, or
    `get_launch_description(context)`.
    """

    # Whether the location is that of a launch file, and the language of it, None: its name tells.
    _is_file: ClassVar[bool] = False
    _language: ClassVar[Language | None] = None

    def __init__(
        self,
        launch_description: LaunchDescription | None = None,
        location: Sub = "<string>",
        method: str = "unspecified mechanism from a script",
    ) -> None:
        self._place = here(self, IN_CONSTRUCTOR)
        self.__launch_description = launch_description
        self.__location: list[Substitution] = normalized(location)
        self.__expanded: str | None = None
        self.__method = method

    @property
    def location(self) -> str:
        """The path, or what is known of it before the description is asked for."""
        if self.__expanded is not None:
            return self.__expanded
        return " + ".join(item.describe() for item in self.__location)

    @property
    def method(self) -> str:
        """How the description is made."""
        return self.__method

    def get_launch_description(self, context: LaunchContext) -> LaunchDescription:
        """Return the description. Raises `RuntimeError` where there is none."""
        if self.__expanded is None:
            self.__expanded = self.__performed(context)
        if self.__launch_description is None:
            self.__launch_description = self.__load(self.__expanded, context)
        return self.__launch_description

    def try_get_launch_description_without_context(self) -> LaunchDescription | None:
        """Return the description where it does not depend on a visit, else None."""
        if self.__launch_description is not None:
            return self.__launch_description
        try:
            context = LaunchContext()
            return self.__load(self.__performed(context), context)
        except Exception:  # noqa: BLE001 - whatever keeps it from being known here is reported by the visit
            return None

    def __performed(self, context: LaunchContext) -> str:
        return "".join(item.perform(context) for item in self.__location)

    def _get_launch_description(self, location: str) -> LaunchDescription:
        """Return the description that is at a location. Raises `RuntimeError` where there is none."""
        if not self._is_file:
            raise RuntimeError(f"the source {location} has no launch description")
        return self.__read(location, LaunchContext())

    def __load(self, location: str, context: LaunchContext) -> LaunchDescription:
        if not self._is_file or not is_of_ours(self, "_get_launch_description"):
            return self._get_launch_description(location)
        return self.__read(location, context)

    def __read(self, location: str, context: LaunchContext) -> LaunchDescription:
        found: LaunchDescription = context._engine.load(location, self._language)
        return found

    @property
    def _reads_file(self) -> bool:
        """Whether nobody but the one who reads launch files knows the description."""
        known = is_of_ours(self, "get_launch_description") and is_of_ours(self, "_get_launch_description")
        return self._is_file and known

    def _file(self, given: Span | None = None) -> Template:
        """Return the location as written; `given` is where it stands if that is not in a call for the source."""
        return template(self.__location, given or self._place.at("launch_file_path"))
