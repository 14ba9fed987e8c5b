"""The table of formats: each makes a text of a plan, the same one every time."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final, Protocol

from orchestra.plan.render.setting import Setting

if TYPE_CHECKING:
    from orchestra.plan.model import Plan


class Format(Protocol):
    """One way to show a plan."""

    def __call__(self, plan: Plan, setting: Setting = ..., /) -> str:
        """Return the plan as text."""


class _Late:
    """A format whose module is imported for the first plan that is shown in it: nobody needs two of them."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __call__(self, plan: Plan, setting: Setting = Setting(), /) -> str:  # noqa: B008 - it is frozen
        module: Any = import_module(f"orchestra.plan.render.{self._name}")
        text: str = module.render(plan, setting)
        return text


FORMATS: Final[dict[str, Format]] = {
    "text": _Late("text"),
    "json": _Late("json_lines"),
    "yaml": _Late("yaml_text"),
    "sh": _Late("shell.script"),
    "mermaid": _Late("mermaid"),
    "dot": _Late("dot"),
    "svg": _Late("svg"),
}
