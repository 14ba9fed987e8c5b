"""Parameter files by themselves: what is wrong with parameters that every node has."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.declared.common import COMMON
from orchestra.errors import Code

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.errors import Problems
    from orchestra.resolve.rcl.sections import Section


def check_common(sections: Iterable[Section], problems: Problems) -> None:
    """Report values of such parameters that every node refuses, where it is plain which were meant.

    Other texts, as `<use_sim_time>`, are for whoever puts a value in their place.
    """
    for section in sections:
        for entry in section.entries:
            if entry.name not in COMMON or entry.value is None or isinstance(entry.value, bool):
                continue
            # Here, because hardly any file needs it.
            from orchestra.declared.judging import of_every_node  # noqa: PLC0415
            from orchestra.resolve.refusals import forget_surprise  # noqa: PLC0415

            for fault in of_every_node({entry.name: entry.value}):
                if fault.meant is None and isinstance(entry.value, str):
                    continue
                forget_surprise(entry.location.span, problems)
                problems.error(Code.DECLARED_TYPE, fault.told, entry.location, suggestion=fault.meant)
