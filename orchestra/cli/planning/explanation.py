"""`orchestra plan FILE --explain SUBJECT`: where values come from, and which rule has decided."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Final

from orchestra.cli.planning import host
from orchestra.cli.planning.choice import chosen
from orchestra.errors import UsageError
from orchestra.plan import codec
from orchestra.plan.explaining import UnknownSubjectError, explain
from orchestra.plan.render import explanation as text

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.plan.explained import Explanation
    from orchestra.plan.model import Plan
    from orchestra.plan.render.setting import Paint

VERSION: Final = 1


def explained(options: Namespace, plan: Plan, paint: Paint) -> str:
    """Return the text that explains what is asked for. Raises `UsageError` where there is no such thing."""
    plan = chosen(plan, options.node)
    inherited = host.inherited() if any("$" in subject for subject in options.explain) else {}
    try:
        found = [explain(plan, subject, inherited) for subject in options.explain]
    except UnknownSubjectError as error:
        raise UsageError(str(error)) from error
    return _json(found) if options.format == "json" else "\n".join(text.render(item, paint) for item in found)


def _json(found: list[Explanation]) -> str:
    document = {"version": VERSION, "explained": codec.encode(tuple(found))}
    return json.dumps(document, indent=2, ensure_ascii=False) + "\n"
