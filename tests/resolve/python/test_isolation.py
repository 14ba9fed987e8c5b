"""What code of launch files does to its process is over when the file has been resolved."""

from __future__ import annotations

import asyncio
import atexit
import builtins
import decimal
import gc
import io
import locale
import logging
import multiprocessing
import os
import random
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import warnings
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.cli.look.standing import Standing
from orchestra.errors import Code, Problems, Severity
from orchestra.location import point
from orchestra.pipeline import collect, inputs_from, opened
from orchestra.plan.codec import encode
from orchestra.resolve.python import remaining

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

_FILE = """\
from launch import LaunchDescription
from launch.actions import *
from launch_ros.actions import Node
{code}

def late(context):
{late}

def generate_launch_description():
{function}
    return LaunchDescription([LogInfo(msg='said'), OpaqueFunction(function=late)])
"""
# Objects of code that has left a program or a file alone are told by Python when they go.
pytestmark = pytest.mark.filterwarnings(
    "ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning"
)
_PLACES = ("at import", "in the function", "late")


def _write(folder: Path, code: str, where: str = "at import") -> Path:
    lines = code.strip().splitlines()
    inside = "\n".join(f"    {line}" for line in lines)
    path = folder / "a.launch.py"
    path.write_text(
        _FILE.format(
            code="\n".join(lines) if where == "at import" else "",
            function=inside if where == "in the function" else "    pass",
            late=inside if where == "late" else "    pass",
        ),
        "utf-8",
    )
    return path


def _resolve(path: Path, *, launching: bool = True) -> tuple[dict[str, Any], Problems]:
    problems = Problems()
    inputs = inputs_from([], environment={"PATH": "/bin", "TZ": "UTC"})
    plan = collect(str(path), replace(inputs, launching=launching), problems)
    assert plan is not None, list(problems)
    assert not problems.errors, list(problems)
    return encode(plan), problems


def _loggers() -> list[Any]:
    named = [item for item in logging.root.manager.loggerDict.values() if isinstance(item, logging.Logger)]
    return [
        (item.name, item.level, item.propagate, item.disabled, list(item.handlers), list(item.filters))
        for item in (logging.root, *named)
        if item.name != "of.users"
    ]


def _children() -> list[int]:
    return [int(child) for child in Path(f"/proc/self/task/{os.getpid()}/children").read_text().split()]


# What is changed, the code that does it, and what is looked at before and after.
CHANGES: dict[str, tuple[str, Callable[[], Any]]] = {
    "environment": ("import os; os.environ['NEW'] = '1'; os.environ.pop('PATH')", lambda: dict(os.environ)),
    "environment object": (
        "import os; os.environ = dict(os.environ, NEW='1')",
        lambda: (id(os.environ), dict(os.environ)),
    ),
    "path": (
        "import sys; sys.path.insert(0, '/new'); sys.path = ['/other']",
        lambda: (id(sys.path), list(sys.path)),
    ),
    "arguments": ("import sys; sys.argv.append('x'); sys.argv = ['y']", lambda: list(sys.argv)),
    "folder": ("import os; os.chdir('/')", Path.cwd),
    "mask": ("import os; os.umask(0o77)", lambda: os.umask(os.umask(0o22))),
    "new modules": ("import sys; sys.modules['of_users'] = sys", lambda: "of_users" in sys.modules),
    "known modules": (
        "import sys; sys.modules['json'] = sys; del sys.modules['decimal']",
        lambda: [sys.modules.get(name) for name in ("json", "decimal")],
    ),
    "finders": (
        "import sys; sys.meta_path.clear(); sys.path_hooks.append(print)",
        lambda: (list(sys.meta_path), list(sys.path_hooks)),
    ),
    "hooks": (
        "import sys; sys.excepthook = sys.displayhook = sys.unraisablehook = sys.breakpointhook = print",
        lambda: (sys.excepthook, sys.displayhook, sys.unraisablehook, sys.breakpointhook),
    ),
    "streams": (
        "import sys, io; sys.stdin = sys.stdout = io.StringIO(); sys.stderr = io.StringIO()",
        lambda: (sys.stdin, sys.stdout, sys.stderr),
    ),
    "limits": (
        "import sys; sys.setrecursionlimit(5000); sys.setswitchinterval(0.5); sys.set_int_max_str_digits(9999)",
        lambda: (sys.getrecursionlimit(), sys.getswitchinterval(), sys.get_int_max_str_digits()),
    ),
    "bytecode": ("import sys; sys.dont_write_bytecode = False", lambda: sys.dont_write_bytecode),
    "builtins": (
        "import builtins; builtins.print = builtins._ = id; del builtins.abs",
        lambda: dict(vars(builtins)),
    ),
    "warnings": (
        "import warnings; warnings.simplefilter('ignore'); warnings.showwarning = print",
        lambda: (list(warnings.filters), warnings.showwarning),
    ),
    "logging": (
        "import logging; logging.basicConfig(level=1, force=True); logging.disable(50)\n"
        "logging.getLogger('of.users').setLevel(2); logging.getLogger('asyncio').addHandler(logging.NullHandler())\n"
        "logging.setLoggerClass(type('L', (logging.Logger,), {})); logging.setLogRecordFactory(print)\n"
        "logging.getLogger('asyncio').disabled = True; logging.raiseExceptions = False",
        lambda: (
            _loggers(),
            logging.root.manager.disable,
            logging.getLoggerClass(),
            logging.getLogRecordFactory(),
            logging.raiseExceptions,
        ),
    ),
    "signals": (
        "import signal\nfor name in ('INT', 'TERM', 'CHLD', 'USR1'): signal.signal(getattr(signal, 'SIG' + name), print)",
        lambda: [signal.getsignal(number) for number in range(1, signal.NSIG)],
    ),
    "locale": (
        "import locale; locale.setlocale(locale.LC_ALL, 'C.UTF-8'); locale.setlocale(locale.LC_TIME, 'POSIX')",
        lambda: locale.setlocale(locale.LC_ALL),
    ),
    "time zone": (
        "import os, time; os.environ['TZ'] = 'Asia/Tokyo'; time.tzset()",
        lambda: time.localtime(0).tm_hour,
    ),
    "random": ("import random; random.seed(7); random.random()", random.getstate),
    "sockets": ("import socket; socket.setdefaulttimeout(1.5)", socket.getdefaulttimeout),
    "decimals": ("import decimal; decimal.getcontext().prec = 3", lambda: decimal.getcontext().prec),
    "processes": (
        "import multiprocessing; multiprocessing.set_start_method('spawn', force=True)",
        lambda: multiprocessing.get_start_method(allow_none=True),
    ),
    "event loops": (
        "import asyncio\nclass Policy(asyncio.DefaultEventLoopPolicy): pass\nasyncio.set_event_loop_policy(Policy())",
        lambda: type(asyncio.get_event_loop_policy()),
    ),
    "temporary folder": ("import tempfile; tempfile.tempdir = '/'", tempfile.gettempdir),
    "collector": ("import gc; gc.disable()", gc.isenabled),
    "programs": ("import subprocess; subprocess.Popen(['sleep', '600'])", _children),
    "detached programs": (
        "import subprocess; subprocess.run('setsid sleep 600 &', shell=True)",
        _children,
    ),
    "finished programs": ("import subprocess; subprocess.Popen(['true'])", _children),
    "temporary files": (
        "import tempfile; tempfile.mkdtemp(); tempfile.mkstemp()",
        lambda: sorted(Path(tempfile.gettempdir()).iterdir()),
    ),
}


@pytest.fixture
def _own_zone(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let the clock be that of the environment in which the files are resolved, wherever this machine is."""
    with monkeypatch.context() as changed:
        changed.setenv("TZ", "UTC")
        time.tzset()
        yield
    time.tzset()


@pytest.fixture
def _own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody else writes temporary files here."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))


@pytest.fixture(scope="module", autouse=True)
def _everything_is_imported(tmp_path_factory: pytest.TempPathFactory) -> None:
    """What such files need is there before code takes the finders away, whichever test comes first."""
    for where in _PLACES:
        _resolve(_write(tmp_path_factory.mktemp("plain"), "import sys; sys.flags", where))


@pytest.mark.usefixtures("_own_folder")
@pytest.mark.parametrize("where", _PLACES)
@pytest.mark.parametrize("what", CHANGES)
def test_the_process_is_as_before(tmp_path: Path, what: str, where: str) -> None:
    code, look = CHANGES[what]
    path = _write(tmp_path, code, where)
    before = look()
    _resolve(path)
    assert look() == before


@pytest.mark.usefixtures("_own_folder")
@pytest.mark.parametrize("what", CHANGES)
def test_a_second_resolution_gives_the_same_plan(tmp_path: Path, what: str) -> None:
    path = _write(tmp_path, CHANGES[what][0])
    assert _resolve(path)[0] == _resolve(path)[0]


_EXPRESSION = """\
from launch import LaunchDescription
from launch.actions import ExecuteProcess, OpaqueFunction
from launch.substitutions import PythonExpression

def expression():
    return PythonExpression(["str(__import__('os').umask(0o77)) + str(__import__('os').chdir('/'))"])

def late(context):
    return [ExecuteProcess(cmd=['true', expression().perform(context)])]

def generate_launch_description():
    return LaunchDescription([MADE])
"""


@pytest.mark.parametrize(
    "made", ["ExecuteProcess(cmd=['true', expression()])", "OpaqueFunction(function=late)"]
)
def test_what_an_expression_changes_is_undone_too(tmp_path: Path, made: str) -> None:
    """Code that makes it is known to change nothing itself."""
    path = tmp_path / "a.launch.py"
    path.write_text(_EXPRESSION.replace("MADE", made), "utf-8")

    def look() -> tuple[Path, int]:
        return Path.cwd(), os.umask(os.umask(0o22))

    before = look()
    _resolve(path)
    assert look() == before
    with _standing() as resolve:
        first = resolve(path)
        assert (look(), resolve(path)) == (before, first)


# Code that would be noticed by the next file that is resolved, and what that one checks.
INFLUENCES = {
    "a class of ours": (
        "Node.__init__ = lambda self, **_: 1 / 0; Node.added = 1; LogInfo.visit = None; import launch; launch.Action.visit = None",
        "assert not hasattr(Node, 'added'); Node(executable='/bin/true')",
    ),
    "a name of ours": (
        "import launch.actions, launch_ros.actions; launch_ros.actions.Node = launch.actions.LogInfo = None",
        "Node(executable='/bin/true')",
    ),
    "a function of ours": (
        "import launch.utilities; launch.utilities.perform_substitutions = None",
        "from launch.utilities import perform_substitutions; assert callable(perform_substitutions)",
    ),
    "loggers of launch": (
        "import launch.logging; launch.logging.launch_config.level = 10; launch.logging.get_logger('x').setLevel(50)",
        "import launch.logging; assert launch.logging.get_logger('x').level != 50",
    ),
    "modules that stand for others": (
        "import sys, types, unittest.mock\nfor name in ('rclpy_of_users', 'of_users.inner'): "
        "sys.modules[name] = unittest.mock.MagicMock()\nsys.modules['made'] = types.ModuleType('made')",
        "import sys; assert not {'rclpy_of_users', 'of_users.inner', 'made'} & sys.modules.keys()",
    ),
    "a helper module": (
        "import of_users; of_users.STATE.append(1)",
        "import of_users; assert of_users.STATE == []",
    ),
    "exposed actions": (
        "from launch.frontend import expose_action\n@expose_action('of_users')\nclass Own(LogInfo): pass",
        "from launch.frontend import expose_action\n@expose_action('of_users')\nclass Other(LogInfo): pass",
    ),
    "globals of its context": (
        "from launch import LaunchContext; LaunchContext().extend_globals({'of_users': 1})",
        "from launch import LaunchContext; assert 'of_users' not in LaunchContext().get_locals_as_dict()",
    ),
}


@pytest.mark.parametrize("what", INFLUENCES)
def test_a_file_knows_nothing_of_another_one_before(tmp_path: Path, what: str) -> None:
    (tmp_path / "of_users.py").write_text("STATE = []", "utf-8")
    here = f"import sys; sys.path.insert(0, {str(tmp_path)!r})\n"
    first, second = INFLUENCES[what]
    alone = _resolve(_write(tmp_path, here + second))[0]
    _resolve_anyhow(_write(tmp_path, here + first))
    assert _resolve(_write(tmp_path, here + second))[0] == alone


@contextmanager
def _standing() -> Iterator[Callable[[Path], dict[str, Any]]]:
    """Resolve files one after the other as a process does that only checks them."""
    standing = Standing()

    def resolve(path: Path) -> dict[str, Any]:
        inputs = replace(inputs_from([], environment={"PATH": "/bin", "TZ": "UTC"}), launching=False)
        with opened(str(path), inputs, Problems(), isolating=standing.isolated) as launch:
            return {} if launch is None else encode(launch.plan)

    with ExitStack() as leaving:
        leaving.callback(lambda: standing._entered and standing._entered[0].__exit__(None, None, None))
        yield resolve


@pytest.mark.usefixtures("_own_folder", "_own_zone")
@pytest.mark.parametrize("what", CHANGES)
def test_a_process_that_goes_on_is_as_before_each_file(tmp_path: Path, what: str) -> None:
    code, look = CHANGES[what]
    with _standing() as resolve:
        plan = resolve(_write(tmp_path, ""))
        before = look()
        for where in _PLACES:
            assert resolve(_write(tmp_path, code, where))
            assert look() == before
        assert resolve(_write(tmp_path, "")) == plan


@pytest.mark.parametrize("what", INFLUENCES)
def test_where_a_process_goes_on_a_file_knows_nothing_of_another_one_either(
    tmp_path: Path, what: str
) -> None:
    (tmp_path / "of_users.py").write_text("STATE = []", "utf-8")
    here = f"import sys; sys.path.insert(0, {str(tmp_path)!r})\n"
    first, second = INFLUENCES[what]
    with _standing() as resolve:
        alone = resolve(_write(tmp_path, here + second))
        assert alone
        for _ in range(2):
            resolve(_write(tmp_path, here + first))
            assert resolve(_write(tmp_path, here + second)) == alone


def test_a_program_that_is_only_beginning_is_told_with_its_words(monkeypatch: pytest.MonkeyPatch) -> None:
    """The kernel lets its parent go on before the words of the program can be read."""
    read = iter([b"", b"", b"sleep\x00600\x00"])
    monkeypatch.setattr(remaining, "_TO_BEGIN", 60.0)
    monkeypatch.setattr(remaining, "open", lambda *_: io.BytesIO(next(read)), raising=False)
    assert remaining._command_line(os.getpid()) == "sleep 600"


def _resolve_anyhow(path: Path) -> None:
    """Resolve a file that may have made itself impossible."""
    collect(str(path), inputs_from([], environment={"PATH": "/bin"}), Problems())


def test_a_helper_module_is_read_again_where_it_has_changed(tmp_path: Path) -> None:
    code = f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import of_users"
    path = _write(tmp_path, code)
    path.write_text(path.read_text().replace("'said'", "of_users.TEXT"), "utf-8")
    for text in ("one", "another"):
        (tmp_path / "of_users.py").write_text(f"TEXT = {text!r}", "utf-8")
        plan, _ = _resolve(path)
        assert plan["triggers"][0]["do"][0]["message"] == text
    assert not (tmp_path / "__pycache__").exists()


def test_files_that_code_leaves_open_are_closed_with_its_objects(tmp_path: Path) -> None:
    path = _write(tmp_path, "STREAM = open('/dev/null'); import socket; SOCKET = socket.socket()")
    before = _descriptors()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        _resolve(path)
        gc.collect()
    assert _descriptors() == before


def _descriptors() -> set[str]:
    return {
        f"{entry.name} {entry.readlink()}"
        for entry in Path("/proc/self/fd").iterdir()
        if entry.is_symlink() and "/proc/" not in str(entry.readlink())
    }


def test_a_program_that_code_leaves_is_told(tmp_path: Path) -> None:
    _, problems = _resolve(_write(tmp_path, "import subprocess; subprocess.Popen(['sleep', '600'])"))
    (problem,) = problems
    assert (problem.code, problem.severity) == (Code.USER_CODE, Severity.WARNING)
    assert problem.message == "code has started 'sleep 600', which is no part of the launch: it is ended now"
    assert problem.span == point(str(tmp_path / "a.launch.py"))


def test_a_program_of_somebody_else_stays(tmp_path: Path) -> None:
    with subprocess.Popen(["sleep", "600"]) as other:
        _, problems = _resolve(_write(tmp_path, "import subprocess; subprocess.run(['true'])"))
        assert other.poll() is None
        other.kill()
    assert not list(problems)


def test_a_thread_that_code_leaves_is_told_where_it_runs(tmp_path: Path) -> None:
    code = """
import threading
stop = threading.Event()
def run():
    stop.wait(600)
threading.Thread(target=run, name='busy', daemon=True).start()
threading.Thread(target=lambda: None).start()
import builtins; builtins.vars(threading)['of_users'] = stop
"""
    _, problems = _resolve(_write(tmp_path, code))
    stop = vars(threading).pop("of_users")
    stop.set()
    (problem,) = problems
    assert problem.message == "the thread 'busy' still runs: nothing waits for it"
    assert problem.span is not None
    assert (tmp_path / "a.launch.py").read_text().splitlines()[problem.span.line - 1] == "def run():"


def test_functions_for_the_end_are_called_with_it_and_are_not_those_of_this_process(tmp_path: Path) -> None:
    left = tmp_path / "left"
    code = f"""
import atexit, os
open({str(left)!r}, 'w').close()
@atexit.register
def clean(): os.remove({str(left)!r})
def never(): 1 / 0
atexit.register(never)
atexit.unregister(never)
"""
    before = atexit._ncallbacks()
    _, problems = _resolve(_write(tmp_path, code), launching=False)
    assert not left.exists()
    assert atexit._ncallbacks() == before
    assert [problem.message for problem in problems] == []


def test_a_file_in_yaml_costs_none_of_this(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(sys.modules, "orchestra.resolve.python.remaining", raising=False)
    path = tmp_path / "a.launch.yaml"
    path.write_text("launch: [log: {message: said}]", "utf-8")
    _resolve(path)
    assert "orchestra.resolve.python.remaining" not in sys.modules


def test_a_process_that_is_watched_leaves_no_folder_of_one_file_after_the_other(tmp_path: Path) -> None:
    """Watched for good: this process would go on being so."""
    path = _write(tmp_path, "import tempfile")
    elsewhere = tmp_path / "temporary"
    elsewhere.mkdir()
    code = (
        "import os, sys\n"
        "from orchestra.pipeline import check, inputs_from\n"
        "from orchestra.witness.observing import observer\n"
        "observer().install()\n"
        "for _ in range(3): check(sys.argv[1], inputs_from([], environment=os.environ))"
    )
    environment = {**os.environ, "TMPDIR": str(elsewhere)}
    subprocess.run([sys.executable, "-c", code, str(path)], env=environment, check=True)
    assert [*elsewhere.iterdir()] == []
