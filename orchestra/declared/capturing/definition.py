"""Captured parameters as a definition file of generate_parameter_library."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.declared.kinds import TYPES

if TYPE_CHECKING:
    from orchestra.declared.capturing.model import Captured, CapturedParameter

_WORDS: Final = {kind: word for word, kind in TYPES.items()}


def as_definition(captured: Captured) -> dict[str, Any]:
    """Return the definition; what it has no words for (a step, lists of bytes) is told in texts.

    Raises `ValueError` where a name is both that of a parameter and of a group, which no definition can say.
    """
    names = {parameter.name for parameter in captured.parameters}
    root: dict[str, Any] = {}
    for parameter in captured.parameters:
        *groups, last = parameter.name.split(".")
        level = root
        for depth, group in enumerate(groups, 1):
            if ".".join(groups[:depth]) in names:
                raise ValueError(
                    f"'{group}' is a parameter and a group of them: a definition cannot say that"
                )
            level = level.setdefault(group, {})
        level[last] = _leaf(parameter)
    return {re.sub(r"\W", "_", captured.node.rpartition("/")[2]): root}


def _leaf(parameter: CapturedParameter) -> dict[str, Any]:
    word = None if parameter.dynamic_typing else _WORDS.get(parameter.type)  # type: ignore[call-overload]
    found: dict[str, Any] = {"type": word or "none"}
    if word is not None and parameter.value is not None:
        found["default_value"] = parameter.value
    description = parameter.description
    if word is None and parameter.type is not None:
        description = f"{description} ({parameter.type})".strip()
    found |= {"description": description} if description else {}
    found |= {"read_only": True} if parameter.read_only else {}
    constraints = [parameter.additional_constraints] if parameter.additional_constraints else []
    if parameter.range is not None and word is not None:
        low, high, step = parameter.range
        if math.isfinite(low) or math.isfinite(high):
            found["validation"] = {"bounds<>": [low, high]}
        if step and not (parameter.type == "integer" and step == 1):
            constraints.append(f"steps of {step} from {low}")
    if constraints:
        found["additional_constraints"] = "; ".join(constraints)
    return found
