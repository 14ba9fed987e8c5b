"""What code of a launch file finds out of the machine that it is run on: devices, networks, what programs tell of it.

Another machine has them, so that a check need not: it is no mistake of the file. Only what surely is the reason for an
exception counts: it stands in the expression that raised it, or in the condition under which the code does so itself.
"""

from __future__ import annotations

import ast
import glob
import os
import shlex
from subprocess import CalledProcessError
from typing import TYPE_CHECKING, Final

from orchestra.compat.explanation import Explanation
from orchestra.compat.seam import connection
from orchestra.compat.syntax_trees import tree_of
from orchestra.errors import HERE, Code, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.place import Place
    from orchestra.compat.syntax_trees import Tree

_DEPTH: Final = 3  # names that stand for names
_NOT_THERE: Final = 127  # what a shell ends with
_LISTING: Final = frozenset({"glob", "iglob", "listdir", "scandir"})
_ASKING: Final = frozenset({"exists", "isfile", "isdir", "is_file", "is_dir", "lexists", "access", *_LISTING})
_OF_NETWORKS: Final = ("socket", "fcntl", "netifaces")
_OF_DEVICES: Final = ("psutil", "netifaces", "pyudev", "serial", "list_ports", "usb", "cv2", "evdev")
_LISTS: Final = (IndexError, StopIteration, KeyError)
_NONE_THERE: Final = ("empty", "not in list", "not enough values")  # what is said of lists without something
# Programs that tell of the machine; what others end with may be the fault of what they are given.
_TELLING: Final = frozenset(
    {
        *("arp", "bluetoothctl", "dmesg", "ethtool", "getent", "hciconfig", "hostname", "hostnamectl"),
        *("ifconfig", "ip", "iw", "iwconfig", "iwgetid", "lsblk", "lsmod", "lspci", "lsusb", "modprobe"),
        *("mount", "nmcli", "nvidia-smi", "pgrep", "pidof", "ping", "rfkill", "setserial", "systemctl"),
        *("tegrastats", "udevadm", "v4l2-ctl", "vcgencmd", "xrandr"),
    }
)
_STARTING: Final = frozenset({"call", "check_call", "check_output", "getoutput", "popen", "Popen", "run"})


def explained(error: BaseException, place: Place) -> Explanation | None:
    """Explain an exception for want of something that another machine may have; None for any other.

    Where that is an error all the same, as of a launch, Python's own words tell it.
    """
    if isinstance(error, FileNotFoundError) or connection().missing_terminal() is Severity.ERROR:
        return None  # which file or program that is, is told elsewhere
    tree = tree_of(place.file)
    if tree is None:
        return None
    if isinstance(error, CalledProcessError):
        return _failed(error, place)
    node = tree.expression(place.file, place.span)
    for part in () if node is None else _parts(node, tree):
        found = _of_call(part, error, place, tree) if isinstance(part, ast.Call) else None
        if found is not None:
            return found
    return _refused(place, tree)


def _failed(error: CalledProcessError, place: Place) -> Explanation | None:
    program = _program(error.cmd)
    if error.returncode == _NOT_THERE and isinstance(error.cmd, str) and program is not None:
        severity, told, meant = connection().missing_program(program)
        return Explanation(told, Code.MISSING_EXECUTABLE, place.span, meant, severity=severity)
    if program not in _TELLING:
        return None
    told = f"'{program}' ends with {error.returncode}: what it is asked for is not {HERE}"
    return _lacking(told, Code.COMMAND_FAILED, place)


def _of_call(call: ast.Call, error: BaseException, place: Place, tree: Tree) -> Explanation | None:
    """Explain an exception by a call that asks for something of the machine."""
    name = ast.unparse(call.func)
    first, last = name.partition(".")[0], name.rpartition(".")[2]
    of_none = isinstance(error, AttributeError | TypeError) and "NoneType" in str(error)
    is_list = isinstance(error, _LISTS) or (
        isinstance(error, ValueError) and any(text in str(error) for text in _NONE_THERE)
    )
    if last in _LISTING and is_list:
        path = _path(call, tree)
        if path is not None and not glob.glob(path if last in ("glob", "iglob") else f"{path}/*"):  # noqa: PTH207 - as the code
            return _lacking(f"there is nothing at {path} {HERE}", Code.MISSING_FILE, place)
        is_folder = path is not None and last in ("listdir", "scandir")
        told = f"what is looked for in {path} is not {HERE}"
        return _lacking(told, Code.MISSING_FILE, place) if is_folder else None
    if last == "which" and (of_none or isinstance(error, TypeError)) and call.args:
        program = tree.meaning(call.args[0])
        if isinstance(program, ast.Constant) and isinstance(program.value, str):
            severity, told, meant = connection().missing_program(program.value)
            return Explanation(told, Code.MISSING_EXECUTABLE, place.span, meant, severity=severity)
    is_lack = is_list or isinstance(error, OSError) or of_none
    is_telling = last in _STARTING and _asks_the_machine(call, tree)
    if (first in _OF_NETWORKS and isinstance(error, OSError)) or (
        (first in _OF_DEVICES or is_telling) and is_lack
    ):
        told = f"what {name}() asks for ({type(error).__name__}: {error}) is not {HERE}"
        return _lacking(told, Code.COMMAND_FAILED, place)
    return None


def _refused(place: Place, tree: Tree) -> Explanation | None:
    """Explain what code raises itself because of a path that is not there."""
    line = place.span.line
    tests: list[ast.expr] = []
    for node in tree.nodes:
        match node:
            case ast.Assert(lineno=begin, end_lineno=end, test=test) if begin <= line <= (end or begin):
                tests.append(test)
            case ast.If(body=[first, *_] as body, test=test) if (
                first.lineno <= line <= (body[-1].end_lineno or 0)
            ):
                if any(map(_stops, body)):
                    tests.append(test)
    for part in (part for test in tests for part in _parts(test, tree)):
        if isinstance(part, ast.Call) and ast.unparse(part.func).rpartition(".")[2] in _ASKING:
            path = _path(part, tree)
            if path is not None and not glob.glob(path):  # noqa: PTH207 - as the code
                severity, told, meant = connection().missing_file(path, place.file)
                if severity is not Severity.ERROR:
                    return Explanation(told, Code.MISSING_FILE, place.span, meant, severity=severity)
    return None


def _stops(node: ast.stmt) -> bool:
    is_exit = isinstance(node, ast.Expr) and ast.unparse(node).partition("(")[0] in (
        "exit",
        "sys.exit",
        "quit",
    )
    return is_exit or isinstance(node, ast.Raise)


def _lacking(told: str, code: Code, place: Place) -> Explanation:
    return Explanation(told, code, place.span, severity=connection().missing_terminal())


def _parts(node: ast.expr, tree: Tree, depth: int = _DEPTH) -> Iterator[ast.AST]:
    """Yield what an expression is made of, and what its names stand for."""
    for part in ast.walk(node):
        yield part
        if isinstance(part, ast.Name) and depth:
            value = tree.meaning(part)
            if value is not part:
                yield from _parts(value, tree, depth - 1)


def _path(call: ast.Call, tree: Tree) -> str | None:
    """Return the path that a call asks for, where it is written and leads out of where launch files are."""
    given = list(call.args)
    if isinstance(call.func, ast.Attribute) and isinstance(held := tree.meaning(call.func.value), ast.Call):
        if ast.unparse(held.func).rpartition(".")[2] != "Path" or not held.args:
            return None
        given = [held.args[0], *given]
    known = [tree.meaning(item) for item in given[: 1 if len(given) == 1 else 2]]
    texts = [item.value for item in known if isinstance(item, ast.Constant) and isinstance(item.value, str)]
    path = os.path.join(*texts) if texts and texts[0].startswith(("/", "~")) else None  # noqa: PTH118 - names
    return None if path is None else os.path.expanduser(path)  # noqa: PTH111 - as above


def _program(command: object) -> str | None:
    """Return the program that a command starts with."""
    try:
        words = shlex.split(command) if isinstance(command, str) else list(map(str, command))  # type: ignore[call-overload] # a sequence, as subprocess takes
    except (TypeError, ValueError):
        return None
    return os.path.basename(words[0]) if words else None  # noqa: PTH119 - a name


def _asks_the_machine(call: ast.Call, tree: Tree) -> bool:
    """Return whether a call starts a program that tells of the machine."""
    first = tree.meaning(call.args[0]) if call.args else None
    if isinstance(first, ast.List | ast.Tuple) and first.elts:
        first = tree.meaning(first.elts[0])
    text = first.value if isinstance(first, ast.Constant) else None
    return isinstance(text, str) and _program(text) in _TELLING
