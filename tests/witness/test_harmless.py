"""Code that is taken for harmless changes nothing, whatever it does with the words that it may use."""

from __future__ import annotations

import builtins
import os
import random
import sys
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat import pristine
from orchestra.compat.hook import _is_of_users
from orchestra.witness.harmless import MODULES, WORDS, changes_nothing
from orchestra.witness.unknowable import sign_in
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Iterator

_HARMLESS = {
    "a launch file": """
'''What it is for.'''
import os
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from ament_index_python.packages import get_package_share_directory as share

SIZES = {'small': 1, **{f'{n}': n for n in range(3) if n}}
speed = LaunchConfiguration('speed', default=str(SIZES['small']))

def node(name, *given, **more):
    return Node(package='demo', executable=name, parameters=[*given, {'at': os.environ['HOME']}], **more)

def late(context):
    try:
        nodes = [node('a' + speed.perform(context))]
    except KeyError as error:
        raise RuntimeError('no speed') from error
    nodes += [node(name) for name in sorted(os.listdir(share('demo'))) if name.endswith('.yaml')]
    return nodes if len(nodes) > 1 and not SIZES else None

def generate_launch_description():
    made = LaunchDescription([DeclareLaunchArgument('speed')])
    made.add_action(OpaqueFunction(function=lambda context: late(context)))
    return made
""",
    "paths": "from pathlib import Path\nhere = Path(__file__).parent / 'x'\nthere = here.exists() and str(here)",
    "an expression": "from launch.substitutions import PythonExpression as P\nP('__import__(\"os\").umask(0)')",
    "a generator": "names = []\nnames.extend(str(n) for n in (1, 2))",
    "many names": "\n".join(f"a{n} = a{n - 1 if n else n} = {n}" for n in range(300)),
}
# Each is one way out of what is listed.
_MAY_DO_ANYTHING = [
    *(
        "import sys",
        "import shutil",
        "import path",
        "import join",
        "from . import launch",
        "import launch_testing",
    ),
    *(
        "from launch import *",
        "from os import system",
        "from launch.actions import unknown",
        "import os.path.x",
    ),
    *("import os\nos.system('true')", "import os\nos.chdir('/')", "import os\nos.environ['A'] = 'b'"),
    *("import os\nos.environ.update(A='b')", "import os\nos.environ.pop('A')", "import os\nos.sep = ''"),
    *(
        "import os\ndel os.environ['A']",
        "import os\nmine = os.environ\nmine |= {'A': 'b'}",
        "import os\nos.umask(0)",
    ),
    *("import os as o\no.rename('a', 'b')", "import os\nos.path.os.system('x')", "import os\ndel os.sep"),
    *("open('x')", "exec('x')", "eval('x')", "compile('x', 'y', 'exec')", "getattr(str, 'x')", "globals()"),
    *(
        "vars()",
        "setattr(str, 'x', 1)",
        "delattr(str, 'x')",
        "__import__('os')",
        "input()",
        "type('x', (), {})",
    ),
    *(
        "print.__self__.x()",
        "str.__subclasses__()",
        "(lambda: 1).__globals__",
        "__builtins__",
        "breakpoint()",
    ),
    *("__builtins__ = {}", "__name__.__class__", "__loader__", "unknown()", "exit()", "help()"),
    *("open = str\nopen('x')", "if 0:\n    exec = 1\nexec('x')", "eval: str = 'x'"),
    *("system = 1\nimport os\nos.system('x')", "def f():\n    import os\n    os.remove('x')\nremove = 1"),
    *("class A:\n    pass", "def f():\n    global x\n    x = 1", "x = [1]\nx[0] = 2", "x = [1]\ndel x[0]"),
    *(
        "with open as x:\n    pass",
        "async def f():\n    await x",
        "x = 1\ndel x",
        "match 1:\n    case int(x):\n        pass",
    ),
    *("def f():\n    def g():\n        def h():\n            return exec('x')", "[exec('x') for y in ()]"),
    *("lambda: exec", "from launch import LaunchService"),
    *("from launch import logging", "import launch\nlaunch.logging.get_logger()", "x = 1\nx.real"),
    "\n".join([*(f"a{n} = {n}" for n in range(300)), "import os", "os.a299", "os.system"]),
]


@pytest.mark.parametrize("source", _HARMLESS.values(), ids=_HARMLESS)
def test_most_launch_files_change_nothing(source: str) -> None:
    code = compile(source, "some.launch.py", "exec")
    assert changes_nothing(code) is (sys.version_info < (3, 14))


@pytest.mark.parametrize("source", _MAY_DO_ANYTHING)
def test_whatever_is_not_listed_may_do_anything(source: str) -> None:
    assert not changes_nothing(compile(source, "some.launch.py", "exec"))
    for known in _HARMLESS.values():
        assert not changes_nothing(compile(f"{known}\n{source}", "some.launch.py", "exec"))


def test_what_is_harmless_can_be_recorded() -> None:
    code = compile("\n".join(f"x.{word}" for word in sorted(WORDS)), "some.launch.py", "exec")
    assert sign_in(code) is None


# What is found by the words below the modules, and is not of the packages that launch files are made with.
_FUNCTIONS_OF_OTHERS = {
    *("posix.getcwd", "posix.listdir", "os.getenv", "typing.Union"),
    *(f"collections.abc.{name}" for name in ("get", "items", "keys", "values")),  # of `os.environ`
    *(
        "posixpath.abspath",
        "posixpath.basename",
        "posixpath.commonpath",
        "posixpath.dirname",
        "posixpath.isabs",
    ),
    *(
        "posixpath.expanduser",
        "posixpath.expandvars",
        "posixpath.join",
        "posixpath.normpath",
        "posixpath.realpath",
    ),
    *("posixpath.relpath", "posixpath.split", "posixpath.splitext", "posix._path_normpath"),
    *(f"{place}.{name}" for place in ("posixpath", "genericpath") for name in ("islink", "lexists")),
    *("genericpath.exists", "genericpath.isdir", "genericpath.isfile"),
}


def test_the_words_lead_to_nothing_but_what_only_looks() -> None:
    """No function of others is reached that is not listed here, and no list or table that all files share."""
    with loading({}):
        reached = list(_reached())
    others = {f"{item.__module__}.{item.__name__}" for item in reached if _is_of_others(item)}
    assert others <= _FUNCTIONS_OF_OTHERS
    modules = {item.__name__ for item in reached if isinstance(item, ModuleType)}
    assert {name for name in modules if not name.startswith("orchestra.compat.")} == {
        "os",
        "posixpath",
        "pathlib",
    }
    assert [item for item in reached if isinstance(item, list | set | dict | bytearray)] == []


def _is_of_others(item: Any) -> bool:
    module = getattr(item, "__module__", None)
    return (
        callable(item)
        and isinstance(module, str)
        and not isinstance(item, type)
        and module != "builtins"
        and not module.startswith(("orchestra.compat.", "pathlib"))
    )


def _reached() -> Iterator[Any]:
    """Yield what modules have under the words, and what that has, and so on."""
    waiting = [__import__(name, fromlist=["x"]) for name in sorted(MODULES)]
    waiting += [getattr(builtins, word) for word in sorted(WORDS) if hasattr(builtins, word)]
    known: dict[int, Any] = {}
    while waiting:
        item = waiting.pop()
        if id(item) in known:
            continue
        known[id(item)] = item
        yield item
        for word in sorted(WORDS - {"__doc__", "__file__", "__name__"}):
            try:
                waiting.append(getattr(item, word))
            except AttributeError:
                continue


_IMPORTED = """
import os
import pathlib
import launch
import launch_ros
from launch import actions, substitutions, conditions
from launch_ros import descriptions
from ament_index_python import packages
have = [os, os.path, os.environ, pathlib.Path, launch, actions, launch_ros.actions, substitutions, packages, 'a', 1, {}]
"""
_WORDS = sorted(word for word in WORDS - MODULES - {"iter"} if not word.startswith("__"))
_BUILTINS = [word for word in _WORDS if hasattr(builtins, word)]


def _expression(chance: random.Random, depth: int) -> str:
    """Return some expression of words."""
    if depth == 0:
        return chance.choice(
            [*("'a'", "'/'", "1", "[1]", "{'a': 'b'}", "('x', 'y')", "None", "have"), "have[0]"]
        )
    inner = _expression(chance, depth - 1)
    return chance.choice(
        [
            f"have[{chance.randrange(12)}].{chance.choice(_WORDS)}",
            f"have[{chance.randrange(12)}].{chance.choice(_WORDS)}({inner})",
            f"({inner}).{chance.choice(_WORDS)}({_expression(chance, depth - 1)})",
            f"{chance.choice(_BUILTINS)}({inner})",
            f"launch_ros.actions.{chance.choice(_WORDS)}({inner}, name={inner})",
            f"actions.{chance.choice(_WORDS)}({inner}, {_expression(chance, 0)})",
            f"substitutions.{chance.choice(_WORDS)}({inner})",
            f"have[{inner}]",
        ]
    )


def _program(chance: random.Random) -> str:
    lines = []
    for _ in range(6):
        line = f"found = {_expression(chance, chance.randrange(1, 4))}"
        again = chance.choice(
            ["pass", "found += found", "found += ['x']", "found -= found", "have.append(found)"]
        )
        lines += ["try:", f"    {line}", f"    {again}", "except Exception:", "    pass"]
    return _IMPORTED + "\n".join(lines)


def _state() -> list[Any]:
    """Return what code might change."""
    tables = [vars(os), vars(os.path), vars(builtins), os.environ, vars(sys)]
    modules = {name for name, module in sys.modules.items() if _is_of_users(name, module)}
    mask = os.umask(0o77)
    os.umask(mask)
    return [
        *(dict(table) for table in tables),
        Path.cwd(),
        list(sys.path),
        list(sys.meta_path),
        modules,
        mask,
    ]


def test_programs_of_the_words_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    chance = random.Random(7)  # noqa: S311 - nothing is to be kept secret
    restored: list[object] = []
    with loading(dict(os.environ)):
        exec(compile(_IMPORTED, "before.launch.py", "exec"), {})  # noqa: S102 - it imports what is there later
        pristine.restore()
        before = _state()
        monkeypatch.setattr(
            pristine, "_restore_class", lambda kind, content: restored.append((kind, content))
        )
        for _ in range(60):
            source = _program(chance)
            code = compile(source, "some.launch.py", "exec")
            assert changes_nothing(code) is (sys.version_info < (3, 14)), source
            with redirect_stdout(StringIO()):
                exec(code, {"__name__": "python_launch_file", "__file__": "x.py"})  # noqa: S102 - so it is run
            pristine.restore()
            assert _state() == before, source
            assert restored == [], source
