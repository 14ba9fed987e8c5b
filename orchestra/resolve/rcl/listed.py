"""Groups of parameters that are each for one of a list of plugins, as the nodes of Nav2 have them, and costmaps.

`controller_plugins: [FollowPath]` names the group `FollowPath`, which says in `FollowPath.plugin` what to load. A
group that no list names is read by nobody; it is told of where a list names one nearly so called that is not there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.resolve.typos import is_typo

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.errors import Problems
    from orchestra.resolve.rcl.sections import Entry, Section

_LOADED: Final = ".plugin"
_COSTMAPS: Final = ("local_costmap", "global_costmap")
_OF_COSTMAPS: Final = frozenset(
    {"footprint", "plugins", "publish_frequency", "robot_radius", "update_frequency"}
)
_LISTS: Final = ("plugins", "plugin", "filters", "navigators")


def report_unlisted(sections: Sequence[Section], problems: Problems) -> None:
    """Report groups of plugins that no list names, where a list names one that is nearly so called."""
    for section in sections:
        for group, meant, lists in unlisted(section):
            name = group.name.rpartition(".")[2]
            message = f"nothing names '{name}': '{lists}' names '{meant}', for which there are no parameters"
            problems.warning(Code.SURPRISING_SCALAR, message, group.key, suggestion=meant)


def report_shallow(sections: Sequence[Section], problems: Problems) -> None:
    """Report parameters of a costmap at the name of its namespace alone: the node is `/local_costmap/local_costmap`."""
    for section in sections:
        if is_shallow(section):
            name = section.pattern.strip("/")
            message = f"the costmap is called '/{name}/{name}': '{name}' is to stand below '{name}' once more"
            problems.warning(Code.UNMATCHED_SECTION, message, section.location)


def is_shallow(section: Section) -> bool:
    """Return whether a section is meant for a costmap of Nav2 and for no node that there is."""
    if section.pattern.strip("/") not in _COSTMAPS:
        return False
    return any(entry.name.partition(".")[0] in _OF_COSTMAPS for entry in section.entries)


def unlisted(section: Section) -> Iterator[tuple[Entry, str, str]]:
    """Yield such groups with the name that was probably meant and that of the list that has it."""
    loaded = {entry.name[: -len(_LOADED)] for entry in section.entries if entry.name.endswith(_LOADED)}
    if not loaded:
        return
    groups = {entry.name: entry for entry in section.entries if entry.opens}
    levels: dict[str, dict[str, str]] = {}
    for entry in section.entries:
        level, _, name = entry.name.rpartition(".")
        if name.endswith(_LISTS) and entry.name not in groups:
            values = entry.value if isinstance(entry.value, tuple) else (entry.value,)
            levels.setdefault(level, {}).update(
                dict.fromkeys((value for value in values if isinstance(value, str)), name)
            )
    for whole in loaded & groups.keys():
        level, _, name = whole.rpartition(".")
        named = levels.get(level, {})
        if name in named:
            continue
        start = f"{level}." if level else ""
        missing = [other for other in named if f"{start}{other}" not in groups and is_typo(name, other)]
        if len(missing) == 1:
            yield groups[whole], missing[0], named[missing[0]]
