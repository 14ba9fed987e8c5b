"""The value of a parameter that is the text of an attribute in XML, or a Python text for all nodes.

Upstream reads an attribute as YAML and keeps it a text where PyYAML cannot read it, as the `[*]` of a glob. Source:
`launch.utilities.type_utils.coerce_to_type` with `can_be_str`, and `ParameterValue` of launch_ros.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.patterns import pattern
from orchestra.resolve.scalars import described, upstream_value
from orchestra.resolve.yaml_scalars import NotYaml

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.location import Location
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


def retyped(given: ParameterValue, location: Location, problems: Problems) -> ParameterValue:
    """Return what rcl makes of a Python text behind `-p`; what it does not take there, as an empty one, stays a text.

    That is how upstream hands over what is set for all nodes (launch_ros, `Node._perform_substitutions`).
    """
    if not isinstance(given, str):
        return given
    from orchestra.resolve.rcl.overrides import override_value  # noqa: PLC0415 - few plans set some for all nodes

    try:
        value = override_value(given)
    except ValueError:
        return given
    if value is None or value == given:
        return given
    message = f"'{given}' is read as {described(value)}, as ROS 2 does with a text for all nodes"
    problems.warning(Code.SURPRISING_SCALAR, message, location)
    return value
