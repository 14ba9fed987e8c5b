"""Parameters as Python writes them: what user code gets when it evaluates them itself, and what the plan has."""

from __future__ import annotations

import enum
from pathlib import Path
from typing import TYPE_CHECKING, Any, List  # noqa: UP035 - as launch files write it

import pytest

from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.substitutions import (
    LaunchConfiguration,
    SubstitutionFailure,
    TextSubstitution,
)
from orchestra.compat.launch_ros import utilities
from orchestra.compat.launch_ros.descriptions import Parameter, ParameterFile, ParameterValue
from orchestra.compat.launch_ros.utilities import (
    add_node_name,
    evaluate_parameter_dict,
    evaluate_parameters,
    get_node_name_count,
    is_namespace_absolute,
    is_root_namespace,
    make_namespace_absolute,
    normalize_parameters,
    normalize_remap_rules,
    prefix_namespace,
    to_parameters_list,
)
from tests.compat.contexts import loading
from tests.compat.python_plans import of_python

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({"PATH": "/usr/bin:/bin"}):
        yield


def T(text: str) -> TextSubstitution:  # noqa: N802 - stands for a class
    return TextSubstitution(text=text)


class _Mode(str, enum.Enum):  # noqa: UP042 - as launch files write it
    FAST = "fast"


# What is written for one parameter -> its value, and how a launch file has it in Python where that can be said.
_VALUES: dict[str, tuple[Any, Any]] = {
    "a text": ("abc", "abc"),
    "a text that looks like a number": ("5", "5"),
    "a text that looks like a truth value": ("true", "true"),
    "an empty text": ("", ""),
    "a text of several lines": ("a: 1\nb: 2\n", "a: 1\nb: 2\n"),
    "an integer": (1, 1),
    "a float": (2.0, 2.0),
    "a truth value": (False, False),
    "a list of integers": ([2, 3], (2, 3)),
    "a list of floats": ([2.5, 3.5], (2.5, 3.5)),
    "integers beside floats": ([2, 3.1, 4], (2.0, 3.1, 4.0)),
    "a list of truth values": ([True, False], (True, False)),
    "a list of texts": (["a", "b"], ("a", "b")),
    "texts that look like numbers": (["True", "1", "1.0"], ("True", "1", "1.0")),
    "a tuple": ((1, 2), (1, 2)),
    "a substitution": (T("baz"), "baz"),
    "a substitution that is a truth value": (T("off"), False),
    "a substitution that is an integer": (T("5"), 5),
    "a substitution that is a list": (T("[2, 3]"), (2, 3)),
    "a substitution that is a list of texts": (T("['True', 'b']"), ("True", "b")),
    "a substitution that is empty": (T(""), ""),
    "several substitutions": ([T("fiz"), T("buz")], "fizbuz"),
    "a text before a substitution": (["a_", T("5")], "a_5"),
    "a text after a substitution": ([T("1"), "2"], 12),
    "a tuple of both": (("a_", T("5")), "a_5"),
    "a list of lists of substitutions": ([[T("1")], [T("2")]], (1, 2)),
    "a list of lists and a text": ([[T("fiz")], "5"], ("fiz", "5")),
    "a list of a text and lists": (["bar", [T("fiz"), "x"]], ("bar", "fizx")),
    "a list and a substitution": ([[T("fiz"), T("buz")], T("fiz")], ("fizbuz", "fiz")),
    "a value that stays a text": (ParameterValue(T("{'asd': 3}"), value_type=str), "{'asd': 3}"),
    "a value that becomes a float": (ParameterValue(T("5"), value_type=float), 5.0),
    "a value that becomes a truth value": (ParameterValue(T("1"), value_type=bool), True),
    "a value without a type": (ParameterValue(T("5")), 5),
    "a value that is a literal": (ParameterValue("5", value_type=str), "5"),
    "a value that is a list": (ParameterValue(T("[1, 2]"), value_type=List[int]), [1, 2]),  # noqa: UP006
    "a value that is a list of substitutions": (
        ParameterValue([[T("['a']")], "b"], value_type=List[str]),  # noqa: UP006
        ["['a']", "b"],
    ),
    "an enumeration": (_Mode.FAST, "fast"),
}


@pytest.mark.conforms(
    "1.16 normalize_parameters",
    "4.6.1 dict",
    "4.6.1 str",
    "4.6.1 scalars",
    "4.6.1 substitutions",
    "4.6.1 lists of scalars",
    "4.6.1 lists of texts",
    "4.6.1 lists of lists",
    "4.6.1 lists of substitutions",
    "4.6.1 ParameterValue",
    "4.6.2 as text",
    "4.6.2 as number or boolean",
    "4.6.2 without a type",
    "4.6.2 as list",
    "1.13 ParameterValue",
    "D17",
)
@pytest.mark.parametrize(("written", "value"), _VALUES.values(), ids=_VALUES)
def test_user_code_evaluates_values(written: Any, value: Any) -> None:
    (found,) = evaluate_parameters(LaunchContext(), normalize_parameters([{"a": {"b": written}}]))
    assert found == {"a.b": value}
    assert type(found["a.b"]) is type(value)
    if isinstance(value, tuple | list):
        assert [type(item) for item in found["a.b"]] == [type(item) for item in value]


@pytest.mark.parametrize("written", _VALUES, ids=_VALUES)
def test_what_is_normalised_stays_as_it_is(written: str) -> None:
    once = normalize_parameters([{"a": _VALUES[written][0]}])
    twice = normalize_parameters(once)
    context = LaunchContext()
    assert evaluate_parameters(context, twice) == evaluate_parameters(context, once)


_MIXED: dict[str, Any] = {
    "truth values and numbers": [True, 2.0, 3],
    "numbers and a text": [1, "a"],
    "numbers and a substitution": [True, 1, T("foo")],
    "numbers and a list of substitutions": [[T("foo")], True, 1],
    "substitutions of several types": [[T("True")], [T("2.0")], [T("3")]],
    "substitutions that are lists": [[T("['a']")], [T("['b']")]],
    "a mapping": T("{a: 3}"),
    "a list of several types": T("[1, 2.0, 3]"),
    "a list of lists": T("[[2, 3], [2, 3]]"),
    "an empty list from text": T("[]"),
    "an empty list": [],
    "no YAML": T("a: b: c"),
    "null": T("null"),
}


@pytest.mark.conforms("4.6.1 other mixes", "4.6.1 empty list", "D17")
@pytest.mark.parametrize("written", _MIXED.values(), ids=_MIXED)
def test_a_value_without_one_type_is_refused_when_it_is_evaluated(written: Any) -> None:
    with pytest.raises(TypeError):
        evaluate_parameters(LaunchContext(), normalize_parameters([{"a": written}]))


@pytest.mark.conforms("4.6.1 other mixes", "4.6.1 empty list")
@pytest.mark.parametrize("written", ["{a: 3}", "[1, 2.0]", "[]", "a: b: c", "null"])
def test_such_a_value_is_an_error_in_a_plan_too(written: str, tmp_path: Path) -> None:
    found = of_python(
        tmp_path, f"[Node(executable='/bin/true', parameters=[{{'a': TextSubstitution(text={written!r})}}])]"
    )
    (problem,) = found.problems
    assert problem.severity.value == "error"
    assert problem.span is not None
    assert (Path(problem.span.file).name, problem.span.line) == ("a.launch.py", _last_line(tmp_path))


def _last_line(folder: Path) -> int:
    return (folder / "a.launch.py").read_text("utf-8").count("\n")


@pytest.mark.conforms("4.6.1 names")
def test_names_are_texts_and_substitutions() -> None:
    parameters = normalize_parameters([{("a", T("b")): 1, T("c"): {"d": {("e", "f"): 2}}}])
    assert evaluate_parameters(LaunchContext(), parameters) == ({"ab": 1, "c.d.ef": 2},)


@pytest.mark.conforms("1.1 SomeParameters", "1.13 ParameterFile", "1.1 FilePath")
def test_files_are_paths(tmp_path: Path) -> None:
    written = [
        "/a.yaml",
        Path("/b.yaml"),
        [T("/c"), ".yaml"],
        T("/d.yaml"),
        b"/e.yaml",
        ParameterFile("/f.yaml"),
    ]
    found = evaluate_parameters(LaunchContext(), normalize_parameters(written))
    assert found == tuple(Path(f"/{letter}.yaml") for letter in "abcdef")
    del tmp_path


@pytest.mark.conforms("4.6.1 bytes")
def test_binary_data_stays_as_it_is() -> None:
    data = bytes([0xFF, 0x5C])
    assert evaluate_parameters(LaunchContext(), normalize_parameters([{"a": data}])) == ({"a": data},)


@pytest.mark.conforms("1.12.1 parameters", "1.16 normalize_parameters")
@pytest.mark.parametrize("parameters", ["/a.yaml", {"a": 1}, 5, [5], [{"a": 1}, object()]])
def test_parameters_are_a_list(parameters: Any) -> None:
    with pytest.raises(TypeError):
        normalize_parameters(parameters)


def test_what_is_not_normalised_is_refused() -> None:
    with pytest.raises(TypeError):
        evaluate_parameter_dict(LaunchContext(), {"a": 1})
    with pytest.raises(TypeError):
        evaluate_parameter_dict(LaunchContext(), [1])


@pytest.mark.conforms("1.13 Parameter")
def test_a_parameter_is_evaluated_to_name_and_value() -> None:
    parameter = Parameter(["a.", T("b")], [[T("x")], "_y"], value_type=List[str])  # noqa: UP006
    assert [item.describe() for item in parameter.name] == ["'a.'", "'b'"]
    assert parameter.value_type is List[str]  # noqa: UP006
    assert parameter.evaluate(LaunchContext()) == ("a.b", ["x", "_y"])
    assert (parameter.name, parameter.value) == ("a.b", ["x", "_y"])
    (found,) = evaluate_parameters(LaunchContext(), normalize_parameters([parameter]))
    assert found is parameter
    assert "a.b" in str(parameter)


@pytest.mark.conforms("4.6.2 literal of another type", "4.6.2 as number or boolean", "1.13 ParameterValue")
def test_a_value_that_does_not_fit_is_a_value_error() -> None:
    with pytest.raises(ValueError, match="x"):
        ParameterValue(T("x"), value_type=int).evaluate(LaunchContext())
    with pytest.raises(TypeError):
        ParameterValue(1, value_type=str)


@pytest.mark.conforms("1.13 ParameterFile")
def test_a_parameter_file_is_evaluated_into_a_file_of_its_own(tmp_path: Path) -> None:
    written = tmp_path / "given.yaml"
    written.write_text("/$(var ns)/n:\n  ros__parameters: {a: '$(var a)', b: \\$x}\n", "utf-8")
    context = LaunchContext()
    context.launch_configurations.update(ns="robot", a="5")
    file = ParameterFile([str(tmp_path), "/given.yaml"], allow_substs=True)
    assert file.allow_substs is True
    assert isinstance(file.param_file, list)
    made = file.evaluate(context)
    assert made.name.startswith("launch_params_")
    assert made.read_text("utf-8") == "/robot/n:\n  ros__parameters: {a: '5', b: $x}\n"
    assert file.evaluate(context) == file.param_file == made
    file.cleanup()
    assert not made.exists()
    assert isinstance(file.param_file, list)


def test_a_parameter_file_without_substitutions_is_used_as_it_is(tmp_path: Path) -> None:
    written = tmp_path / "given.yaml"
    written.write_text("a: $(var b)", "utf-8")
    file = ParameterFile(written)
    assert file.evaluate(LaunchContext()) == written
    file.cleanup()
    assert written.exists()


@pytest.mark.conforms("1.13 ParameterFile")
def test_a_parameter_file_that_is_no_yaml_afterwards_is_refused(tmp_path: Path) -> None:
    written = tmp_path / "given.yaml"
    written.write_text("a: $(var x)", "utf-8")
    context = LaunchContext()
    context.launch_configurations["x"] = "[1"
    with pytest.raises(SubstitutionFailure, match="no YAML"):
        ParameterFile(written, allow_substs=True).evaluate(context)


@pytest.mark.conforms("1.13 ParameterFile")
def test_whether_a_file_is_evaluated_is_a_truth_value() -> None:
    with pytest.raises(TypeError):
        ParameterFile("/a.yaml", allow_substs=LaunchConfiguration("x"))
    with pytest.raises(TypeError):
        ParameterFile(5)


_NAMESPACES = [
    # base, namespace -> together, absolute
    (None, None, None, None),
    ("asd", None, "asd", "/asd"),
    ("", None, "", "/"),
    ("/", None, "/", "/"),
    (None, "asd", "asd", "/asd"),
    (None, "", "", "/"),
    ("asd", "bsd", "asd/bsd", "/asd/bsd"),
    ("asd", "/bsd", "/bsd", "/bsd"),
    ("/asd", "bsd", "/asd/bsd", "/asd/bsd"),
    ("/", "bsd", "/bsd", "/bsd"),
    ("", "bsd", "bsd", "/bsd"),
    ("asd", "", "asd", "/asd"),
    ("asd", "bsd/", "asd/bsd", "/asd/bsd"),
    ("asd", "/bsd/", "/bsd", "/bsd"),
]


@pytest.mark.conforms("1.16 prefix_namespace", "4.4 relative", "4.4 absolute", "4.4 made absolute")
@pytest.mark.parametrize(("base", "namespace", "together", "absolute"), _NAMESPACES)
def test_namespaces_join(
    base: str | None, namespace: str | None, together: str | None, absolute: str | None
) -> None:
    assert prefix_namespace(base, namespace) == together
    assert make_namespace_absolute(together) == absolute


@pytest.mark.conforms("1.16 prefix_namespace")
def test_namespaces_are_told_apart() -> None:
    assert is_root_namespace("/")
    assert not is_root_namespace("")
    assert is_namespace_absolute("/a")
    assert not is_namespace_absolute("a/b")


@pytest.mark.conforms("1.16 add_node_name")
def test_node_names_are_counted() -> None:
    context = LaunchContext()
    assert get_node_name_count(context, "/a") == 0
    add_node_name(context, "/a")
    add_node_name(context, "/a")
    add_node_name(context, "/b")
    assert (get_node_name_count(context, "/a"), get_node_name_count(context, "/c")) == (2, 0)


@pytest.mark.conforms("1.16 normalize_remap_rules")
def test_remapping_rules_have_two_sides() -> None:
    ((source, target),) = normalize_remap_rules([("a", [T("b"), "c"])])
    assert ([item.describe() for item in source], [item.describe() for item in target]) == (
        ["'a'"],
        ["'b'", "'c'"],
    )


@pytest.mark.conforms("D50")
def test_every_exported_function_is_what_its_name_means() -> None:
    assert all(callable(getattr(utilities, name)) for name in utilities.__all__)


@pytest.mark.conforms("1.16 to_parameters_list")
def test_parameters_of_rclpy_are_made_of_values_and_files(tmp_path: Path) -> None:
    pytest.importorskip("rclpy", reason="needs ROS")
    file = tmp_path / "p.yaml"
    file.write_text(
        "/**: {ros__parameters: {a: 1}}\nns: {n: {ros__parameters: {b: {c: [x]}}}}\nother: {ros__parameters: {d: 1}}\n"
    )
    found = to_parameters_list(LaunchContext(), "n", "/ns", ({"e": 2.0}, file))
    assert [(item.name, item.value) for item in found] == [("e", 2.0), ("a", 1), ("b.c", ("x",))]
