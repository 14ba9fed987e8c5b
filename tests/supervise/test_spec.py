from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from orchestra import events
from orchestra.supervise.keeping.proc import children, descendants, marks, stat
from orchestra.supervise.options import RunOptions, decode, encode
from orchestra.supervise.process.spec import argv, located
from tests.supervise.plans import process


def test_the_run_directory_takes_the_place_of_its_symbol() -> None:
    symbolic = process(
        "a",
        command=("x", "--file", "${run}/params/a.yaml"),
        arguments=("${run}/b",),
        environment={"A": "${run}", "B": None},
        cwd="${run}",
        parameters={"map": "${run}/map", "maps": ("${run}/a", "b"), "rate": 2.0, "ids": (1, 2)},
    )
    real = located(symbolic, "/r")
    assert real.command == ("x", "--file", "/r/params/a.yaml")
    assert (real.arguments, real.environment, real.cwd) == (("/r/b",), {"A": "/r", "B": None}, "/r")
    assert real.parameters == {"map": "/r/map", "maps": ("/r/a", "b"), "rate": 2.0, "ids": (1, 2)}


@pytest.mark.parametrize(
    ("named", "real"),
    [
        ({"command": ("x", "a${run}")}, {"command": ("x", "a/r")}),
        ({"arguments": ("${run}",)}, {"arguments": ("/r",)}),
        ({"cwd": "${run}"}, {"cwd": "/r"}),
        ({"environment": {"A": None, "B": "'${run}'"}}, {"environment": {"A": None, "B": "'/r'"}}),
        ({"parameters": {"a": "'\"${run}\n"}}, {"parameters": {"a": "'\"/r\n"}}),
        ({"parameters": {"a": ("b", "${run}")}}, {"parameters": {"a": ("b", "/r")}}),
        ({}, {}),
    ],
    ids=str,
)
def test_it_is_found_in_one_place_alone(named: dict[str, Any], real: dict[str, Any]) -> None:
    assert located(process("a", **named), "/r") == process("a", **real)


def test_a_shell_gets_its_words_as_one_line() -> None:
    line = process("a", command=("x", "'a b'", "&&", "y"), shell=True)  # noqa: S604 - the plan says so
    assert argv(line) == ("/bin/sh", "-c", "x 'a b' && y")


def test_options_come_back_as_they_were() -> None:
    options = RunOptions("x", fail_on_any=True, colour=False)
    assert decode(encode(options)) == options
    assert decode({}) == RunOptions()
    with pytest.raises(ValueError, match="not the options"):
        decode({"nmae": "x"})


def test_an_event_is_a_line() -> None:
    event = events.Event(1.5, 2.5, "process_ended", "/a", 7, None, {"code": 0, "text": "é\n"})
    line = events.dumps(event)
    assert "\n" not in line
    assert events.loads(line) == event
    with pytest.raises(ValueError, match="event"):
        events.loads("[]")
    with pytest.raises(ValueError, match="event"):
        events.loads('{"kind": "x"}')


def test_facts_about_processes() -> None:
    own = stat(os.getpid())
    assert own
    assert (own.parent, own.group) == (os.getppid(), os.getpgrp())
    child = os.posix_spawn("/bin/sleep", ["a ) (b", "1000"], {"MARK": "1"})
    try:
        assert child in children(os.getpid())
        assert child in descendants(os.getpid())
        assert marks(child, ("MARK", "NONE")) == ("1", None)
    finally:
        os.kill(child, 9)
        os.waitpid(child, 0)
    assert stat(child) is None
    assert children(child) == []
    assert not Path(f"/proc/{child}").exists()
