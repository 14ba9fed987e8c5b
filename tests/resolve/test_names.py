from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from orchestra.resolve.names import (
    InvalidName,
    expanded,
    full_name,
    full_topic_name_fault,
    joined,
    namespace_fault,
    node_name_fault,
    rmw_namespace_fault,
    rmw_node_name_fault,
    rule_name_fault,
    topic_name_fault,
)

if TYPE_CHECKING:
    from collections.abc import Callable

_TEXTS = st.text(alphabet="ab_1/~{}.- é", max_size=8) | st.sampled_from(
    ["{ns}/a", "{node}", "~/{namespace}/b", "{other}", "/{ns", "/" + "a" * 300, "a" * 256, "~/a/1"]
)


@pytest.mark.conforms(
    "4.4 relative", "4.4 absolute", "4.4 no namespace", "4.4 none at all", "4.4 empty", "4.4 made absolute"
)
@pytest.mark.parametrize(
    ("base", "namespace", "result"),
    [
        (None, None, None),
        ("a", None, "/a"),
        ("/a", "b", "/a/b"),
        ("/a", "/b", "/b"),
        (None, "/c", "/c"),
        (None, "", "/"),
        ("", None, "/"),
        ("/a", "", "/a"),
        (None, "/ns/", "/ns"),
        ("/", "c", "/c"),
        (None, "/", "/"),
        ("/a", "/", "/"),
        ("a/b", "c/d/", "/a/b/c/d"),
    ],
)
def test_namespaces_join_as_upstream_joins_them(
    base: str | None, namespace: str | None, result: str | None
) -> None:
    assert joined(base, namespace) == result


@pytest.mark.conforms("4.4 full name", "4.4 root")
def test_full_names_have_one_slash_between() -> None:
    assert full_name("/x", "n") == "/x/n"
    assert full_name("/", "n") == "/n"


@pytest.mark.conforms("4.4 node name", "4.4 invalid")
@pytest.mark.parametrize(
    ("name", "offset", "part"),
    [
        ("", 0, "empty"),
        ("robot-1", 5, "not '-'"),
        ("/n1", 0, "the namespace is given apart"),
        ("1st", 0, "digit"),
        ("grün", 2, "not 'ü'"),
        ("a__b", 1, "'__'"),
        ("a" * 256, 255, "longer than 255"),
    ],
)
def test_a_bad_node_name_is_told_with_its_place(name: str, offset: int, part: str) -> None:
    fault = node_name_fault(name)
    assert fault is not None
    assert fault.offset == offset
    assert part in fault.reason


@pytest.mark.parametrize("name", ["a", "_", "_a", "A9_z", "a" * 255])
def test_a_good_node_name_has_no_fault(name: str) -> None:
    assert node_name_fault(name) is None


@pytest.mark.conforms("4.4 invalid")
@pytest.mark.parametrize(
    ("namespace", "offset"), [("a", 0), ("/a/", 2), ("/a//b", 3), ("/1a", 1), ("/a b", 2), ("/a__b", 2)]
)
def test_a_bad_namespace_is_told_with_its_place(namespace: str, offset: int) -> None:
    fault = namespace_fault(namespace)
    assert fault is not None
    assert fault.offset == offset


@pytest.mark.parametrize(
    ("name", "result"),
    [
        ("scan", "/ns/scan"),
        ("/scan", "/scan"),
        ("~/scan", "/ns/n/scan"),
        ("~", "/ns/n"),
        ("{node}/scan", "/ns/n/scan"),
        ("/{ns}", "//ns"),
        ("{namespace}/a", "/ns/a"),
    ],
)
def test_topic_names_expand(name: str, result: str) -> None:
    assert expanded(name, "/ns", "n") == result


def test_topic_names_expand_in_the_root() -> None:
    assert expanded("a", "/", "n") == "/a"
    assert expanded("~/a", "/", "n") == "/n/a"


def test_a_name_that_cannot_be_is_not_expanded() -> None:
    with pytest.raises(InvalidName, match="'a b': only letters") as caught:
        expanded("a b", "/ns", "n")
    assert caught.value.fault.offset == 1


@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=100,
)
@given(name=_TEXTS)
def test_names_are_judged_as_rcl_judges_them(ask_rcl: Callable[..., Any], name: str) -> None:
    assume(not (len(name) == 2 and name[0] == "~" and name[1] != "/"))  # rcl lets "~a" pass by accident
    topic, full, namespace, node, whole = ask_rcl("names", name=name)
    ours = topic_name_fault(name)
    if topic is not None:
        assert ours is not None
        assert len(name[: ours.offset].encode()) == topic[1]
    elif whole is None or "//" in name:
        assert ours is not None
    else:
        assert ours is None
        assert expanded(name, "/ns", "n") == whole
    for verdict, fault in (
        (full, full_topic_name_fault(name)),
        (namespace, rmw_namespace_fault(name)),
        (node, rmw_node_name_fault(name)),
    ):
        assert (verdict is None) == (fault is None)


@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=100,
)
@given(name=st.text(alphabet="ab_1/~{} ", min_size=1, max_size=7))
def test_rules_take_the_names_that_rcl_takes(ask_rcl: Callable[..., Any], name: str) -> None:
    assume(not name.startswith("__"))
    as_topic = ask_rcl("node", arguments=["--ros-args", "-r", f"a:={name}"])
    assert ("error" in as_topic) == (rule_name_fault(name) is not None)
    as_name = ask_rcl("node", arguments=["--ros-args", "-r", f"__node:={name}"])
    assert ("error" in as_name) == (node_name_fault(name) is not None)
    as_namespace = ask_rcl("node", arguments=["--ros-args", "-r", f"__ns:=/{name}"])
    assert ("error" in as_namespace) == (namespace_fault(f"/{name}") is not None)
