"""Nodes that cannot talk with each other, as their executables declare it."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.declared.interfaces.compatibility import misfits
from orchestra.declared.interfaces.model import Qos
from tests.declared.checking import checked, marked, told

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.errors import Problem

_PATIENT = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
_PACKAGE = {
    "demo_talk/__init__.py": "",
    **{f"demo_talk/nodes/{name}.py": "" for name in ("__init__", "talker", "listener", "other")},
}
_LAUNCH = "launch:\n  - node: {pkg: demo_talk, exec: talker, name: talker}\n  - node: {pkg: demo_talk, exec: listener, name: listener}\n"


def _checked(
    folder: Path, talker: str, listener: str, launch: str = _LAUNCH, **files: str
) -> tuple[Problem, ...]:
    interfaces = {
        "demo_talk/params/talker.interface.yaml": talker,
        "demo_talk/params/listener.interface.yaml": listener,
    }
    return checked(folder, {"a.launch.yaml": launch, **_PACKAGE, **interfaces, **files})


def _topic(
    kind: str, name: str = "chatter", kind_of_message: str = "std_msgs/msg/String", qos: str = "{}"
) -> str:
    return f"{kind}: [{{name: {name}, type: {kind_of_message}, qos: {qos}}}]"


def test_what_fits_is_not_told(tmp_path: Path) -> None:
    assert (
        _checked(tmp_path, _topic("publishers"), _topic("subscriptions", kind_of_message="std_msgs/String"))
        == ()
    )


@pytest.mark.parametrize(
    ("what", "one", "other", "first", "second"),
    [
        ("topic", "publishers", "subscriptions", "std_msgs/msg/String", "std_msgs/msg/Int32"),
        ("topic", "publishers", "publishers", "std_msgs/msg/String", "std_msgs/msg/Int32"),
        ("service", "service_servers", "service_clients", "std_srvs/srv/Empty", "std_srvs/srv/Trigger"),
        ("action", "action_servers", "action_clients", "demo/action/Go", "demo/action/Come"),
    ],
)
def test_two_types_of_one_name(
    tmp_path: Path, what: str, one: str, other: str, first: str, second: str
) -> None:
    found = _checked(
        tmp_path, f"{one}: [{{name: x, type: {first}}}]", f"{other}: [{{name: x, type: {second}}}]"
    )
    assert told(found) == [
        f"ORC095 a.launch.yaml:3:5 error the {what} '/x' has two types: {second} of '/listener' and {first} of '/talker'"
    ]


def test_nodes_of_two_domains_do_not_meet(tmp_path: Path) -> None:
    publishers = _topic("publishers"), _topic("subscriptions", kind_of_message="std_msgs/msg/Int32")
    apart = _LAUNCH.replace("name: talker}", "name: talker, env: [{name: ROS_DOMAIN_ID, value: '3'}]}")
    assert _checked(tmp_path, *publishers, apart) == ()


def test_the_rule_that_leads_to_the_wrong_name_is_the_place(tmp_path: Path) -> None:
    launch = _LAUNCH.replace("name: talker}", "name: talker, remap: [{from: out, to: /chatter}]}")
    (problem,) = _checked(
        tmp_path,
        _topic("publishers", "out"),
        _topic("subscriptions", kind_of_message="std_msgs/msg/Int32"),
        launch,
    )
    assert (problem.code, marked(problem, tmp_path)) == ("ORC095", "/chatter")


@pytest.mark.parametrize(
    ("offered", "requested", "policy", "offer", "request_"),
    [
        ("{reliability: best_effort}", "{reliability: reliable}", "reliability", "best_effort", "reliable"),
        (
            "{durability: VOLATILE}",
            "{durability: TRANSIENT_LOCAL}",
            "durability",
            "volatile",
            "transient_local",
        ),
        (
            "{liveliness: automatic}",
            "{liveliness: manual_by_topic}",
            "liveliness",
            "automatic",
            "manual_by_topic",
        ),
        ("{deadline: 1.0}", "{deadline: 0.5}", "deadline", "1 s", "0.5 s"),
        ("{reliability: reliable}", "{deadline_ns: 500000000}", "deadline", "endless", "0.5 s"),
        ("{lease_duration: 3}", "{liveliness_lease_duration_ns: 2000000000}", "lease duration", "3 s", "2 s"),
    ],
)
def test_quality_of_service_that_does_not_fit(
    tmp_path: Path, offered: str, requested: str, policy: str, offer: str, request_: str
) -> None:
    publisher, subscription = _topic("publishers", qos=offered), _topic("subscriptions", qos=requested)
    assert told(_checked(tmp_path, publisher, subscription)) == [
        "ORC096 a.launch.yaml:3:5 warning '/listener' gets nothing of '/chatter' from '/talker': "
        f"it asks for {policy} {request_}, and {offer} is offered"
    ]
    assert _checked(tmp_path, _topic("publishers", qos=requested), _topic("subscriptions", qos=offered)) == ()


def test_what_parameters_change_is_not_known(tmp_path: Path) -> None:
    launch = _LAUNCH.replace(
        "name: talker}",
        "name: talker, param: [{name: qos_overrides./chatter.publisher.reliability, value: reliable}]}",
    )
    offered, requested = "{reliability: best_effort}", "{reliability: reliable}"
    assert (
        _checked(tmp_path, _topic("publishers", qos=offered), _topic("subscriptions", qos=requested), launch)
        == ()
    )


_qos = st.builds(
    Qos,
    st.sampled_from([None, "best_effort", "reliable"]),
    st.sampled_from([None, "volatile", "transient_local"]),
    st.sampled_from([None, "automatic", "manual_by_topic"]),
    st.sampled_from([None, 0.5, 1.0, inf]),
    st.sampled_from([None, 0.5, 1.0, inf]),
)


@_PATIENT
@given(_qos, _qos)
def test_what_is_offered_fits_itself_and_one_of_two_fits_the_other(one: Qos, other: Qos) -> None:
    assert not list(misfits(one, one))
    policies = {item.policy for item in misfits(one, other)} & {item.policy for item in misfits(other, one)}
    assert not policies


@pytest.mark.parametrize("target", ["/Chatter", "/chat/ter", "/Chat_ter"])
def test_names_that_differ_in_case_and_slashes(tmp_path: Path, target: str) -> None:
    launch = _LAUNCH.replace("name: listener}", f"name: listener, remap: [{{from: chatter, to: {target}}}]}}")
    (problem,) = _checked(tmp_path, _topic("publishers"), _topic("subscriptions"), launch)
    assert (problem.code, marked(problem, tmp_path), problem.suggestion) == ("ORC097", target, "/chatter")


def test_names_that_differ_in_the_namespace(tmp_path: Path) -> None:
    launch = _LAUNCH.replace("name: talker}", "name: talker, namespace: robot}")
    (problem,) = _checked(tmp_path, _topic("publishers"), _topic("subscriptions"), launch)
    assert (problem.code, problem.suggestion) == ("ORC097", None)
    assert "a remap from 'chatter' to '/robot/chatter' connects them" in problem.notes
    others = launch + "  - node: {pkg: demo_talk, exec: other, name: other}\n"
    assert _checked(tmp_path, _topic("publishers"), _topic("subscriptions"), others) == ()


def test_a_topic_that_somebody_feeds_is_in_order(tmp_path: Path) -> None:
    launch = _LAUNCH + "  - node: {pkg: demo_talk, exec: talker, name: robot, namespace: robot}\n"
    assert _checked(tmp_path, _topic("publishers"), _topic("subscriptions"), launch) == ()


def test_one_mistake_for_two_robots_is_one_problem(tmp_path: Path) -> None:
    inner = (_LAUNCH + "").replace("}\n", ", namespace: $(var robot)}\n")
    launch = "launch:\n  - include:\n      file: inner.yaml\n      for_each: {robot: [r1, r2]}\n"
    found = _checked(
        tmp_path,
        _topic("publishers", qos="{reliability: best_effort}"),
        _topic("subscriptions", qos="{reliability: reliable}"),
        launch,
        **{"inner.yaml": inner},
    )
    assert [problem.code for problem in found] == ["ORC096"]


_NODL = """\
<interface version="1">
  <node name="given" executable="talker">
    <topic name="~/chatter" type="std_msgs/String" role="publisher"/>
    <parameter name="x" type="int"/>
  </node>
  <node name="listener" executable="listener">
    <topic name="/given/chatter" type="std_msgs/msg/Int32" subscription="true"><qos reliability="reliable"/></topic>
    <service name="go" type="std_srvs/srv/Empty" role="both"/>
  </node>
</interface>
"""


@pytest.mark.parametrize("file", ["demo_talk/all.nodl.xml", "demo_talk/nodl/all.nodl.xml"])
def test_nodl_is_read(tmp_path: Path, file: str) -> None:
    launch = _LAUNCH.replace(", name: talker", "")
    found = checked(tmp_path, {"a.launch.yaml": launch, **_PACKAGE, file: _NODL})
    assert [problem.code for problem in found] == ["ORC095"]


def test_nodl_2_is_read(tmp_path: Path) -> None:
    talker = "nodl_version: 2\npublishers:\n- {name: c, type: std_msgs/String, qos: {history: KEEP_LAST, depth: 1, reliability: BEST_EFFORT}}\n"
    listener = "nodl_version: 2\nsubscriptions:\n- {name: c, type: std_msgs/String, qos: {history: SYSTEM_DEFAULT, reliability: RELIABLE}}\n"
    files = {"demo_talk/talker.nodl.yaml": talker, "demo_talk/nodl/listener.nodl.yaml": listener}
    assert [
        problem.code for problem in checked(tmp_path, {"a.launch.yaml": _LAUNCH, **_PACKAGE, **files})
    ] == ["ORC096"]


@pytest.mark.parametrize(
    ("text", "line", "message", "suggestion"),
    [
        ("publishes:\n- {name: a, type: b/C}", 1, "there is no key 'publishes' here", "publishers"),
        ("publishers:\n- {nme: a, type: b/C}", 2, "there is no key 'nme' here", "name"),
        ("publishers:\n- {name: a}", 2, "an endpoint needs a `type`", None),
        ("publishers:\n- {name: a, type: String}", 2, "'String' is no type of an interface, as std_msgs/msg/String", None),
        ("publishers:\n- {name: a, type: b/C,\n   qos: {reliability: relaible}}", 3, "'relaible' is no reliability: that is best_effort or reliable", "reliable"),
        ("publishers:\n- {name: a, type: b/C,\n   qos: {deadline: soon}}", 3, "`deadline` is a duration, not 'soon'", None),
        ("publishers: 3", 1, "'publishers' is a list", None),
        ("publishers:\n- x", 2, "an endpoint is a mapping with `name` and `type`", None),
        ("[]", 1, "an interface declaration is a mapping with publishers, subscriptions, …", None),
    ],
)  # fmt: skip
def test_a_broken_declaration_is_told_at_its_place(
    tmp_path: Path, text: str, line: int, message: str, suggestion: str | None
) -> None:
    problems = _checked(tmp_path, text, "subscriptions: []")
    (first,) = problems
    assert (first.code, first.message, first.suggestion) == ("ORC090", message, suggestion)
    assert first.span is not None
    assert (first.span.file, first.span.line) == ("demo_talk/params/talker.interface.yaml", line)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('role="publisher"', 'role="publishr"', "'publishr' is no role of a topic"),
        ('type="std_msgs/String" ', "", "<topic> needs a name and a type"),
        ("std_msgs/String", "String", "'String' is no type of an interface, as std_msgs/msg/String"),
        (
            'reliability="reliable"',
            'reliability="sure"',
            "'sure' is no reliability: that is best_effort or reliable",
        ),
        ("</interface>", "", "not XML: no element found"),
        ("<interface", "<!DOCTYPE interface []><interface", "a declaration has no document type"),
    ],
)
def test_broken_nodl_is_told_at_its_place(tmp_path: Path, old: str, new: str, message: str) -> None:
    files = {"a.launch.yaml": _LAUNCH, **_PACKAGE, "demo_talk/all.nodl.xml": _NODL.replace(old, new, 1)}
    problems = [problem for problem in checked(tmp_path, files) if problem.code == "ORC090"]
    assert [problem.message for problem in problems] == [message]
    assert problems[0].span is not None
    assert problems[0].span.file == "demo_talk/all.nodl.xml"
