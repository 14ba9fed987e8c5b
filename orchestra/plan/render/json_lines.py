"""A plan as JSON, with a line for each value."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.plan import codec
from orchestra.plan.render.setting import Setting

if TYPE_CHECKING:
    from orchestra.plan.model import Plan


def render(plan: Plan, setting: Setting = Setting(), /) -> str:  # noqa: B008 - it is frozen
    """Return the plan as `codec` reads it back."""
    del setting
    return codec.dumps(plan, indent=2) + "\n"
