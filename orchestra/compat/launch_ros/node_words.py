"""The words that a node's command line has after `--ros-args`, for user code that prepares a node by hand.

A plan has parameters in one file per node instead, with the same effect.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch_ros.parameter_descriptions import ParameterFile
from orchestra.compat.launch_ros.utilities.evaluate_parameters import evaluate_parameters
from orchestra.compat.launch_ros.utilities.normalize_parameters import normalize_parameter_dict

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.substitution import Substitution

_EVERY_NODE = "/**"


def rules(own: Iterable[tuple[Any, Any]], context: LaunchContext) -> list[tuple[str, str]]:
    """Return remapping rules in order of effect: those of all nodes, then a node's own."""
    performed = [(_performed(left, context), _performed(right, context)) for left, right in own]
    return [*context.launch_configurations.get("ros_remaps", ()), *performed]


def global_parameters(context: LaunchContext) -> list[Any]:
    """Return the parameters of all nodes, normalised. Raises `FileNotFoundError` for a file that is not there."""
    found: list[Any] = []
    for item in context.launch_configurations.get("global_params", ()):
        if isinstance(item, tuple):
            found.append(normalize_parameter_dict({item[0]: item[1]}))
        else:
            found.append(ParameterFile(Path(item).resolve(strict=True)))
    return found


def parameter_words(own: Iterable[Any], node: str | None, context: LaunchContext) -> Iterator[str]:
    """Yield the words that give parameters: those of all nodes, then a node's own, those in dictionaries in files.

    `node` is the full name, None where that is not known. A file that is not there is left out, as upstream.
    """
    for item in context.launch_configurations.get("global_params", ()):
        yield from (
            ("-p", f"{item[0]}:={item[1]}") if isinstance(item, tuple) else ("--params-file", str(item))
        )
    for item in evaluate_parameters(context, own):
        if isinstance(item, Mapping):
            yield from ("--params-file", _file(item, node or _EVERY_NODE))
        elif isinstance(item, Path):
            yield from ("--params-file", str(item)) if item.is_file() else ()
        else:
            name, value = item.evaluate(context)
            yield from ("-p", f"{name}:={_yaml(value)}")


def _file(values: Mapping[str, Any], section: str) -> str:
    """Write a parameter file; the resolution removes those of user code."""
    import tempfile  # noqa: PLC0415 - slow, and only user code that asks for the words comes here

    plain = {name: list(value) if isinstance(value, tuple) else value for name, value in values.items()}
    with tempfile.NamedTemporaryFile("w", prefix="launch_params_", delete=False) as file:
        file.write(_yaml({section: {"ros__parameters": plain}}))
    return file.name


def _yaml(value: Any) -> str:
    import yaml  # noqa: PLC0415 - only user code that prepares a node by hand comes here

    text: str = yaml.dump(list(value) if isinstance(value, tuple) else value, default_flow_style=None)
    return text.removesuffix("...\n").rstrip("\n")


def _performed(subs: Iterable[Substitution], context: LaunchContext) -> str:
    return "".join(context.perform_substitution(sub) for sub in subs)
