"""What launch files import as `launch.conditions`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "evaluate_condition_expression": "evaluate_condition_expression_impl",
    "IfCondition": "if_condition",
    "InvalidConditionExpressionError": "invalid_condition_expression_error",
    "LaunchConfigurationEquals": "launch_configuration_equals",
    "LaunchConfigurationNotEquals": "launch_configuration_not_equals",
    "UnlessCondition": "unless_condition",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
