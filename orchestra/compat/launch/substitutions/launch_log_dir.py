"""`LaunchLogDir`: the log folder of the run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch.logging import launch_config
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.description.text import Words

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.description.text import Part
    from orchestra.location import Span


class LaunchLogDir(ParsedSubstitution):
    """The folder: symbolic in a plan because it differs from run to run, unless the user has set another one."""

    _name = "launch_log_dir"

    def describe(self) -> str:
        """Return what it is."""
        return "LaunchLogDir()"

    def perform(self, context: LaunchContext) -> str:
        """Return the folder."""
        return launch_config.given_log_dir or super().perform(context)

    def _parts(self, span: Span) -> tuple[Part, ...]:
        given = launch_config.given_log_dir
        return super()._parts(span) if given is None else (Words(given, self._place.span),)
