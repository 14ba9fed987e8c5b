"""The table of formats: each makes a text of a plan, the same one every time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Protocol

from orchestra.plan import codec
from orchestra.plan.render import dot, mermaid, svg, text, yaml_text
from orchestra.plan.render.setting import Setting
from orchestra.plan.render.shell import script

if TYPE_CHECKING:
    from orchestra.plan.model import Plan


class Format(Protocol):
    """One way to show a plan."""

    def __call__(self, plan: Plan, setting: Setting = ..., /) -> str:
        """Return the plan as text."""


def _json(plan: Plan, setting: Setting = Setting(), /) -> str:  # noqa: B008 - it is frozen
    del setting
    return codec.dumps(plan, indent=2) + "\n"


FORMATS: Final[dict[str, Format]] = {
    "text": text.render,
    "json": _json,
    "yaml": yaml_text.render,
    "sh": script.render,
    "mermaid": mermaid.render,
    "dot": dot.render,
    "svg": svg.render,
}
