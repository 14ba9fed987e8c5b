from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch.condition import Condition
from orchestra.compat.launch.conditions import (
    IfCondition,
    InvalidConditionExpressionError,
    LaunchConfigurationEquals,
    LaunchConfigurationNotEquals,
    UnlessCondition,
    evaluate_condition_expression,
)
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.substitutions import LaunchConfiguration, TextSubstitution
from orchestra.description.text import Call, Opaque
from orchestra.location import point
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Iterator

_SPAN = point("here")


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({}):
        yield


@pytest.fixture
def context() -> LaunchContext:
    context = LaunchContext()
    context.launch_configurations.update({"yes": "true", "no": "0", "empty": "", "one": "1"})
    return context


def _holds_in_a_plan(condition: Condition, context: LaunchContext) -> bool:
    """Tell whether the fields of a model say that the condition holds."""
    ((field, template),) = condition._fields(_SPAN).items()
    text = context._engine.evaluate(template).strip().lower()
    assert text in {"true", "1", "yes", "on", "false", "0", "no", "off"}
    return (text in {"true", "1", "yes", "on"}) is (field == "if")


@pytest.mark.conforms("1.5 IfCondition", "1.5 UnlessCondition", "D13")
@pytest.mark.parametrize(
    ("text", "true"),
    [
        ("true", True),
        ("True", True),
        (" TRUE\n", True),
        ("1", True),
        ("yes", True),
        ("false", False),
        ("FALSE", False),
        ("0", False),
        ("off", False),
        (LaunchConfiguration("yes"), True),
        ([LaunchConfiguration("no")], False),
        (["tr", "ue"], True),
    ],
)
def test_a_text_that_is_a_boolean_decides(text: Any, true: bool, context: LaunchContext) -> None:
    for condition, holds in ((IfCondition(text), true), (UnlessCondition(text), not true)):
        assert condition.evaluate(context) is holds
        assert _holds_in_a_plan(condition, context) is holds


@pytest.mark.conforms("1.5 IfCondition", "1.5 InvalidConditionExpressionError")
@pytest.mark.parametrize("text", ["", " ", "typo", "2", "y", LaunchConfiguration("empty")])
def test_anything_else_is_refused(text: Any, context: LaunchContext) -> None:
    for condition in (IfCondition(text), UnlessCondition(text)):
        with pytest.raises(InvalidConditionExpressionError):
            condition.evaluate(context)
    assert issubclass(InvalidConditionExpressionError, ValueError)


@pytest.mark.conforms("1.5 evaluate_condition_expression")
def test_an_expression_is_a_list_of_substitutions(context: LaunchContext) -> None:
    parts = [TextSubstitution(text="tr"), TextSubstitution(text="ue")]
    assert evaluate_condition_expression(context, parts) is True


@pytest.mark.conforms("1.5 IfCondition")
@pytest.mark.parametrize("value", [True, None, 1, [True]])
def test_a_boolean_of_python_is_no_condition(value: Any) -> None:
    with pytest.raises(TypeError):
        IfCondition(value)


def test_the_plan_has_the_condition_as_written() -> None:
    ((field, template),) = UnlessCondition(LaunchConfiguration("yes"))._fields(_SPAN).items()
    assert (field, template.raw) == ("unless", "$(var yes)")
    assert isinstance(template.parts[0], Call)


@pytest.mark.conforms("1.5 LaunchConfigurationEquals", "1.5 LaunchConfigurationNotEquals", "D48")
@pytest.mark.parametrize(
    ("name", "value", "equal"),
    [
        ("yes", "true", True),
        ("yes", "1", False),
        ("yes", ["tr", "ue"], True),
        ("yes", None, False),
        ("empty", "", True),
        ("empty", None, False),
        ("unset", None, True),
        ("unset", "", False),
        ("one", LaunchConfiguration("one"), True),
    ],
)
def test_a_configuration_is_compared_as_text(
    name: str, value: Any, equal: bool, context: LaunchContext
) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        conditions = (
            (LaunchConfigurationEquals(name, value), equal),
            (LaunchConfigurationNotEquals(name, value), not equal),
        )
    for condition, holds in conditions:
        assert condition.evaluate(context) is holds
        assert _holds_in_a_plan(condition, context) is holds


def test_no_configuration_has_the_name_that_a_substitution_gives(context: LaunchContext) -> None:
    """Upstream looks for the object itself."""
    name: Any = LaunchConfiguration("yes")
    assert not LaunchConfigurationEquals(name, "true").evaluate(context)
    assert LaunchConfigurationNotEquals(name, "true").evaluate(context)


def test_it_is_known_what_a_comparison_reads() -> None:
    condition = LaunchConfigurationEquals("yes", LaunchConfiguration("one"))
    (part,) = condition._fields(_SPAN)["if"].parts
    assert isinstance(part, Opaque)
    assert [inside.parts[0].name for inside in part.inside if isinstance(inside.parts[0], Call)] == [
        "var",
        "var",
    ]
    assert condition.describe() == "LaunchConfigurationEquals('yes', LaunchConfig('one'))"
    assert LaunchConfigurationNotEquals("yes", None).describe() == "LaunchConfigurationNotEquals('yes', None)"


class Never(IfCondition):
    def evaluate(self, context: LaunchContext) -> bool:
        return super().evaluate(context) and False


@pytest.mark.conforms("1.5 Condition.evaluate", "1.2 Condition")
def test_users_may_decide_otherwise(context: LaunchContext) -> None:
    assert not _holds_in_a_plan(Never("true"), context)
    assert not Condition().evaluate(context)
    seen = []
    condition = Condition(predicate=lambda given: seen.append(given) or True)  # type: ignore[func-returns-value]
    assert condition.evaluate(context)
    assert seen == [context]
    assert IfCondition("a").describe() == "IfCondition('a')"
