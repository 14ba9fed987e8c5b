"""`orchestra plan A --diff B`: what a run of B would have to do to become one of A."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Final

from orchestra.cli.planning import host
from orchestra.cli.planning.choice import ids_chosen, ids_of
from orchestra.cli.planning.other import other
from orchestra.plan import codec
from orchestra.plan.difference.compare import compare
from orchestra.plan.portable import is_portable, portable
from orchestra.plan.render import difference as text
from orchestra.plan.selected import selected

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable, Sequence

    from orchestra.cli.planning.sources import Made
    from orchestra.plan.difference.model import Difference
    from orchestra.plan.model import Plan
    from orchestra.plan.render.setting import Paint

VERSION: Final = 1


def compared(options: Namespace, after: Made, paint: Paint) -> tuple[str, bool]:
    """Return the text that shows the difference, and whether there is one. Raises as `other` does."""
    before = other(options.diff, options, after)
    plans = [before.plan, after.plan]
    if options.portable or any(map(is_portable, plans)):
        plans = [plan if is_portable(plan) else portable(plan, host.symbols(plan)) for plan in plans]
    found = compare(*_parts(plans, options.node))
    return _FORMATS[options.format](found, before.label, after.label, paint), not found.empty


def _parts(plans: Sequence[Plan], patterns: Sequence[str]) -> Sequence[Plan]:
    """Return the part of both plans that is asked for: a pattern may fit what only one of them has."""
    if not patterns:
        return plans
    ids = dict.fromkeys(identity for plan in plans for identity in ids_of(plan))
    wanted = ids_chosen(list(ids), patterns)
    return [selected(plan, wanted) for plan in plans]


def _json(difference: Difference, before: str, after: str, paint: Paint) -> str:
    del paint
    document = {"version": VERSION, "before": before, "after": after, **codec.encode(difference)}
    return json.dumps(document, indent=2, ensure_ascii=False) + "\n"


_FORMATS: Final[dict[str, Callable[[Difference, str, str, Paint], str]]] = {
    "text": text.render,
    "json": _json,
}
