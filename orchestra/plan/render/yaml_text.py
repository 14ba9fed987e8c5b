"""A plan as YAML: the same data as its JSON form, so that it reads back as the same plan."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.plan import codec
from orchestra.plan.render.setting import Setting
from orchestra.plan.render.yaml_lines import document

if TYPE_CHECKING:
    from orchestra.plan.model import Plan


def render(plan: Plan, setting: Setting = Setting(), /) -> str:  # noqa: B008 - it is frozen
    """Return the plan as one YAML document, its keys in the order of the JSON form."""
    del setting
    return document(codec.encode(plan))


def loads(text: str | bytes) -> Plan:
    """Read a plan that `render` wrote. Raises `ValueError` where it is none of this version."""
    import yaml  # noqa: PLC0415 - it takes time to import, and only this needs all of it

    try:
        document: Any = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ValueError(str(error)) from error
    return codec.plan_from(document)
