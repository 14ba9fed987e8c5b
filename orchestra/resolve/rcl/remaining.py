"""The nodes of a parameter file behind one that cannot be made sense of: rcl stops there, the check goes on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.opened import Unreadable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.resolve.rcl.reader import Reader
    from orchestra.resolve.rcl.sections import Section

_MOST: Final = 10  # nodes, for each takes a pass over the file


def remaining_sections(
    events: Callable[[], Iterator[yaml.Event]], failed: yaml.Event | None, reader: Callable[[], Reader]
) -> Iterator[Section]:
    """Yield the sections of what is behind the node that an event is of; `events` and `reader` begin anew."""
    for _ in range(_MOST):
        fresh = reader()
        try:
            for event in _behind(events(), failed):
                failed = event
                fresh.take(event)
        except Unreadable:
            yield from fresh.sections()
        except yaml.YAMLError:
            return  # what is no YAML is told where no node is unreadable
        else:
            yield from fresh.sections()
            return


def _behind(events: Iterator[yaml.Event], failed: yaml.Event | None) -> Iterator[yaml.Event]:
    """Yield the beginning of the file's mapping and what is behind the key of it that holds an event."""
    depth, is_key, reached, begins = 0, True, False, None
    root: yaml.Event | None = None
    for event in events:
        if begins is not None:
            yield event
            continue
        if reached and depth == 1 and is_key and root is not None:
            begins = event
            if not isinstance(event, yaml.MappingEndEvent):
                yield root
                yield event
                continue
            return
        reached = reached or (type(event) is type(failed) and _index(event) == _index(failed))
        if isinstance(event, yaml.CollectionStartEvent):
            root = event if depth == 0 and isinstance(event, yaml.MappingStartEvent) else root
            depth += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1
        if depth == 1 and event is not root and isinstance(event, yaml.NodeEvent | yaml.CollectionEndEvent):
            is_key = not is_key


def _index(event: yaml.Event | None) -> int | None:
    mark = None if event is None else event.start_mark
    return None if mark is None else mark.index
