"""The value of a parameter that is the text of an attribute in XML.

Upstream reads it as YAML and keeps it a text where PyYAML cannot read it, as the `[*]` of a glob. Source:
`launch.utilities.type_utils.coerce_to_type` with `can_be_str`, and `ParameterValue` of launch_ros.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.patterns import pattern
from orchestra.resolve.scalars import upstream_value
from orchestra.resolve.yaml_scalars import NotYaml

if TYPE_CHECKING:
    from orchestra.values import ParameterValue

_BEGUN: Final = pattern(r"""\s*[\[{'"]""")
_WHOLE: Final = pattern(r"\s*(?:\[[^\[\]]*\]|\{[^{}]*\})\s*")
_LACKS_AN_ITEM: Final = pattern(r"[\[,]\s*,")


def attribute_value(text: str) -> ParameterValue:
    """Return the value that a node gets for the text of an attribute.

    A list, a mapping or a text in quotes that is but unfinished is no text that anybody means. Raises `ValueError` like
    `upstream_value`.
    """
    try:
        return upstream_value(text)
    except NotYaml:
        if _BEGUN.match(text) and (not _WHOLE.fullmatch(text) or _LACKS_AN_ITEM.search(text)):
            raise
        return text
