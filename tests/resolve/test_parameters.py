"""The types of parameters, however they are written and whatever they are for."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.description.actions.node import Node
from orchestra.description.actions.set_parameter import SetParameter
from orchestra.description.parts import Override, Param
from orchestra.description.text import Call, Constant, Template
from orchestra.errors import Code, Problems, Severity
from orchestra.plan.parameter_file import contents
from tests.resolve.launching import outcome
from tests.resolve.made import AT, planned, text, value

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from orchestra.plan.model import Process
    from orchestra.values import ParameterValue


def _node(folder: Path, actions: str, param: str = "[]") -> tuple[Process, Problems]:
    written = f"launch:\n{actions}- node: {{exec: sleep, name: n, namespace: ns, param: {param}}}"
    found = outcome(folder, {"main.yaml": written, "p.yaml": "/**: {ros__parameters: {f: 1}}"})
    return found.plan.processes[0], found.problems


SET_PARAMETERS: dict[str, Any] = {
    "{name: a, value: 1}": {"a": 1},
    "{name: a, value: 0.1}": {"a": 0.1},
    "{name: a, value: true}": {"a": True},
    "{name: a, value: 'true'}": {"a": True},  # upstream takes nothing but texts here
    "{name: a, value: '5'}": {"a": 5},
    "{name: a, value: '1e-3'}": {"a": 0.001},
    "{name: a, value: '[1, 2]'}": {"a": (1, 2)},
    "{name: a, value: [1, 2.5]}": {"a": (1.0, 2.5)},
    "{name: a, value: [x, y]}": {"a": ("x", "y")},
    "{name: a, value: ['1', '2'], type: list_of_str}": {"a": ("1", "2")},
    "{name: a, value: '5', type: str}": {"a": "5"},
    "{name: a, value: '5', type: float}": {"a": 5.0},
    "{name: a, value: hello world}": {"a": "hello world"},
    "{name: a, value: ''}": {"a": ""},
    "{name: a, value: $(var v)}": {"a": 7},
    "{name: a, param: [{name: b, value: 1}, {name: c, param: [{name: d, value: x}]}]}": {
        "a.b": 1,
        "a.c.d": "x",
    },
}


@pytest.mark.conforms("D20", "4.6.3 parameters for all nodes")
@pytest.mark.parametrize("written", SET_PARAMETERS)
def test_a_parameter_of_all_nodes_has_its_type(written: str, tmp_path: Path) -> None:
    process, problems = _node(tmp_path, f"- let: {{name: v, value: '7'}}\n- set_parameter: {written}\n")
    assert not problems.errors
    assert process.parameters == SET_PARAMETERS[written]
    assert [type(item) for item in process.parameters.values()] == [
        type(item) for item in SET_PARAMETERS[written].values()
    ]


REFUSED = {
    "{name: a}": Code.CONFLICTING_KEYS,
    "{name: a, value: 1, param: []}": Code.CONFLICTING_KEYS,
    "{name: a, param: [{name: b, value: 1}], type: str}": Code.CONFLICTING_KEYS,
    "{name: a, value: []}": Code.PARAMETER_TYPE,
    "{name: a, value: [1, x]}": Code.PARAMETER_TYPE,
    "{name: a, value: [1], type: str}": Code.PARAMETER_TYPE,
    "{name: a, value: '{b: 1}'}": Code.PARAMETER_TYPE,
    "{name: a, value: x, type: int}": Code.PARAMETER_TYPE,
}


@pytest.mark.parametrize("written", REFUSED)
def test_what_can_have_no_type_is_refused_at_its_place(written: str, tmp_path: Path) -> None:
    _, problems = _node(tmp_path, f"- set_parameter: {written}\n")
    (problem,) = problems.errors
    assert (problem.code, problem.span is not None and problem.span.line) == (REFUSED[written], 2)


@pytest.mark.conforms("D59", "3.2 param")
def test_the_last_value_of_a_parameter_is_read_back(tmp_path: Path) -> None:
    actions = """- set_parameter: {name: p, value: [1]}
- set_parameter: {name: p, value: [1, 2]}
"""
    process, problems = _node(tmp_path, actions, "[{name: q, value: $(param p)}]")
    assert list(problems) == []
    assert process.parameters == {"p": (1, 2), "q": (1, 2)}


@pytest.mark.conforms("1.12 SetParametersFromFile", "4.6.3 parameters for all nodes")
def test_files_and_values_for_all_nodes_keep_their_order(tmp_path: Path) -> None:
    file, single = (
        "- set_parameters_from_file: {filename: p.yaml}\n",
        "- set_parameter: {name: f, value: 2}\n",
    )
    assert _node(tmp_path, file + single)[0].parameters == {"f": 2}
    assert _node(tmp_path, single + file)[0].parameters == {"f": 1}
    assert _node(tmp_path, single + file, "[{from: p.yaml}, {from: p.yaml}]")[0].parameters == {"f": 1}


def test_a_file_for_all_nodes_that_is_for_none_is_told_once(tmp_path: Path) -> None:
    main = """launch:
- set_parameters_from_file: {filename: p.yaml}
- node: {exec: sleep, name: a}
- node: {exec: sleep, name: b}
"""
    found = outcome(tmp_path, {"main.yaml": main, "p.yaml": "/c: {ros__parameters: {f: 1}}"})
    assert found.faults == [(Code.UNMATCHED_SECTION, "p.yaml", 1, 1)]
    two = "/c: {ros__parameters: {f: 1}}\n/d: {ros__parameters: {f: 1}}"
    found = outcome(tmp_path, {"main.yaml": main, "p.yaml": two})
    assert found.faults == [(Code.UNMATCHED_SECTION, "main.yaml", 2, 40)]
    found = outcome(tmp_path, {"main.yaml": main, "p.yaml": "/a: {ros__parameters: {f: 1}}"})
    assert list(found.problems) == []


@pytest.mark.conforms("D18")
def test_a_missing_file_for_all_nodes_is_an_error(tmp_path: Path) -> None:
    _, problems = _node(tmp_path, "- set_parameters_from_file: {filename: q.yaml}\n")
    assert [problem.code for problem in problems.errors] == [Code.MISSING_FILE]


def _made(
    *params: Param, before: tuple[SetParameter, ...] = ()
) -> tuple[dict[str, ParameterValue], Problems]:
    node = Node.at(AT, exec=text("sleep"), name=text("n"), namespace=text("ns"), param=params)
    plan, problems = planned(*before, node)
    return plan.processes[0].parameters, problems


def _param(given: Any, kind: str | None = None) -> Param:
    return Param.at(AT, name=text("p"), value=given, type=text(kind) if kind else None)


CONSTANTS: tuple[tuple[Any, Any], ...] = (
    (1e-6, 1e-6),
    (1, 1),
    (True, True),
    ("5", "5"),
    ("true", "true"),
    ("", ""),
    ((1, 2), (1, 2)),
    ((1, 2.5), (1.0, 2.5)),
    ((1, True), (1, 1)),
    ((True, False), (True, False)),
    (("1", "2"), ("1", "2")),
)


@pytest.mark.conforms("4.6.1 str", "4.6.1 scalars", "4.6.1 lists of scalars", "4.6.1 lists of texts")
@pytest.mark.parametrize(("given", "expected"), CONSTANTS, ids=repr)
def test_a_value_of_python_keeps_its_type(given: Any, expected: ParameterValue) -> None:
    parameters, problems = _made(_param(value(given)))
    assert list(problems) == []
    assert repr(parameters) == repr({"p": expected})


@pytest.mark.conforms("4.6.1 None", "4.6.1 other mixes", "4.6.1 empty list", "D17")
@pytest.mark.parametrize(
    "given", [(), (1, "a"), (True, "a"), None, b"x", 2**63, ((1,), (2,)), "a\0"], ids=repr
)
def test_a_value_of_python_that_no_node_can_have_is_refused(given: Any) -> None:
    _, problems = _made(_param(Constant(given, AT)))
    assert [(problem.code, problem.span) for problem in problems.errors] == [(Code.PARAMETER_TYPE, AT)]


@pytest.mark.parametrize(
    ("given", "kind", "sound"),
    [
        (1, "int", True),
        (1, "float", False),
        ("1", "int", False),
        ((1.0,), "list_of_float", True),
        ((1,), "list_of_str", False),
    ],
)
def test_a_value_of_python_is_of_the_type_that_is_asked_for(given: Any, kind: str, sound: bool) -> None:
    _, problems = _made(_param(value(given), kind))
    assert bool(problems.errors) is not sound


def test_lists_of_substitutions_are_typed_item_by_item() -> None:
    call = Template((Call("env", (text("A"), text("5")), AT),), "$(env A 5)", AT)
    number = Template((Call("env", (text("NOPE"), text("5")), AT),), "$(env NOPE 5)", AT)
    assert _made(_param((number, value(1))))[0] == {"p": (5, 1)}
    assert _made(_param((number, value(1.5))))[0] == {"p": (5.0, 1.5)}
    assert _made(_param((call, value("y"))))[0] == {"p": ("x", "y")}
    assert _made(_param((number, number), "list_of_str"))[0] == {"p": ("5", "5")}


def test_a_word_that_stays_a_text_in_a_list_is_no_surprise() -> None:
    parameters, problems = _made(_param((text("x"), text("y"))))
    assert (parameters, [*problems]) == ({"p": ("x", "y")}, [])
    parameters, problems = _made(_param((text("y"), text("n"))))
    assert parameters == {"p": (True, False)}
    assert {problem.code for problem in problems} == {Code.SURPRISING_SCALAR}


TEXTS_FOR_ALL = {"5": 5, "true": True, "1e-3": 0.001, "007": 7, "": "", "a: b": "a: b", "word": "word"}


@pytest.mark.conforms("D20")
@pytest.mark.parametrize("given", TEXTS_FOR_ALL)
def test_a_python_text_for_all_nodes_is_read_as_rcl_reads_it(given: str) -> None:
    """Upstream writes it behind `-p` as it is."""
    action = SetParameter.at(AT, name=text("p"), value=value(given))
    parameters, problems = _made(before=(action,))
    assert parameters == {"p": TEXTS_FOR_ALL[given]}
    told = [(problem.code, problem.severity) for problem in problems]
    retyped = [(Code.SURPRISING_SCALAR, Severity.WARNING)]
    assert told == ([] if isinstance(parameters["p"], str) else retyped)


@pytest.mark.conforms("D21", "4.6.2 Parameter")
def test_an_override_is_for_every_node_of_the_process(ask_rcl: Callable[..., Any]) -> None:
    """`-p` counts as `/**`, whose place in the order is that of its first appearance."""
    override = Override.at(AT, name=text("p"), value=value("5"))
    assert _made(_param(value(1)), override)[0] == {"p": "5"}
    before = SetParameter.at(AT, name=text("q"), value=value(1))
    node = Node.at(
        AT, exec=text("sleep"), name=text("n"), namespace=text("ns"), param=(_param(value(1)), override)
    )
    plan, _ = planned(before, node)
    (process,) = plan.processes
    upstream = ["-p", "q:=1", "--params-file", ["/ns/n: {ros__parameters: {p: 1}}"], "-p", "p:='5'"]
    ours = [word for written in contents(process).values() for word in ("--params-file", [written])]
    for arguments in (upstream, ours):
        answer = ask_rcl("node", arguments=["--ros-args", *arguments])
        assert json.loads(json.dumps(process.parameters)) == answer["parameters"]
