from __future__ import annotations

import dataclasses
import sys
from typing import TYPE_CHECKING

import pytest
import yaml

from orchestra.plan.parameter_file import file_name, path, render, rendered
from tests.supervise.plans import process as described

if TYPE_CHECKING:
    from orchestra.values import ParameterValue

_PROCESS = described("/robot1/ekf", kind="node", name="ekf", namespace="/robot1")


@pytest.mark.conforms("4.6.3 content", "4.6.3 lists", "D22")
def test_a_file_is_flat_typed_and_in_order() -> None:
    process = dataclasses.replace(
        _PROCESS,
        parameters={
            "z": 1,
            "frequency": 30.0,
            "use_sim_time": True,
            "frames.odom": "robot1/odom",
            "switch": "on",
            "ids": (1, 2),
            "gains": (1.0, 1e300, 1e-07),
            "flags": (True, False),
            "labels": ("a", "1"),
        },
    )
    assert render(process) == (
        "/robot1/ekf:\n"
        "  ros__parameters:\n"
        "    z: 1\n"
        "    frequency: 30.0\n"
        "    use_sim_time: true\n"
        '    frames.odom: "robot1/odom"\n'
        '    switch: "on"\n'
        "    ids: [1, 2]\n"
        "    gains: [1.0, 1.0e+300, 1.0e-07]\n"
        "    flags: [true, false]\n"
        '    labels: ["a", "1"]\n'
    )


def test_a_node_without_parameters_has_an_empty_section() -> None:
    assert yaml.safe_load(render(_PROCESS)) == {"/robot1/ekf": {"ros__parameters": {}}}


@pytest.mark.conforms("4.6.3 top key")
@pytest.mark.parametrize(
    ("name", "namespace", "pattern"),
    [
        ("n", "/", "/n"),
        ("n", "/a/b", "/a/b/n"),
        ("n", None, "/**"),
        (None, "/a", "/**"),
    ],
)
def test_the_key_is_the_full_name_where_it_is_known(
    name: str | None, namespace: str | None, pattern: str
) -> None:
    process = dataclasses.replace(_PROCESS, id="/a/b/n#2", name=name, namespace=namespace)
    assert list(yaml.safe_load(render(process))) == [pattern]


@pytest.mark.conforms("D15", "D22", "D21")
@pytest.mark.parametrize(
    ("value", "text"),
    [
        (-0.0, "-0.0"),
        (1e16, "1.0e+16"),
        (1.5e-300, "1.5e-300"),
        (float("inf"), ".inf"),
        (float("-inf"), "-.inf"),
        (float("nan"), ".nan"),
        (5e-324, "0x0.0000000000001p-1022"),
        (sys.float_info.min, "2.2250738585072014e-308"),
        (2**63 - 1, "9223372036854775807"),
        ("", '""'),
        ('a "b" \\', '"a \\"b\\" \\\\"'),
        ("a\nb\tc\r\x01\x85\u2028\ufeff", '"a\\nb\\tc\\r\\x01\\x85\\u2028\\uFEFF"'),
        ("grüß 漢 😀", '"grüß 漢 😀"'),
    ],
)
def test_each_value_has_one_form(value: ParameterValue, text: str) -> None:
    assert rendered("/n", {"x": value}) == f"/n:\n  ros__parameters:\n    x: {text}\n"


@pytest.mark.parametrize(
    "name", ["yes", "NULL", "1", "a b", "a:b", "#", "ü", '"', "<<", "a\nb", "-", "x" * 2000]
)
def test_any_name_can_be_a_key(name: str) -> None:
    assert yaml.safe_load(rendered("/n", {name: 1})) == {"/n": {"ros__parameters": {name: 1}}}


@pytest.mark.parametrize(
    ("parameters", "reason"),
    [
        ({"x": ()}, "parameter 'x': an empty list has no type"),
        ({"x": (1, 2.0)}, "one type"),
        ({"x": (True, 1)}, "one type"),
        ({"x": 2**63}, "64 bits"),
        ({"x": (-(2**63) - 1,)}, "64 bits"),
        ({"x": "a\0b"}, "NUL"),
        ({"x": "\ud800"}, "surrogate"),
        ({"": 1}, "empty"),
        ({"a\0": 1}, "NUL"),
    ],
)
def test_what_rcl_cannot_read_is_refused(parameters: dict[str, ParameterValue], reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        rendered("/n", parameters)


@pytest.mark.parametrize(
    ("identity", "name"),
    [
        ("/robot1/ekf", "robot1.ekf.yaml"),
        ("/talker", "talker.yaml"),
        ("/a/talker.py#2", "a.talker%2Epy#2.yaml"),
        ("/a/x y", "a.x%20y.yaml"),
    ],
)
def test_files_are_named_after_the_process(identity: str, name: str) -> None:
    process = dataclasses.replace(_PROCESS, id=identity)
    assert file_name(process) == name
    assert path(process) == "${run}/params/" + name
