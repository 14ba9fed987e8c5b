"""Python launch files that are written, named or behave in odd ways."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code, Problems
from orchestra.pipeline import collect, inputs_from

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Plan

_TEXT = """\
{before}
from launch import LaunchDescription
from launch.actions import *
from launch.substitutions import *
{code}
def generate_launch_description():
{inside}
    return LaunchDescription([{actions}])
"""


def _text(
    *, before: str = "", code: str = "", inside: str = "pass", actions: str = "LogInfo(msg='said')"
) -> str:
    lines = "\n".join(f"    {line}" for line in inside.splitlines())
    return _TEXT.format(before=before, code=code, inside=lines, actions=actions)


def _resolve(path: Path) -> tuple[Plan | None, Problems]:
    problems = Problems()
    return collect(str(path), inputs_from([], environment={"PATH": "/bin"}), problems), problems


def _said(path: Path) -> list[str]:
    plan, problems = _resolve(path)
    assert not list(problems), list(problems)
    assert plan is not None
    return [action.message for trigger in plan.triggers for action in trigger.do if action.action == "log"]


ENCODED = {
    "a byte order mark": b"\xef\xbb\xbf" + _text().encode(),
    "line ends of Windows": _text().replace("\n", "\r\n").encode(),
    "a coding cookie": _text(
        before="# -*- coding: latin-1 -*-", actions="LogInfo(msg='s\xe4id'[:1] + 'aid')"
    ).encode("latin-1"),
    "no line end at its end": _text().rstrip().encode(),
    "many lines": _text(code="LONG = [\n" + "  'x' * 3,\n" * 20_000 + "]").encode(),
}


@pytest.mark.parametrize("name", ENCODED)
def test_a_file_is_read_as_python_reads_it(tmp_path: Path, name: str) -> None:
    path = tmp_path / "a.launch.py"
    path.write_bytes(ENCODED[name])
    assert _said(path) == ["said"]


# What is in the file, the code, and a part of the message.
UNREADABLE = {
    "nothing": (b"", Code.NO_DESCRIPTION, "has no function generate_launch_description()"),
    "no Python": (b"launch:\n- node: {}\n", Code.SYNTAX, "this is not Python"),
    "null bytes": (_text().encode() + b"\0x = 1\n", Code.SYNTAX, "null bytes"),
    "any bytes": (bytes(range(256)) * 8, Code.SYNTAX, "this is not Python"),
    "another encoding than it says": (
        _text(actions="LogInfo(msg='\xe9')").encode("latin-1"),
        Code.SYNTAX,
        "utf-8",
    ),
    "UTF-16": (_text().encode("utf-16"), Code.SYNTAX, "this is not Python"),
    "an unknown cookie": (
        b"# coding: nonsense\n" + _text().encode(),
        Code.SYNTAX,
        "unknown encoding: nonsense",
    ),
    "an end in the middle": (_text().encode()[:-4], Code.SYNTAX, "was never closed"),
}


@pytest.mark.parametrize("name", UNREADABLE)
def test_what_is_no_launch_file_is_told_at_its_place(tmp_path: Path, name: str) -> None:
    content, code, part = UNREADABLE[name]
    path = tmp_path / "a.launch.py"
    path.write_bytes(content)
    plan, problems = _resolve(path)
    (problem,) = problems
    assert plan is None
    assert problem.code == code
    assert part in problem.message
    assert problem.span is not None
    assert problem.span.file == str(path)


@pytest.mark.parametrize(
    "name", ["x.y z.launch.py", "a launch.py", "ä'\".launch.py", "$(dirname).launch.py", "-a.launch.py"]
)
def test_any_name_will_do(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    path.write_text(_text(actions="LogInfo(msg=[ThisLaunchFileDir(), '|', __file__])"), "utf-8")
    assert _said(path) == [f"{tmp_path}|{path}"]


def test_a_link_is_followed(tmp_path: Path) -> None:
    (tmp_path / "a.launch.py").write_text(_text(), "utf-8")
    link = tmp_path / "link.launch.py"
    link.symlink_to("a.launch.py")
    assert _said(link) == ["said"]


# Where a link leads; the memory of a process is a file that even root cannot read at its beginning.
UNREAD = {
    "nowhere.launch.py": "No such file or directory",
    ".": "Is a directory",
    "a.launch.py": "Too many levels of symbolic links",
    "/proc/self/mem": "Input/output error",
}


@pytest.mark.parametrize("target", UNREAD)
def test_a_file_that_cannot_be_read_is_told(tmp_path: Path, target: str) -> None:
    path = tmp_path / "a.launch.py"
    path.symlink_to(target)
    plan, problems = _resolve(path)
    (problem,) = problems
    assert plan is None
    assert problem.code == Code.UNREADABLE_FILE
    assert problem.message.endswith(f": {UNREAD[target]}")


# What code may rely on in its module.
MODULES = {
    "its name and file": _text(
        code="from pathlib import Path\nassert __name__ == 'python_launch_file'\n"
        "assert Path(__file__).is_file() and Path(__file__).is_absolute()\nassert __spec__.origin == __file__"
    ),
    "no main program": _text(code="if __name__ == '__main__': raise SystemExit('not this')"),
    "imports from the future": _text(
        before='"""A docstring."""\nfrom __future__ import annotations', code="x: Unknown = 1"
    ),
    "its source": _text(
        code="import inspect\ndef f(): pass\nclass C: pass\n"
        "for thing in (f, C): assert inspect.getfile(thing) == __file__ and inspect.getsource(thing)\n"
        "assert inspect.getmodule(f).__file__ == __file__",
    ),
    "dataclasses and pickles": _text(
        code="import copy, pickle\nfrom dataclasses import dataclass, field\n@dataclass\nclass A:\n"
        "    y: 'list[A]' = field(default_factory=list)\nassert pickle.loads(pickle.dumps(A())) == copy.deepcopy(A())",
        inside="assert pickle.loads(pickle.dumps(A())) == A()\n@dataclass\nclass B(A):\n    z: 'int' = 1\nB()",
    ),
    "enumerations and named tuples": _text(
        code="import enum, pickle, typing\nclass E(enum.Enum):\n    A = 1\nclass T(typing.NamedTuple):\n    a: 'int' = 1\n"
        "assert typing.get_type_hints(T) == {'a': int} and pickle.loads(pickle.dumps(E.A)) is E.A"
    ),
    "a helper module beside it, with its folder on the path": _text(
        before="import os, sys\nsys.path.append(os.path.dirname(os.path.realpath(__file__)))\nfrom of_users import TEXT",
        actions="LogInfo(msg=TEXT)",
    ),
    "a helper module by its file": _text(
        code="import importlib.util, os\nspec = importlib.util.spec_from_file_location('h', os.path.join(os.path.dirname(__file__), 'of_users.py'))\n"
        "module = importlib.util.module_from_spec(spec); spec.loader.exec_module(module)",
        actions="LogInfo(msg=module.TEXT)",
    ),
    "the function as an object": _text(actions="LogInfo(msg='not this')")
    + "class Made:\n    def __call__(self): return LaunchDescription([LogInfo(msg='said')])\ngenerate_launch_description = Made()\n",
}


@pytest.mark.parametrize("name", MODULES)
def test_code_finds_itself(tmp_path: Path, name: str) -> None:
    (tmp_path / "of_users.py").write_text("TEXT = 'said'", "utf-8")
    path = tmp_path / "a.launch.py"
    path.write_text(MODULES[name], "utf-8")
    assert _said(path) == ["said"]


# Code, the code of the problem, a part of its message, and of the line where it is.
FAULTS = {
    "a module beside it": (
        _text(before="import of_users"),
        Code.USER_CODE,
        "there is no Python module 'of_users'",
        "import of_users",
    ),
    "a relative import": (
        _text(before="from . import of_users"),
        Code.USER_CODE,
        "relative import",
        "from . import",
    ),
    "recursion": (
        _text(code="def f(): return f()", inside="f()"),
        Code.USER_CODE,
        "RecursionError",
        "def f()",
    ),
    "recursion of actions": (
        _text(code="def f(_): return [OpaqueFunction(function=f)]", actions="OpaqueFunction(function=f)"),
        Code.INCLUDE_CYCLE,
        "inside each other without end",
        "OpaqueFunction(function=f)",
    ),
    "an action in itself": (
        _text(code="g = []\ng.append(GroupAction(g))", actions="g[0]"),
        Code.INCLUDE_CYCLE,
        "inside each other without end",
        "GroupAction(g)",
    ),
    "a description in itself": (
        _text(code="d = LaunchDescription()\nd.add_action(d)", actions="d"),
        Code.INCLUDE_CYCLE,
        "inside each other without end",
        "d = LaunchDescription()",
    ),
    "a substitution in itself": (
        _text(
            code="class S(TextSubstitution):\n    def perform(self, context): return self.perform(context)",
            actions="LogInfo(msg=S(text=''))",
        ),
        Code.USER_CODE,
        "RecursionError",
        "return self.perform(context)",
    ),
    "substitutions nested too deep": (
        _text(
            code="s = TextSubstitution(text='1')\nfor _ in range(5000): s = NotSubstitution(s)",
            actions="LogInfo(msg=s)",
        ),
        Code.USER_CODE,
        "RecursionError",
        "LogInfo(msg=s)",
    ),
    "an end of the program": (
        _text(inside="raise SystemExit(3)"),
        Code.USER_CODE,
        "SystemExit(3)",
        "raise SystemExit",
    ),
    "an exception that is none": (
        _text(code="class Odd(BaseException): pass", inside="raise Odd('x')"),
        Code.USER_CODE,
        "Odd: x",
        "raise Odd",
    ),
    "the end of a generator": (_text(inside="raise GeneratorExit"), Code.USER_CODE, "GeneratorExit", "raise"),
    "a late exception that is none": (
        _text(code="def f(_): raise GeneratorExit('x')", actions="OpaqueFunction(function=f)"),
        Code.USER_CODE,
        "GeneratorExit: x",
        "raise GeneratorExit",
    ),
    "a coroutine": (
        _text().replace("def gen", "async def gen"),
        Code.NO_DESCRIPTION,
        "without `async`",
        "async def",
    ),
    "a question": (_text(inside="input('name? ')"), Code.USER_CODE, "", "input("),
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_goes_wrong_is_told_at_the_users_line(tmp_path: Path, name: str) -> None:
    (tmp_path / "of_users.py").write_text("TEXT = 'said'", "utf-8")
    text, code, part, line = FAULTS[name]
    path = tmp_path / "a.launch.py"
    path.write_text(text, "utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        _, problems = _resolve(path)
    (problem,) = problems.errors
    assert problem.code == code
    assert part in problem.message
    assert problem.span is not None
    assert problem.span.file == str(path)
    assert line in text.splitlines()[problem.span.line - 1]


@pytest.mark.parametrize("name", ["an action in itself", "a description in itself", "recursion of actions"])
def test_wherever_the_stack_ends_it_is_told_alike(tmp_path: Path, name: str) -> None:
    path = tmp_path / "a.launch.py"
    path.write_text(FAULTS[name][0], "utf-8")

    def codes(deeper: int) -> list[Code]:
        return codes(deeper - 1) if deeper else [problem.code for problem in _resolve(path)[1].errors]

    assert [codes(deeper) for deeper in range(24)] == [[FAULTS[name][1]]] * 24


def test_where_a_module_beside_it_would_be_found_is_told(tmp_path: Path) -> None:
    (tmp_path / "of_users").mkdir()
    (tmp_path / "of_users" / "__init__.py").touch()
    path = tmp_path / "a.launch.py"
    path.write_text(_text(before="import of_users"), "utf-8")
    (problem,) = _resolve(path)[1]
    assert any("sys.path.insert(0, os.path.dirname(__file__))" in note for note in problem.notes)


def test_what_is_around_an_endless_action_is_planned(tmp_path: Path) -> None:
    inner = tmp_path / "inner.launch.py"
    inner.write_text(FAULTS["recursion of actions"][0], "utf-8")
    path = tmp_path / "a.launch.py"
    path.write_text(
        _text(actions="ExecuteProcess(cmd=['a']), IncludeLaunchDescription('inner.launch.py')"), "utf-8"
    )
    plan, problems = _resolve(path)
    (problem,) = problems.errors
    assert problem.span is not None
    assert problem.span.file == str(inner)
    assert plan is not None
    assert [process.id for process in plan.processes] == ["a"]
