"""What a person reads of a plan."""

from __future__ import annotations

import json
from dataclasses import replace
from difflib import unified_diff

import pytest

from orchestra.plan import codec
from orchestra.plan.conditions import (
    Alive,
    Dependency,
    ParameterFact,
    Ready,
    StateFact,
    TransformFact,
)
from orchestra.plan.model import (
    Argument,
    Component,
    ParameterFile,
    Plan,
    Process,
    Provenance,
    Skipped,
)
from orchestra.plan.reactions import (
    ChangeStateAction,
    DeferredAction,
    LoadAction,
    LogAction,
    RegisterAction,
    ShutdownAction,
    SignalAction,
    StartAction,
    StopAction,
    Trigger,
    TriggeredAction,
    TriggerEvent,
    UnregisterAction,
)
from orchestra.plan.render.details import Details
from orchestra.plan.render.formats import FORMATS
from orchestra.values import Limits, Restart, Stop
from tests.plan import records
from tests.plan.records import at, process

_TALKER = Process(
    id="/robot1/talker",
    kind="node",
    package="demo",
    executable="talker",
    name="talker",
    namespace="/robot1",
    command=("/opt/demo/talker", "--ros-args", "-r", "__node:=talker", "a b"),
    shell=False,
    prefix=(),
    environment={"LEVEL": "very high", "GONE": None},
    inherit_environment=True,
    cwd="/data",
    parameters={"rate": 2.0, "name": "yes", "list": (1, 2)},
    parameter_files=(ParameterFile("${run}/params/x.yaml", "/**: {}"),),
    remappings=(("chatter", "/chatter"), ("a", "b")),
    arguments=(),
    output={"stdout": ("screen", "log"), "both": ("own_log",)},
    emulate_tty=None,
    stdin=None,
    restart=Restart("on-failure", 1.0, 30.0, 10.0, 3),
    required=True,
    success_exit_codes=None,
    ready=Ready(None, "/robot1/chatter", 5.0),
    alive=None,
    lifecycle=None,
    depends_on=(Dependency("/clock", "ready", 20.0, at(9)), Dependency("/other", "exited", None, at(9))),
    stop=Stop("SIGTERM", 2.0, 0.5),
    limits=None,
    warm=None,
    machine=None,
    digest="d",
    location=at(7),
    provenance=Provenance(),
)


def _bare(identity: str, namespace: str | None, *, by_shell: bool = False) -> Process:
    return process(
        identity, "echo", "$HOME", executable=_TALKER.executable, namespace=namespace, shell=by_shell
    )


def _text(plan: Plan) -> str:
    return FORMATS["text"](plan)


def test_a_process_in_full() -> None:
    assert _text(records.plan(_TALKER)) == (
        "two.yaml: 1 process\n"
        "\n"
        "processes\n"
        "  /\n"
        "    robot1/\n"
        "      /robot1/talker  (node demo/talker, two.yaml:7:5)\n"
        "        command     /opt/demo/talker --ros-args -r __node:=talker 'a b'\n"
        "        folder      /data\n"
        "        environment LEVEL='very high'\n"
        "                    GONE unset\n"
        "        parameters  rate: 2.0\n"
        '                    name: "yes"\n'
        "                    list: [1, 2]\n"
        "        files       ${run}/params/x.yaml\n"
        "        remaps      chatter -> /chatter\n"
        "                    a -> b\n"
        "        output      stdout to screen and log, both to own_log\n"
        "        after       /clock is ready, within 20 s\n"
        "                    /other has exited\n"
        "        ready       at the first message on /robot1/chatter, within 5 s\n"
        "        restart     on-failure, after 1 s to 30 s, 3 times at most\n"
        "        stop        SIGTERM, after 2 s SIGTERM, after 0.5 s more SIGKILL\n"
        "        required    the run ends with it\n"
    )


def test_the_tree_follows_the_namespaces_and_keeps_the_order_of_the_plan() -> None:
    plan = records.plan(
        _bare("/b/deep/x", "/b/deep"),
        _bare("/root", "/"),
        _bare("sh", None, by_shell=True),
        _bare("/a/x", "/a"),
        _bare("/b/x", "/b"),
    )
    assert [line for line in _text(plan).splitlines()[3:] if "command" not in line] == [
        "  sh  (process, two.yaml:3:5)",
        "  /",
        "    /root  (process, two.yaml:3:5)",
        "    b/",
        "      /b/x  (process, two.yaml:3:5)",
        "      deep/",
        "        /b/deep/x  (process, two.yaml:3:5)",
        "    a/",
        "      /a/x  (process, two.yaml:3:5)",
    ]
    assert "    command     sh: echo $HOME\n" in _text(plan)
    assert "        command     echo '$HOME'\n" in _text(plan)


def test_a_node_more_changes_no_other_line() -> None:
    one = _text(records.plan(_bare("/a", "/"), _bare("/c", "/"))).splitlines()
    two = _text(records.plan(_bare("/a", "/"), _bare("/b", "/"), _bare("/c", "/"))).splitlines()
    changed = [line for line in unified_diff(one[1:], two[1:], n=0, lineterm="") if line[0] in "+-"]
    assert changed[2:] == ["+    /b  (process, two.yaml:3:5)", "+      command     echo '$HOME'"]


_REACTIONS: tuple[tuple[TriggerEvent, TriggeredAction], ...] = (
    (TriggerEvent("process_started"), LoadAction("/c", at(7))),
    (TriggerEvent("process_completed", "/a"), StopAction(("/a", "/b"), at(7))),
    (TriggerEvent("process_output", "/a", "stderr"), SignalAction(("/a",), "SIGUSR1", at(7))),
    (TriggerEvent("process_output", "/a"), RegisterAction("t5", at(7))),
    (
        TriggerEvent("state_changed", "/a", transition="configure", goal_state="inactive"),
        ChangeStateAction(("/a",), (1, 3), at(7)),
    ),
    (TriggerEvent("shutdown"), UnregisterAction("t1", at(7))),
    (TriggerEvent("run_started"), DeferredAction(1, at(7))),
)


def test_arguments_components_triggers_and_what_was_left_out() -> None:
    start, ended = TriggerEvent("run_started"), TriggerEvent("process_exited", "/a")
    plan = replace(
        records.plan(),
        arguments=(
            Argument("world", "arena", "big maze", "which", ("arena", "big maze"), at(1)),
            Argument("speed", "1.0", "1.0", None, None, at(2)),
            Argument("robot", None, None, None, None, at(2)),
            Argument("log", "$(dirname)/log", "/x/log", None, None, at(2)),
        ),
        components=(
            Component(
                id="/r/camera",
                name="camera",
                namespace="/r",
                package="image",
                plugin="image::Camera",
                container="/r/box",
                process=None,
                condition="started",
                parameters={"hz": 3},
                remappings=(("a", "b"),),
                extra_arguments={"use_intra_process_comms": True},
                lifecycle=None,
                location=at(4),
                provenance=Provenance(),
            ),
        ),
        triggers=(
            Trigger("t1", start, (LogAction("it's up", at(5)), StartAction("/b", at(5))), 2.5, False, at(5)),
            Trigger("t2", ended, (ShutdownAction("/a ended", at(6)),), None, False, at(6)),
            Trigger("t3", ended, (DeferredAction(0, at(6)),), None, True, at(6)),
            *(
                Trigger(f"t{number}", event, (action,), None, False, at(7), armed=number > 5, once=True)
                for number, (event, action) in enumerate(_REACTIONS, 4)
            ),
        ),
        skipped=(Skipped("node", "gui", "if", "$(var gui)", "false", at(8)),),
    )
    assert _text(plan) == (
        "two.yaml: 1 component, 10 triggers\n"
        "\n"
        "arguments\n"
        "  world := 'big maze'  (default arena)\n"
        "  speed := 1.0\n"
        "  robot := (no value)\n"
        "  log   := /x/log\n"
        "\n"
        "components\n"
        "  /r/camera: image/image::Camera in /r/box (not of this plan)"
        " hz=3 use_intra_process_comms=true a->b\n"
        "\n"
        "triggers\n"
        '  2.5 s after the start of the run: log "it\'s up"; start /b  (two.yaml:5:5)\n'
        "  the end of /a: shut down, /a ended  (two.yaml:6:5)\n"
        "  the end of /a: decided when it happens  (two.yaml:6:5)\n"
        "  the start of a process that is not started: the first time, load /c  (two.yaml:7:5)\n"
        "  the last end of /a, once t5 is registered: the first time, stop /a /b  (two.yaml:7:5)\n"
        "  output of /a on stderr: the first time, send SIGUSR1 to /a  (two.yaml:7:5)\n"
        "  output of /a: the first time, register t5  (two.yaml:7:5)\n"
        "  a change of state of /a by configure to inactive: the first time,"
        " configure, activate /a  (two.yaml:7:5)\n"
        "  the shutdown of the run: the first time, unregister t1  (two.yaml:7:5)\n"
        "  the start of the run: the first time, decided when it happens"
        "  (two.yaml:7:5)\n"
        "\n"
        "skipped\n"
        "  node gui: if $(var gui), which is false  (two.yaml:8:5)\n"
    )


def test_lines_of_a_program_stand_below_each_other_and_long_texts_are_cut() -> None:
    process = replace(_TALKER, command=("python3", "-c", "a\nb"), parameters={"urdf": "x" * 5000})
    text = _text(records.plan(process))
    assert "        command     python3 -c 'a\n                    b'\n" in text
    assert f'        parameters  urdf: "{"x" * 399} ... (4602 more characters, see --format json)\n' in text


def test_a_plan_of_nothing_says_so() -> None:
    assert _text(records.plan()) == "two.yaml: nothing to run\n"


def test_a_log_condition_is_shown_as_an_expression() -> None:
    plan = records.plan(replace(_bare("/a", "/"), ready=Ready("up .*", None, None)))
    assert "ready       at a line of output that matches 'up .*'\n" in _text(plan)


def test_all_that_is_awaited_has_a_line_and_the_last_says_how_long() -> None:
    ready = Ready(
        "up",
        "/m",
        20.0,
        "h:1",
        "http://h/",
        "f",
        ("test", "a b"),
        notify=True,
        node="/n",
        topic="/t",
        service="/s",
        action="/a",
        parameter=ParameterFact("/n", "p", (1, 2)),
        lifecycle=StateFact("/n", "active"),
        tf=TransformFact("map", "odom"),
        interval=0.5,
    )
    assert _said(replace(_TALKER, ready=ready), "ready") == [
        "at the first message on /m",
        "and at a publisher on /t",
        "and at the node /n",
        "and at a server of /s",
        "and at a server of the action /a",
        "and at the parameter p = [1, 2] of /n",
        "and at the state active of /n",
        "and at a transform from odom to map",
        "and at a line of output that matches 'up'",
        "and at a connection to h:1",
        "and at an answer of http://h/",
        "and at the file f",
        "and at the success of: test 'a b'",
        "and at its own word, READY=1, within 20 s, tried every 0.5 s",
    ]


def test_signs_of_life_limits_and_dependencies_are_said() -> None:
    alive = Alive(3.0, "/m", 5.0, 2.0, ("check", "a b"), failures=1, abort=True)
    process = replace(
        _TALKER,
        alive=alive,
        stdin=True,
        restart=Restart("always", growth=1.5, jitter=0.25),
        depends_on=(Dependency("/clock", "ready", 20.0, at(9), required=False),),
        limits=Limits(
            (0, 1, 2, 6, 8),
            True,
            -5,
            "fifo",
            20,
            3 << 29,
            {"as": (1 << 30, 1 << 30), "core": (0, -1), "nofile": (1024, 4096)},
        ),
    )
    assert _said(process, "alive") == [
        "says WATCHDOG=1 every 3 s",
        "5 messages a second on /m, on the average of 2 s",
        "success of: check 'a b'",
        "  started every 5 s, 2 s long at most, 1 failure is a hang",
        "ended with SIGABRT where it hangs",
    ]
    assert _said(process, "limits") == [
        "cores 0-2, 6, 8, which no other process has",
        "nice -5",
        "scheduler fifo at 20",
        "memory 1536M",
        "as 1G",
        "core 0:unlimited",
        "nofile 1024:4096",
    ]
    assert _said(process, "after") == ["/clock is ready, within 20 s, if that can come about"]
    assert _said(process, "restart") == [
        "always, after 0 s to 30 s, growing by the factor 1.5, up to 25 % more at random"
    ]
    assert _said(process, "stdin") == ["what is typed"]


def _said(process: Process, label: str) -> list[str]:
    """Return what stands behind a label."""
    lines = Details().of(process, "").splitlines()
    first = next(index for index, line in enumerate(lines) if line.startswith(label))
    last = next((index for index in range(first + 1, len(lines)) if lines[index][0] != " "), len(lines))
    return [line[12:] for line in lines[first:last]]


@pytest.mark.parametrize("name", sorted(FORMATS))
def test_the_same_plan_gives_the_same_text(name: str) -> None:
    plan = records.plan(_TALKER, _bare("/a", "/"))
    assert FORMATS[name](plan) == FORMATS[name](codec.loads(codec.dumps(plan)))


def test_json_is_the_plan_itself() -> None:
    plan = records.plan(_TALKER)
    assert json.loads(FORMATS["json"](plan)) == codec.encode(plan)
