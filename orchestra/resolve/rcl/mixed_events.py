"""Lists of parameter files whose items have several types."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.mixed import in_place, odd_item, wanted_type
from orchestra.resolve.rcl.nesting import OF_MAPPINGS
from orchestra.resolve.rcl.table import kind_of
from orchestra.resolve.rcl.values import odd_boolean

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.errors import Problems
    from orchestra.location import Location
    from orchestra.resolve.rcl.opened import OpenList

_QUOTES = ("'", '"')


def report_mixed(current: OpenList, at: Callable[[yaml.Event], Location], problems: Problems) -> None:
    """Report a list of several types at the item that is the odd one, with the item as it was probably meant."""
    if current.mapping is not None:
        problems.error(Code.PARAMETER_TYPE, OF_MAPPINGS, current.mapping)
        return
    items = current.items or []
    odd = odd_item(items)
    assert odd is not None  # noqa: S101 - it is asked for where there are several types
    wanted = wanted_type(items, odd)
    event = current.written[odd]
    assert isinstance(event, yaml.ScalarEvent)  # noqa: S101 - so are all items
    other = next(item for item in items if type(item) is wanted)
    message = f"a list must hold values of one type, not {kind_of(other)} and {kind_of(items[odd])}"
    styles = [item.style for item in current.written if isinstance(item, yaml.ScalarEvent)]
    quote = next((style for style in styles if style in _QUOTES), '"')
    instead = in_place(event.value, wanted, quoted=event.style in _QUOTES, quote=quote)
    notes = odd_boolean(items[odd], event)
    problems.error(Code.PARAMETER_TYPE, message, at(event), suggestion=instead, notes=notes)
