"""A plan as YAML: the same data as its JSON form, so that it reads back as the same plan."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.plan import codec
from orchestra.plan.render.setting import Setting

if TYPE_CHECKING:
    from orchestra.plan.model import Plan

_FOLDED = ("\x85", "\u2028", "\u2029", "\ufeff")


def render(plan: Plan, setting: Setting = Setting(), /) -> str:  # noqa: B008 - it is frozen
    """Return the plan as one YAML document, its keys in the order of the JSON form."""
    del setting
    import yaml  # noqa: PLC0415 - it takes time to import, and only this format needs it

    class Dumper(yaml.SafeDumper):
        """Writes texts with other line breaks than a line feed in double quotes: elsewhere YAML folds them."""

        def represent_str(self, data: str) -> yaml.ScalarNode:
            style = '"' if any(mark in data for mark in _FOLDED) else None
            return self.represent_scalar("tag:yaml.org,2002:str", data, style)

    Dumper.add_representer(str, Dumper.represent_str)
    text: str = yaml.dump(codec.encode(plan), Dumper=Dumper, allow_unicode=True, sort_keys=False, width=110)
    return text


def loads(text: str | bytes) -> Plan:
    """Read a plan that `render` wrote. Raises `ValueError` where it is none of this version."""
    import yaml  # noqa: PLC0415 - as above

    try:
        document: Any = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ValueError(str(error)) from error
    return codec.plan_from(document)
