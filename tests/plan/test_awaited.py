"""Readiness, signs of life, limits and terminals: from what is written to the plan."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code, Severity
from orchestra.plan import codec
from orchestra.plan.conditions import Alive, ParameterFact, Ready, StateFact, TransformFact
from orchestra.values import Limits, Restart
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process

_NOTHING = Ready(None, None, None)


def _node(folder: Path, keys: str) -> Process:
    """Return the process of a node with these keys, in the namespace /robot."""
    found = outcome(folder, f"launch:\n- node: {{exec: a, name: lidar, namespace: robot, {keys}}}")
    assert not len(found.problems), list(found.problems)
    return found.process("/robot/lidar")


READY = [
    ("log: 'up [0-9]+'", {"log": "up [0-9]+"}),
    ("message: scan, timeout: 2.5", {"message": "/robot/scan", "timeout": 2.5}),
    ("message: /scan", {"message": "/scan"}),
    ("topic: ~/points", {"topic": "/robot/lidar/points"}),
    ("node: true", {"node": "/robot/lidar"}),
    ("node: driver", {"node": "/robot/driver"}),
    ("node: /__hidden", {"node": "/__hidden"}),
    ("service: get, node: false", {"service": "/robot/get"}),
    ("action: go", {"action": "/robot/go"}),
    ("parameter: rate", {"parameter": ParameterFact("/robot/lidar", "rate", None)}),
    (
        "parameter: {name: rate, value: 2.0, node: true}",
        {"parameter": ParameterFact("/robot/lidar", "rate", 2.0)},
    ),
    (
        "parameter: {name: ids, value: [1, 2], node: /other}",
        {"parameter": ParameterFact("/other", "ids", (1, 2))},
    ),
    ("parameter: {name: mode, value: '5'}", {"parameter": ParameterFact("/robot/lidar", "mode", "5")}),
    ("lifecycle: active", {"lifecycle": StateFact("/robot/lidar", "active")}),
    ("lifecycle: {node: map, state: inactive}", {"lifecycle": StateFact("/robot/map", "inactive")}),
    ("tf: {parent: map, child: robot/odom}", {"tf": TransformFact("map", "robot/odom")}),
    ("tcp: 8080, interval: 1", {"tcp": "localhost:8080", "interval": 1.0}),
    ("http: 'http://localhost:80/x'", {"http": "http://localhost:80/x"}),
    ("file: out/done", {"file": "out/done"}),
    ("command: test -e 'a b'", {"command": ("test", "-e", "a b")}),
    ("command: [test, -e, a b]", {"command": ("test", "-e", "a b")}),
    ("notify: yes", {"notify": True}),
    ("notify: true, tcp: '[::1]:80', log: x", {"notify": True, "tcp": "[::1]:80", "log": "x"}),
]


@pytest.mark.parametrize(("keys", "facts"), READY)
def test_every_condition_comes_into_the_plan(tmp_path: Path, keys: str, facts: dict[str, object]) -> None:
    ready = _node(tmp_path, f"ready: {{{keys}}}").ready
    assert ready is not None
    assert {key: getattr(ready, key) for key in facts} == facts
    others = set(Ready.__dataclass_fields__) - facts.keys()
    assert {key: getattr(ready, key) for key in others} == {key: getattr(_NOTHING, key) for key in others}


def test_values_of_conditions_may_be_substituted(tmp_path: Path) -> None:
    text = """launch:
- arg: {name: n, default: "7"}
- arg: {name: yes, default: "true"}
- node:
    exec: a
    name: a
    namespace: ""
    ready:
      log: up $(var n)
      message: t$(var n)
      node: $(var yes)
      tcp: 80$(var n)
      file: $(var n).txt
      command: test $(var n)
      notify: $(var yes)
      timeout: $(var n)
      interval: 0.$(var n)
      parameter: {name: p$(var n), value: $(var n), node: n$(var n)}
      lifecycle: $(if $(var yes) active inactive)
      tf: {parent: map, child: r$(var n)}
    alive: {notify: $(var n), message: t, min_rate: $(var n), command: [x, $(var n)], failures: $(var n), abort: $(var yes)}
    restart: $(if $(var yes) always no)
    limits: {cores: "0-$(var n)", nice: $(var n), memory: "$(var n)M", rlimits: {nofile: "$(var n)"}}
    stdin: $(var yes)
    lifecycle: $(if $(var yes) active none)
"""
    found = outcome(tmp_path, text)
    assert not len(found.problems), list(found.problems)
    process = found.process("/a")
    assert process.ready == Ready(
        log="up 7",
        message="/t7",
        timeout=7.0,
        tcp="localhost:807",
        file="7.txt",
        command=("test", "7"),
        notify=True,
        node="/a",
        parameter=ParameterFact("/n7", "p7", 7),
        lifecycle=StateFact("/a", "active"),
        tf=TransformFact("map", "r7"),
        interval=0.7,
    )
    assert process.alive == Alive(7.0, "/t", 7.0, 2.0, ("x", "7"), failures=7, abort=True)
    assert process.restart == Restart("always")
    assert process.limits == Limits(cores=tuple(range(8)), nice=7, memory=7 << 20, rlimits={"nofile": (7, 7)})
    assert (process.stdin, process.lifecycle, process.kind) == (True, "active", "lifecycle_node")
    assert codec.loads(codec.dumps(found.plan)) == found.plan


def test_names_go_through_the_remaps_of_the_node(tmp_path: Path) -> None:
    keys = (
        "remap: [{from: scan, to: /front/scan}, {from: 'rosservice://get', to: other}, {from: go, to: went}, "
        "{from: run/_action/send_goal, to: ran/_action/send_goal}, {from: __node, to: x}], "
        "ready: {message: scan, topic: ~/scan, service: get, action: go, node: scan}, "
        "alive: {message: scan, min_rate: 5}"
    )
    found = outcome(tmp_path, f"launch:\n- node: {{exec: a, name: lidar, namespace: robot, {keys}}}")
    (process,) = found.plan.processes
    ready, alive = process.ready, process.alive
    assert ready is not None
    assert (ready.message, ready.topic, ready.service) == ("/front/scan", "/robot/lidar/scan", "/robot/other")
    # rcl remaps the services of an action, never its name, and never the name of another node.
    assert (ready.action, ready.node) == ("/robot/go", "/robot/scan")
    assert alive == Alive(message="/front/scan", min_rate=5.0)
    moved = _node(tmp_path, keys.replace("action: go", "action: run").replace(", {from: __node, to: x}", ""))
    assert moved.ready is not None
    assert moved.ready.action == "/robot/ran"


def test_a_program_sees_names_in_the_pushed_namespace(tmp_path: Path) -> None:
    text = "launch:\n- push_ros_namespace: {namespace: robot}\n- executable: {cmd: a, ready: {node: n, topic: t}}"
    ready = outcome(tmp_path, text).process("a").ready
    assert ready is not None
    assert (ready.node, ready.topic) == ("/robot/n", "/robot/t")


def test_what_is_not_said_of_a_sign_of_life_is_as_the_plan_has_it(tmp_path: Path) -> None:
    assert _node(tmp_path, "alive: {command: check}").alive == Alive(command=("check",))
    keys = "alive: {command: check 1, interval: 1, timeout: 0.5, failures: 1}"
    assert _node(tmp_path, keys).alive == Alive(command=("check", "1"), interval=1.0, timeout=0.5, failures=1)
    assert _node(tmp_path, "alive: {notify: 3}").alive == Alive(notify=3.0)
    slow = "alive: {message: /m, min_rate: 0.1, window: 10}"
    assert _node(tmp_path, slow).alive == Alive(message="/m", min_rate=0.1, window=10.0)


def test_limits_come_into_the_plan_and_make_a_process_another_one(tmp_path: Path) -> None:
    keys = (
        "limits: {cores: [6, 0-2], exclusive: true, nice: -5, scheduler: fifo, priority: 20, memory: 2G, "
        "memory_lock: unlimited, rlimits: {nofile: 1024:4096, core: unlimited, as: 1G}}"
    )
    process = _node(tmp_path, keys)
    rlimits: dict[str, tuple[int, ...]] = {
        "as": (1 << 30, 1 << 30),
        "core": (-1, -1),
        "memlock": (-1, -1),
        "nofile": (1024, 4096),
    }
    assert process.limits == Limits((0, 1, 2, 6), True, -5, "fifo", 20, 2 << 30, rlimits)
    assert process.digest != _node(tmp_path, keys.replace("20", "21")).digest
    assert _node(tmp_path, "stdin: true").digest != _node(tmp_path, "stdin: false").digest


def test_restart_may_be_one_word(tmp_path: Path) -> None:
    for word in ("no", "on-failure", "always"):
        restart = _node(tmp_path, f"restart: {word}").restart
        assert restart is not None
        assert restart == Restart(restart.policy)
        assert restart.policy == word
    whole = "restart: {policy: always, delay: 1, max_delay: 8, growth: 1.5, jitter: 0.25, budget: 0}"
    assert _node(tmp_path, whole).restart == Restart("always", 1.0, 8.0, 10.0, 0, 1.5, 0.25)


def test_lifecycle_active_is_what_autostart_is(tmp_path: Path) -> None:
    text = """launch:
- node: {exec: a, name: a, lifecycle: active}
- lifecycle_node: {exec: a, name: b, namespace: "", lifecycle: active}
- lifecycle_node: {exec: a, name: c, namespace: "", autostart: true}
"""
    found = outcome(tmp_path, text)
    assert not len(found.problems)
    assert {(process.kind, process.lifecycle) for process in found.plan.processes} == {
        ("lifecycle_node", "active")
    }


def test_a_dependency_that_can_be_done_without(tmp_path: Path) -> None:
    text = """launch:
- executable: {cmd: a}
- executable:
    cmd: b
    depends_on:
    - {process: a, required: false, timeout: 3}
    - {process: nobody, required: false}
    - {node: /nobody, required: $(not true)}
    - {label: nothing, required: false}
- executable:
    cmd: c
    depends_on: [{process: a, required: false}, {process: a}]
- executable:
    cmd: d
    depends_on: [{process: a}, {process: a, required: false}]
"""
    found = outcome(tmp_path, text)
    assert not len(found.problems), list(found.problems)

    def edges(name: str) -> list[tuple[str, str, float | None, bool]]:
        return [
            (edge.process, edge.condition, edge.timeout, edge.required)
            for edge in found.process(name).depends_on
        ]

    assert edges("b") == [("a", "started", 3.0, False)]
    assert edges("c") == edges("d") == [("a", "started", None, True)]


def test_one_process_reads_what_is_typed(tmp_path: Path) -> None:
    text = """launch:
- executable: {cmd: a, stdin: true}
- executable: {cmd: b, stdin: true, if: "false"}
- executable: {cmd: c, stdin: "off"}
- group: {for_each: {i: [1, 2]}, children: [{executable: {cmd: d, stdin: true}}]}
"""
    found = outcome(tmp_path, text)
    first, second = found.problems
    assert (first.code, first.message) == (
        Code.CONFLICTING_KEYS,
        "'d' and 'a' cannot both read what is typed",
    )
    assert second.message == "'d#2' and 'a' cannot both read what is typed"
    assert first.span is not None
    assert (first.span.line, first.span.column) == (5, 74)
    assert first.notes[0].startswith("`stdin` of 'a' is at ")
    assert [process.stdin for process in found.plan.processes] == [True, None, True, True]


# What stands in a node, the words that are marked, what is said, and what is suggested.
FAULTS = [
    ("ready: {timeout: 3}", "ready", "`ready` says what is awaited: one or more of ", None),
    ("ready: {}", "ready", "`ready` says what is awaited: one or more of ", None),
    ("ready: {notify: off, node: false}", "ready", "`ready` waits for nothing: all of it is false", None),
    ("ready: {log: '(up'}", "(up", "this is no regular expression: missing )", None),
    ("ready: {tcp: host}", "host", "'host' lacks a port", None),
    ("ready: {tcp: '::1:80'}", "::1:80", "an IPv6 address with a port stands in", "[::1]:80"),
    ("ready: {http: localhost/x}", "localhost/x", "'localhost/x' is no URL", "http://localhost/x"),
    ("ready: {file: ''}", "", "expected a path, found nothing", None),
    ("ready: {command: []}", "[]", "the command is empty", None),
    ("ready: {command: ''}", "", "the command is empty", None),
    ("ready: {notify: 5}", "5", "expected true or false, found '5'", None),
    ("ready: {notify: true, interval: 1}", "interval", "`interval` goes with `tcp`, `http`, `file` or", None),
    ("ready: {tcp: 80, interval: 0}", "0", "expected a number of seconds, at least 0.01, found '0'", None),
    ("ready: {tcp: 80, interval: $(env I 0)}", "$(env I 0)", "expected a number of seconds, at least", None),
    ("ready: {lifecycle: activ}", "activ", "expected one of unconfigured, inactive, ", "active"),
    ("ready: {lifecycle: $(env X none)}", "$(env X none)", "expected one of unconfigured, inactive, ", None),
    ("ready: {lifecycle: {node: a}}", "lifecycle", "the key 'state' is missing", None),
    ("ready: {parameter: {value: 5}}", "parameter", "the key 'name' is missing", None),
    ("ready: {parameter: ''}", "", "expected the name of a parameter, found nothing", None),
    ("ready: {parameter: {name: a, value: [1, a]}}", "a", "a list must hold values of one type", None),
    ("ready: {tf: map}", "map", "expected a mapping, found 'map'", None),
    ("ready: {tf: {parent: map}}", "tf", "the key 'child' is missing", None),
    ("ready: {tf: {parent: map, child: map}}", "map}}", "`tf` is between two frames", None),
    ("ready: {tf: {parent: /map, child: a}}", "/map", "the id of a frame does not begin with '/'", "map"),
    ("ready: {message: a b}", "a b", "'a b' cannot be a topic: only letters", "a_b"),
    ("ready: {topic: 1x}", "1x", "'1x' cannot be a topic: no part may start with a digit", None),
    ("ready: {service: a//b}", "a//b", "'a//b' cannot be a service: it must not contain '//'", "a/b"),
    ("ready: {action: a-b}", "a-b", "'a-b' cannot be an action: only letters", "a_b"),
    ("ready: {node: a-b}", "a-b", "'a-b' cannot be a node: only letters", "a_b"),
    ("ready: {node: /a/}", "/a/", "'/a/' cannot be a node: it must not end with '/'", "/a"),
    ("ready: {mesage: a}", "mesage", "unknown key 'mesage'", "message"),
    ("alive: {}", "alive", "`alive` names a sign of life", None),
    ("alive: {abort: true}", "alive", "`alive` names a sign of life", None),
    ("alive: {message: a}", "alive", "`message` and `min_rate` go together", None),
    ("alive: {min_rate: 3}", "alive", "`message` and `min_rate` go together", None),
    ("alive: {message: a, min_rate: 0}", "0", "expected a number of messages a second, found '0'", None),
    ("alive: {message: a, min_rate: .2}", ".2", "in 2 s there is less than one message at 0.2", None),
    ("alive: {message: a b, min_rate: 5}", "a b", "'a b' cannot be a topic", "a_b"),
    ("alive: {notify: 0}", "0", "expected a number of seconds above 0, found '0'", None),
    ("alive: {notify: 3, window: 3}", "window", "`window` goes with `message`", None),
    ("alive: {notify: 3, failures: 3}", "failures", "`failures` goes with `command`", None),
    ("alive: {command: a, failures: 0}", "0", "expected a whole number above 0, found '0'", None),
    ("alive: {command: a, timeout: 0}", "0", "expected a number of seconds above 0, found '0'", None),
    ("restart: allways", "allways", "expected one of no, on-failure, always", "always"),
    ("restart: [always]", "[always]", "expected a mapping, found a list", None),
    ("restart: ~", "~", "expected a mapping, found nothing", None),
    ("restart: {delay: 1}", "restart", "the key 'policy' is missing", None),
    ("restart: {policy: always, growth: 0.9}", "0.9", "expected a factor of 1 or more, found '0.9'", None),
    ("restart: {policy: always, jitter: 1.1}", "1.1", "expected a share from 0 to 1, found '1.1'", None),
    ("restart: {policy: always, budget: -1}", "-1", "expected a whole number, 0 or more, found '-1'", None),
    ("restart: {policy: no, delay: 4, max_delay: 2}", "2", "the longest delay, 2 s, is shorter than", None),
    ("stop: {timeout: -1}", "-1", "expected a number of seconds, found '-1'", None),
    ("stop: {signal: TREM}", "TREM", "there is no signal 'TREM'", "SIGTERM"),
    ("limits: {exclusive: true}", "exclusive", "`exclusive` goes with `cores`", None),
    ("limits: {cores: 3-1}", "3-1", "the range 3-1 is empty", "1-3"),
    ("limits: {cores: [1, 0-1]}", "1", "core 1 stands twice", None),
    ("limits: {cores: []}", "[]", "a process needs a core to run on", None),
    ("limits: {nice: 20}", "20", "expected a whole number from -20 to 19, found '20'", None),
    ("limits: {nice: $(env N 1.5)}", "$(env N 1.5)", "expected a whole number from -20 to 19", None),
    (
        "limits: {scheduler: fifi, priority: 3}",
        "fifi",
        "expected one of other, batch, idle, fifo, rr",
        "fifo",
    ),
    ("limits: {scheduler: fifo}", "fifo", "the scheduler fifo needs a `priority` from 1 to 99", None),
    ("limits: {scheduler: idle, priority: 3}", "3", "`priority` goes with the schedulers fifo and rr", None),
    ("limits: {priority: 3}", "priority", "`priority` goes with `scheduler: fifo` or", None),
    ("limits: {scheduler: rr, priority: 0}", "0", "expected a whole number from 1 to 99, found '0'", None),
    ("limits: {memory: 0}", "0", "a process needs memory", None),
    ("limits: {memory: 2 gigs}", "2 gigs", "expected a size as 512M or 2G", "2G"),
    ("limits: {memory_lock: inf}", "inf", "expected a number or unlimited, found 'inf'", "unlimited"),
    ("limits: {memory_lock: 1, rlimits: {memlock: 1}}", "rlimits", "`memory_lock` and `memlock`", None),
    ("limits: {rlimits: {nofiles: 3}}", "nofiles", "unknown key 'nofiles'", "nofile"),
    ("limits: {rlimits: {nofile: 3:1}}", "3:1", "the soft limit 3 is above the hard one 1", "1:3"),
    ("stdin: maybe", "maybe", "expected true or false, found 'maybe'", None),
    ("lifecycle: inactive", "inactive", "expected 'active', found 'inactive'", "active"),
    ("depends_on: [{node: b, required: perhaps}]", "perhaps", "expected true or false", None),
]


@pytest.mark.parametrize(("keys", "marked", "message", "suggestion"), FAULTS)
def test_a_mistake_is_told_once_at_the_words_that_are_wrong(
    tmp_path: Path, keys: str, marked: str, message: str, suggestion: str | None
) -> None:
    text = f"launch:\n- node: {{exec: a, name: lidar, namespace: robot,\n    {keys}}}"
    found = outcome(tmp_path, text, environment={"PATH": "/bin"})
    (problem,) = found.problems
    assert problem.message.startswith(message)
    assert problem.suggestion == suggestion
    assert problem.span is not None
    assert problem.span.line == 3
    assert text.splitlines()[2][problem.span.column - 1 :].startswith(marked)
    assert [process.id for process in found.plan.processes] == ["/robot/lidar"]


OTHER_FAULTS = [
    ("executable: {cmd: a, ready: {node: true}}", "a program has no node of its own that is known"),
    ("executable: {cmd: a, ready: {parameter: p}}", "a program has no node of its own that is known"),
    ("node: {exec: a, ready: {lifecycle: active}}", "the name of its own node is not known"),
    ("node: {exec: a, lifecycle: active}", "a node that is brought to a state needs a `name`"),
    ("executable: {cmd: a, lifecycle: active}", "unknown key 'lifecycle'"),
    (
        "node_container: {exec: a, name: a, namespace: '', lifecycle: active}",
        "the node of a container has no managed life cycle",
    ),
    (
        "lifecycle_node: {exec: a, name: a, namespace: '', lifecycle: active, autostart: false}",
        "`autostart` and `lifecycle` say the same thing twice",
    ),
    ("executable: {cmd: a, depends_on: [{process: b}]}", "there is no process 'b' to wait for"),
    (
        "executable: {cmd: a, depends_on: [{process: a, required: false}]}",
        "these wait for each other: a waits for a",
    ),
]


def test_who_waits_for_an_active_node_is_told_how(tmp_path: Path) -> None:
    text = """launch:
- node: {exec: a, name: a, lifecycle: active}
- executable: {cmd: b, depends_on: [{node: a, condition: ready}]}
"""
    (problem,) = outcome(tmp_path, text).problems
    assert problem.code is Code.NEVER_READY
    assert problem.notes[0].endswith("give it `ready: {lifecycle: active}`, say")
    cured = outcome(
        tmp_path, text.replace("lifecycle: active}", "lifecycle: active, ready: {lifecycle: active}}")
    )
    assert not len(cured.problems)


@pytest.mark.parametrize(("action", "message"), OTHER_FAULTS)
def test_what_cannot_be_is_told(tmp_path: Path, action: str, message: str) -> None:
    (problem,) = outcome(tmp_path, f"launch:\n- {action}", environment={"PATH": "/bin"}).problems
    assert problem.message.startswith(message)
    assert problem.span is not None
    assert problem.span.line == 2


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("respawn: true", "restart: always"),
        ("restart: always", "respawn: true"),
        ("respawn_delay: 1", "restart: {policy: no}"),
    ],
)
def test_a_restart_beside_a_respawn_names_both_places(tmp_path: Path, first: str, second: str) -> None:
    text = f"launch:\n- node:\n    exec: a\n    {first}\n    {second}"
    (problem,) = outcome(tmp_path, text).problems
    assert problem.message.endswith("say the same thing twice: leave one of them out")
    assert problem.span is not None
    assert (problem.span.line, problem.span.column) == (5, 5)
    (note,) = problem.notes
    assert note.startswith(f"`{first.partition(':')[0]}` is at ")
    assert note.endswith("main.yaml:4:5")


def test_a_pattern_that_is_none_is_shown_as_plain_text(tmp_path: Path) -> None:
    text = "launch:\n- executable: {cmd: a, ready: {log: '[ERROR] (up'}}"
    (problem,) = outcome(tmp_path, text).problems
    assert problem.notes == (r"as plain text it is written: \\[ERROR\\] \\(up",)
    again = text.replace("[ERROR] (up", r"\\[ERROR\\] \\(up")
    ready = outcome(tmp_path, again).process("a").ready
    assert ready is not None
    assert ready.log == r"\[ERROR\] \(up"


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        (r"'\[INFO\] up \d+'", r"\\[INFO\\] up \\d+"),
        (r'"\\.\\\\w"', r"\\.\\w"),
        (r"'\\\d'", r"\\\\d"),
        (r"'\\[x\\] \$(now)'", None),
        (r"'$(env X a)\d'", None),
        ("up", None),
    ],
)
def test_a_backslash_that_is_lost_is_a_warning(tmp_path: Path, written: str, meant: str | None) -> None:
    text = f"launch:\n- executable: {{cmd: a, ready: {{log: {written}}}}}"
    problems = outcome(tmp_path, text, environment={"PATH": "/bin"}).problems
    found = [(problem.code, problem.severity, problem.notes) for problem in problems]
    note = (f"without quotes, or in single ones: {meant}",)
    assert found == ([] if meant is None else [(Code.SURPRISING_SCALAR, Severity.WARNING, note)])
