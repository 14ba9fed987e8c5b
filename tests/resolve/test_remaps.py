from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.resolve.names import InvalidName, full_name
from orchestra.resolve.remaps import DeadRule, Rule, dead_rules, identity, read_rule, remapped

if TYPE_CHECKING:
    from collections.abc import Callable

_PROBES = [
    json.loads(line)
    for line in Path(__file__).parents[1].joinpath("data/rcl-probes.jsonl").read_text("utf-8").splitlines()
]


def _rules(arguments: list[str]) -> list[Rule]:
    rules = [word.partition(":=") for word in arguments if word != "-r"]
    return [read_rule(source, target) for source, _, target in rules]


@pytest.mark.conforms("4.5 left side of a rule", "4.5 precedence of remaps")
@pytest.mark.parametrize(
    "probe", [p for p in _PROBES if p["k"] == "remap"], ids=lambda p: " ".join(p["args"])
)
def test_remaps_as_measured(probe: dict[str, Any]) -> None:
    rules = _rules(probe["args"])
    own = identity(rules, "/ns", "n")
    assert {name: remapped(name, rules, *own) for name in probe["topics"]} == probe["topics"]
    assert remapped("a", rules, *own, kind="service") == probe["service a"]


@pytest.mark.conforms("4.5 rules for one node", "4.5 ROS flags")
@pytest.mark.parametrize(
    "probe",
    [p for p in _PROBES if p["k"] == "name" and p["args"][0] == "-r"],
    ids=lambda p: " ".join(p["args"]),
)
def test_names_as_measured(probe: dict[str, Any]) -> None:
    if "error" in probe:
        with pytest.raises(InvalidName):
            _rules(probe["args"])
    else:
        assert full_name(*identity(_rules(probe["args"]), "/ns", "n")) == probe["node"]


def test_the_namespace_rule_asks_for_the_new_name() -> None:
    assert identity(_rules(["__node:=m", "m:__ns:=/q"]), "/ns", "n") == ("/q", "m")
    assert identity(_rules(["__node:=m", "n:__ns:=/q"]), "/ns", "n") == ("/ns", "m")


@pytest.mark.conforms("4.5 left side of a rule")
@pytest.mark.parametrize(
    ("source", "target", "text", "offset"),
    [
        ("a b", "c", "a b", 1),
        ("rostopic://a b", "c", "rostopic://a b", 12),
        ("1n:a", "c", "1n:a", 0),
        ("a", "b-c", "b-c", 1),
        ("__node", "/m", "/m", 0),
        ("__ns", "q", "q", 0),
        ("rostopic://__node", "m", "rostopic://__node", 11),
        ("n:n:a", "b", "n:n:a", 3),
        ("", "b", "", 0),
    ],
)
def test_a_rule_that_cannot_be_is_told_with_its_place(
    source: str, target: str, text: str, offset: int
) -> None:
    with pytest.raises(InvalidName) as caught:
        read_rule(source, target)
    assert (caught.value.name, caught.value.fault.offset) == (text, offset)


@pytest.mark.conforms("D23")
@pytest.mark.parametrize(
    ("rules", "dead"),
    [
        (["a:=x", "a:=y"], [DeadRule(1, 0)]),
        (["a:=x", "b:=y"], []),
        (["/ns/a:=x", "a:=y"], [DeadRule(1, 0)]),
        (["a:=x", "/a:=y"], []),
        (["~/a:=x", "n/a:=y"], [DeadRule(1, 0)]),
        (["rostopic://a:=x", "a:=y"], []),
        (["a:=x", "rosservice://a:=y"], [DeadRule(1, 0)]),
        (["rostopic://a:=x", "rosservice://a:=y", "a:=z"], [DeadRule(2, 0)]),
        (["other:a:=x", "a:=y"], []),
        (["n:a:=x", "a:=y"], [DeadRule(1, 0)]),
        (["__node:=n", "__name:=m"], [DeadRule(1, 0)]),
        (["a:=b", "b:=c"], []),
    ],
)
def test_dead_rules_are_found(rules: list[str], dead: list[DeadRule]) -> None:
    assert list(dead_rules(_rules(rules), "/ns", "n")) == dead


def test_dead_rules_are_found_where_the_name_is_not_known() -> None:
    assert dead_rules(_rules(["~/a:=x", "a:=y", "~/a:=z", "a:=w"]), None, None) == (
        DeadRule(2, 0),
        DeadRule(3, 1),
    )


_NAMES = st.sampled_from(["a", "/a", "~/a", "b", "/ns/a", "/ns/n/a", "n/a", "/q/a"])
_SOURCES = st.builds("{}{}".format, st.sampled_from(["", "n:", "m:", "rostopic://", "n:rostopic://"]), _NAMES)
_RULE = st.builds("{}:={}".format, _SOURCES, _NAMES) | st.sampled_from(
    ["__node:=m", "__ns:=/q", "n:__node:=m", "m:__ns:=/q", "rosservice://a:=b"]
)


@pytest.mark.conforms("4.5 precedence of remaps", "4.5 left side of a rule")
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=100,
)
@given(rules=st.lists(_RULE, max_size=5))
def test_remaps_as_rcl_applies_them(ask_rcl: Callable[..., Any], rules: list[str]) -> None:
    topics = ["a", "/a", "~/a", "b", "/ns/a", "n/a", "/ns/n/a"]
    words = [word for rule in rules for word in ("-r", rule)]
    answer = ask_rcl("node", arguments=["--ros-args", *words], topics=topics)
    read = _rules(rules)
    own = identity(read, "/ns", "n")
    assert full_name(*own) == answer["name"]
    assert {topic: remapped(topic, read, *own) for topic in topics} == answer["topics"]
    dead = {found.rule for found in dead_rules(read, *own)}
    alive = [rule for index, rule in enumerate(read) if index not in dead]
    assert {topic: remapped(topic, alive, *own) for topic in topics} == answer["topics"]
