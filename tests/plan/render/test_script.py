"""Plans as scripts: what they start is what Orchestra would start."""

from __future__ import annotations

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.plan.conditions import Dependency, Ready
from orchestra.plan.model import ParameterFile
from orchestra.plan.reactions import LogAction, StartAction, Trigger, TriggerEvent
from orchestra.plan.render.setting import Additions, Setting
from orchestra.plan.render.shell import script
from orchestra.values import Limits, Restart, Stop
from orchestra.wheels import DONE, LIBRARY_PATH
from tests.plan.records import at, node, plan, process, words

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from orchestra.plan.model import Plan

_TELL = """\
import json, os, sys
told = {
    "words": [os.fsencode(word).hex() for word in sys.argv[2:]],
    "environment": {os.fsencode(k).hex(): os.fsencode(v).hex() for k, v in os.environ.items()},
    "cwd": os.getcwd(),
}
with open(sys.argv[1], "w") as file: json.dump(told, file)
"""
_PATIENCE = 60.0
_BY_SHELL = {"shell": True}


def _script(folder: Path, wanted: Plan, setting: Setting | None = None) -> Path:
    path = folder / "run.sh"
    text = script.render(wanted, setting or Setting())
    path.write_bytes(text.encode(errors="surrogateescape"))
    return path


def _run(path: Path, **changes: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["bash", str(path)],
        cwd=path.parent,
        env={**os.environ, "TMPDIR": str(path.parent), **changes},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        errors="replace",
        timeout=60,
        check=False,
    )


@contextmanager
def _running(path: Path) -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen(
        ["bash", str(path)],
        cwd=path.parent,
        env={**os.environ, "TMPDIR": str(path.parent)},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    ) as running:
        try:
            yield running
        finally:
            if running.poll() is None:
                running.kill()


def _until(path: Path) -> None:
    deadline = time.monotonic() + _PATIENCE
    while not path.exists():
        assert time.monotonic() < deadline, f"{path} does not come"
        time.sleep(0.02)


def _told(folder: Path) -> dict[str, Any]:
    told: dict[str, Any] = json.loads((folder / "told.json").read_text())
    return told


def _hex(text: str) -> str:
    return text.encode(errors="surrogateescape").hex()


@settings(
    max_examples=15,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(
    st.lists(words, max_size=4),
    st.dictionaries(st.sampled_from(["A", "B_1", "odd-name", "a.b"]), words | st.none(), max_size=3),
    st.sampled_from(["C", "C.UTF-8"]),
)
def test_every_byte_of_words_and_variables_arrives(
    tmp_path: Path, arguments: list[str], environment: dict[str, str | None], locale: str
) -> None:
    asked = process(
        "tell", sys.executable, "-c", _TELL, str(tmp_path / "told.json"), *arguments, environment=environment
    )
    done = _run(_script(tmp_path, plan(asked)), LC_ALL=locale, A="inherited")
    assert done.returncode == 0, done.stderr
    run = done.stderr.partition("run directory: ")[2].partition("\n")[0]
    told = _told(tmp_path)
    assert told["words"] == [_hex(word.replace("${run}", run)) for word in arguments]
    expected = {"A": "inherited", **environment}
    for name, value in expected.items():
        filled = None if value is None else _hex(value.replace("${run}", run))
        assert told["environment"].get(_hex(name)) == filled


@settings(
    max_examples=15,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(
    st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=60),
    st.sampled_from(["", "${run}", "END\n", "$x `id` \\ \\\\\n${run}\nEND\n"]),
)
def test_files_are_written_as_they_are(tmp_path: Path, text: str, piece: str) -> None:
    content = text + piece
    asked = node(
        "/a",
        *("sh", "-c", 'cat "$1"; echo "<$2>"', "-", "${run}/params/a.yaml", "${run}"),
        parameter_files=(ParameterFile("${run}/params/a.yaml", content),),
    )
    path = _script(tmp_path, plan(asked))
    done = subprocess.run(
        ["bash", str(path)],
        env={**os.environ, "TMPDIR": str(tmp_path)},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=60,
        check=False,
    )
    got, _, run = done.stdout.decode().removesuffix(">\n").rpartition("<")
    # A file that is written as bytes has no run directory in it that could be filled in.
    plain = not content.endswith("\n") or "\r" in content
    assert got == (content if plain else content.replace("${run}", run))


def test_a_shell_command_is_one_line_for_the_shell(tmp_path: Path) -> None:
    asked = process("a", "echo", "one", "&&", "echo", '"$A two"', **_BY_SHELL, environment={"A": "it's"})
    assert _run(_script(tmp_path, plan(asked))).stdout == "one\nit's two\n"


def test_a_process_that_inherits_nothing_has_what_is_said_and_what_it_needs(tmp_path: Path) -> None:
    asked = process(
        *("tell", sys.executable, "-c", _TELL, str(tmp_path / "told.json")),
        environment={"A": "x y"},
        inherit_environment=False,
        cwd=str(tmp_path),
    )
    additions = Additions({"B": "not for it"}, {}, {}, {"NEEDED": "${run}/x"}, {})
    done = _run(_script(tmp_path, plan(asked), Setting(additions=additions)))
    told = _told(tmp_path)
    names = {bytes.fromhex(name).decode() for name in told["environment"]}
    assert done.returncode == 0, done.stderr
    assert names - {"LC_CTYPE", DONE, LIBRARY_PATH} == {"A", "NEEDED", "ORCHESTRA_RUN", "ORCHESTRA_PROCESS"}
    assert told["cwd"] == str(tmp_path)


def test_what_a_run_adds_is_there(tmp_path: Path) -> None:
    additions = Additions(
        {"PLAIN": "${run}/logs"},
        {"FIRST": "/ours"},
        {"LAST": "/ours"},
        {},
        {"${run}/some.xml": b"<a>$x\xff</a>"},
    )
    told = 'echo "$PLAIN|$FIRST|$LAST|$ORCHESTRA_PROCESS|${ORCHESTRA_RUN#*-}|$PPID"; cat "$1"'
    asked = process("a", "sh", "-c", told, "-", "${run}/some.xml")
    path = _script(tmp_path, plan(asked), Setting(additions=additions))
    done = _run(path, FIRST="/theirs", LAST="/theirs")
    first, _, content = done.stdout.partition("\n")
    plain, before, after, name, keeper, parent = first.split("|")
    assert plain.endswith("/logs")
    assert (before, after, name) == ("/ours:/theirs", "/theirs:/ours", "a")
    assert keeper == parent
    assert content == "<a>$x�</a>"


@pytest.mark.parametrize(
    ("sent", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)]
)
def test_a_signal_ends_everything_gently(tmp_path: Path, sent: signal.Signals, status: int) -> None:
    """Each process hears the signal that it wants."""
    program = """trap 'echo ended >>"$1"; exit 0' INT; touch "$2"; while :; do sleep 0.05; done"""
    started = [
        process(name, "sh", "-c", program, "-", str(tmp_path / "log"), str(tmp_path / name)) for name in "ab"
    ]
    with _running(_script(tmp_path, plan(*started))) as running:
        for name in "ab":
            _until(tmp_path / name)
        running.send_signal(sent)
        assert running.wait(_PATIENCE) == status
    assert (tmp_path / "log").read_text() == "ended\n" * 2


def test_what_does_not_heed_signals_is_killed_with_all_that_it_has_started(tmp_path: Path) -> None:
    program = """trap '' INT TERM; sleep 1000 & echo $! >"$1.new"; mv "$1.new" "$1"; wait"""
    stop = Stop(timeout=0.3, kill_timeout=0.3)
    stubborn = process("c", "sh", "-c", program, "-", str(tmp_path / "pid"), stop=stop)
    with _running(_script(tmp_path, plan(stubborn))) as running:
        _until(tmp_path / "pid")
        running.send_signal(signal.SIGINT)
        assert running.wait(_PATIENCE) == 130
    pid = int((tmp_path / "pid").read_text())
    deadline = time.monotonic() + _PATIENCE
    while _lives(pid):
        assert time.monotonic() < deadline
        time.sleep(0.02)


def _lives(pid: int) -> bool:
    """Return whether a process is there that has not ended."""
    try:
        with open(f"/proc/{pid}/stat") as file:  # noqa: PTH123 - it is no file
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def test_the_end_of_what_is_required_ends_the_rest_with_its_status(tmp_path: Path) -> None:
    wanted = process("wanted", "sh", "-c", "exit 7", required=True)
    other = process("other", "sleep", "1000")
    done = _run(_script(tmp_path, plan(other, wanted)))
    assert done.returncode == 7
    assert "wanted has ended with status 7" in done.stderr


def test_a_failure_of_another_process_is_the_status_at_the_end(tmp_path: Path) -> None:
    done = _run(_script(tmp_path, plan(process("a", "false"), process("b", "true"))))
    assert done.returncode == 1


def _edge(other: str, condition: Any, timeout: float | None = None) -> tuple[Dependency, ...]:
    return (Dependency(other, condition, timeout, at(9)),)


@pytest.mark.parametrize(
    ("program", "ready"),
    [
        ("sleep 0.5; echo 'it is up: 42'; sleep 1000", Ready("up: \\d+$", None, 20.0)),
        ("sleep 0.5; touch flag; sleep 1000", Ready(None, None, None, file="flag")),
        ("sleep 0.5; touch flag; sleep 1000", Ready(None, None, None, command=("test", "-e", "flag"))),
    ],
    ids=["log", "file", "command"],
)
def test_a_process_begins_when_the_other_is_ready(tmp_path: Path, program: str, ready: Ready) -> None:
    """In the folder of the process that is asked, and not before."""
    first = process("first", "sh", "-c", program, ready=ready, cwd=str(tmp_path))
    late = process("late", "sh", "-c", "echo late; exit 3", required=True, depends_on=_edge("first", "ready"))
    began = time.monotonic()
    done = _run(_script(tmp_path, plan(late, first)))
    assert done.returncode == 3, done.stderr
    assert time.monotonic() - began > 0.4
    assert done.stdout.endswith("late\n")


def test_ready_is_a_connection_that_is_accepted(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        address = f"127.0.0.1:{server.getsockname()[1]}"
        first = process("first", "sleep", "1000", ready=Ready(None, None, 5.0, tcp=address))
        late = process("late", "echo", "late", required=True, depends_on=_edge("first", "ready"))
        assert _run(_script(tmp_path, plan(first, late))).stdout == "late\n"


def test_ready_is_an_answer_of_http(tmp_path: Path) -> None:
    program = "import http.server as h; s = h.HTTPServer(('127.0.0.1', 0), h.SimpleHTTPRequestHandler);"
    program += "open('port', 'w').write(str(s.server_port)); s.serve_forever()"
    with subprocess.Popen([sys.executable, "-c", program], cwd=tmp_path, stderr=subprocess.DEVNULL) as server:
        try:
            _until(tmp_path / "port")
            deadline = time.monotonic() + _PATIENCE
            while not (port := (tmp_path / "port").read_text()):
                assert time.monotonic() < deadline
            ready = Ready(None, None, 5.0, http=f"http://127.0.0.1:{port}/")
            first = process("first", "sleep", "1000", ready=ready)
            late = process("late", "echo", "late", required=True, depends_on=_edge("first", "ready"))
            assert _run(_script(tmp_path, plan(first, late)), no_proxy="127.0.0.1").stdout == "late\n"
        finally:
            server.kill()


def test_what_never_is_ready_in_time_leaves_the_other_out(tmp_path: Path) -> None:
    first = process("first", "sleep", "2", ready=Ready("never", None, 1.0), required=True)
    late = process("late", "echo", "late", depends_on=_edge("first", "ready"))
    done = _run(_script(tmp_path, plan(first, late)))
    assert (done.returncode, done.stdout) == (0, "")
    assert "late is skipped" in done.stderr


@pytest.mark.parametrize(
    ("status", "condition", "codes", "begins"),
    [
        (0, "completed", None, True),
        (3, "completed", None, False),
        (3, "completed", (0, 3), True),
        (13, "completed", (3,), False),
        (3, "exited", None, True),
    ],
)
def test_a_process_begins_when_the_other_has_ended(
    tmp_path: Path, status: int, condition: Any, codes: tuple[int, ...] | None, begins: bool
) -> None:
    first = process("first", "sh", "-c", f"sleep 0.2; exit {status}", success_exit_codes=codes)
    late = process("late", "echo", "late", depends_on=_edge("first", condition))
    assert _run(_script(tmp_path, plan(late, first))).stdout == ("late\n" if begins else "")


def _starting(target: str, event: TriggerEvent, delay: float | None) -> Trigger:
    do = (LogAction("now", at(4)), StartAction(target, at(4)))
    return Trigger("t1", event, do, delay, deferred=False, location=at(4))


def test_a_timer_starts_its_process_later_and_other_triggers_are_told(tmp_path: Path) -> None:
    timed = _starting("late", TriggerEvent("run_started"), 0.5)
    other = _starting("never", TriggerEvent("process_exited", "first"), None)
    first, late, never = (process(name, "echo", name) for name in ("first", "late", "never"))
    path = _script(tmp_path, plan(late, never, first, triggers=(timed, other)))
    began = time.monotonic()
    assert sorted(_run(path).stdout.split()) == ["first", "late"]
    assert time.monotonic() - began > 0.5
    assert "# not started here: never, which a trigger starts\n" in path.read_text()


def test_limits_are_in_force(tmp_path: Path) -> None:
    limits = Limits(cores=(0,), nice=5, rlimits={"nofile": (64, 128), "core": (0, -1)})
    told = "ulimit -Sn; ulimit -Hn; ulimit -Sc; nice; taskset -cp $$ | sed 's/.*: //'"
    if subprocess.run(["prlimit", "--core=0:unlimited", "true"], check=False).returncode:
        pytest.skip("the hard limit of core files is lower here")
    done = _run(_script(tmp_path, plan(process("a", "bash", "-c", told, limits=limits))))
    assert done.stdout.split() == ["64", "128", "0", str(min(os.nice(0) + 5, 19)), "0"]


def test_only_standard_input_that_is_asked_for_is_passed_on(tmp_path: Path) -> None:
    path = _script(tmp_path, plan(process("a", "cat", stdin=True), process("b", "cat")))
    done = subprocess.run(
        ["bash", str(path)], input="typed\n", capture_output=True, text=True, timeout=60, check=False
    )
    assert done.stdout == "typed\n"


def _everything() -> Plan:
    """Return a plan of everything that a script has words for."""
    facts = Ready("up 'x'", "/clock", 2.5, "h:1", "http://h/", "a b", ("test", "a b"), notify=True)
    first = node(
        "/r/a",
        *("prog", "a b", "${run}/x"),
        ready=facts,
        restart=Restart("always"),
        lifecycle="active",
        required=True,
        parameters={"p": "it's", "run": "${run}"},
        environment={"A": "1", "B": None, "odd-name": "x"},
        cwd="some folder",
        limits=Limits((0, 2), True, 3, "fifo", 9, 1 << 20, {"nofile": (1, -1)}),
        stop=Stop("SIGTERM", 1.0, 1.0),
    )
    edges = tuple(
        Dependency("/r/a", condition, 3.0, at(9), required=condition != "exited")
        for condition in ("started", "ready", "completed", "exited")
    )
    second = process("b", "x", "|", "y", **_BY_SHELL, depends_on=edges, inherit_environment=False, stdin=True)
    late = _starting("late", TriggerEvent("run_started"), 0.5)
    return plan(process("late", "x"), second, first, triggers=(late,))


@pytest.mark.skipif(shutil.which("shellcheck") is None, reason="shellcheck is not installed")
def test_shellcheck_finds_nothing(tmp_path: Path) -> None:
    additions = Additions({"A": "x y"}, {"PATH": "/x"}, {"LAST": "/y"}, {"N": "1"}, {"${run}/f": b"x\n"})
    path = _script(tmp_path, _everything(), Setting(additions=additions))
    done = subprocess.run(["shellcheck", str(path)], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "")


def test_what_the_script_leaves_to_orchestra_is_said() -> None:
    text = script.render(_everything())
    for said in (
        "# restart: it is not started again when it ends\n",
        "# lifecycle: nobody brings it to a state: `ros2 lifecycle set` does\n",
        "# ready: at the first message on /clock\n",
        "# after: /r/a has exited, within 3 s, if that can come about\n",
        "# limits: no more than 1048576 bytes of memory are not seen to\n",
    ):
        assert said in text


def test_no_text_of_a_plan_leaves_its_comment(tmp_path: Path) -> None:
    hostile = process("x\necho INJECTED", "true", location=at(1, "a\necho INJECTED"))
    done = _run(_script(tmp_path, plan(hostile, file="f\necho INJECTED #")))
    assert (done.returncode, done.stdout) == (0, "")


def test_whoever_starts_it_with_sh_gets_bash(tmp_path: Path) -> None:
    path = _script(tmp_path, plan(process("a", "/bin/sh", "-c", "echo it runs")))
    done = subprocess.run(
        ["sh", str(path)], cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False
    )
    assert (done.returncode, "it runs" in done.stdout) == (0, True), done.stderr
    piped = subprocess.run(
        ["dash"] if shutil.which("dash") else ["bash", "-s"],
        input=path.read_text(),
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert piped.returncode in (0, 2)
    assert ("this is a script for bash" in piped.stderr) == (piped.returncode == 2)
