"""Evaluated parameters as parameters of rclpy."""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch_ros.utilities.evaluate_parameters import evaluate_parameter_dict
from orchestra.compat.launch_ros.utilities.normalize_parameters import normalize_parameter_dict

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.compat.launch.launch_context import LaunchContext

_VALUES = "ros__parameters"
_TOKENS = {"**": "(/[^/]+)*", "*": "/[^/]+"}


def to_parameters_list(
    context: LaunchContext, node_name: str, namespace: str, evaluated_parameters: Iterable[Any]
) -> list[Any]:
    """Return an `rclpy.parameter.Parameter` for each parameter of a node, those of files included, in order.

    Raises `ImportError` where there is no rclpy, `OSError` for a file that cannot be read.
    """
    parameter: Any = import_module(
        "rclpy.parameter"
    ).Parameter  # only user code that asks for its objects has it
    full = "/" + "/".join(part for part in (*(namespace or "").split("/"), *node_name.split("/")) if part)
    found = []
    for item in evaluated_parameters:
        values = _of_file(context, item, full) if isinstance(item, Path) else item
        if not isinstance(values, Mapping):
            raise RuntimeError(f"{item!r} is no evaluated parameter")  # noqa: TRY004 - as upstream
        found += [parameter(name, value=value) for name, value in values.items()]
    return found


def _of_file(context: LaunchContext, path: Path, node: str) -> dict[str, Any]:
    """Return what a parameter file has for a node; a file without sections is all for it."""
    import yaml  # noqa: PLC0415 - the same

    content: Any = yaml.safe_load(path.read_text("utf-8")) or {}
    sections = dict(_sections(content, ""))
    merged = {} if sections else content
    for pattern, values in sections.items():
        if re.fullmatch(_expression(pattern), node):
            merged.update(values)
    return evaluate_parameter_dict(context, normalize_parameter_dict(merged))


def _sections(content: Mapping[str, Any], above: str) -> Iterator[tuple[str, Mapping[str, Any]]]:
    for key, value in content.items():
        if key == _VALUES:
            yield above, value
        elif isinstance(value, Mapping):
            yield from _sections(value, f"{above}/{key.lstrip('/')}")


def _expression(pattern: str) -> str:
    tokens = (token for token in pattern.split("/") if token)
    return "".join(_TOKENS.get(token, "/" + re.escape(token)) for token in tokens)
