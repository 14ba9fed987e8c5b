"""`ThisLaunchFileDir`: the folder of the launch file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.text import perform_alike

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext


class ThisLaunchFileDir(ParsedSubstitution):
    """The absolute path of the folder of the launch file that is visited."""

    _name = "dirname"

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        if arguments or keywords:
            return False
        self._as_given = arguments, keywords
        self._known_as = _ALONE
        return True

    def describe(self) -> str:
        """Return what it is."""
        return "ThisLaunchFileDir()"

    def perform(self, context: LaunchContext) -> str:
        """Return the path; what the user has put among the locals comes first. Raises `SubstitutionFailure`."""
        put: str | None = context.get_locals_as_dict().get("current_launch_file_directory")
        return super().perform(context) if put is None else put


_ALONE = ("dirname",)
perform_alike(ThisLaunchFileDir)
