"""The table of formats."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.plan import codec
from orchestra.plan.render import text

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.plan.model import Plan


def _json(plan: Plan) -> str:
    return codec.dumps(plan, indent=2) + "\n"


FORMATS: Final[dict[str, Callable[[Plan], str]]] = {"text": text.render, "json": _json}
