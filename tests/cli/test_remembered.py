"""A plan that is remembered is the one that would be made; whatever it depends on, another one is another plan."""

from __future__ import annotations

import json
import os
import shutil
import stat
import subprocess
import sys
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import pytest

import orchestra
from orchestra.supervise.resolver import document
from orchestra.witness.digest import digest_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.plan import model

_MAIN = """\
launch:
  - arg: {name: robot, default: $(env ROBOT nobody)}
  - include: {file: part.launch.xml, arg: [{name: name, value: $(var robot)}]}
  - include: {file: part.launch.py}
  - node: {pkg: demo, exec: talker, name: talker, param: [{from: params.yaml}]}
  - node: {pkg: grown, exec: walker, name: walker}
  - executable: {cmd: tool}
"""
_XML = '<launch><arg name="name"/><log message="$(var name)"/></launch>\n'
_PYTHON = """\
import os
from launch import LaunchDescription
from launch.actions import LogInfo
import helper

HERE = os.path.dirname(__file__)

def generate_launch_description():
    with open(os.path.join(HERE, "words.txt")) as file:
        found = [LogInfo(msg=file.read()), LogInfo(msg=helper.WORDS), LogInfo(msg=os.environ.get("MODE", "no mode"))]
    found += [LogInfo(msg=name) for name in sorted(os.listdir(os.path.join(HERE, "parts")))]
    if os.path.isdir(os.path.join(HERE, "extra")):
        found.append(LogInfo(msg="extra"))
    return LaunchDescription(found)
"""
_FILES = {
    "work/main.launch.yaml": _MAIN,
    "work/part.launch.xml": _XML,
    "work/part.launch.py": _PYTHON,
    "work/words.txt": "hello",
    "work/parts/one": "",
    "work/params.yaml": "/talker:\n  ros__parameters: {rate: 1}\n",
    "lib/helper.py": "WORDS = 'helped'\n",
    "lib/grown/__init__.py": "",
    "lib/grown/nodes/walker.py": "",
    "prefix/share/ament_index/resource_index/packages/demo": "",
    "prefix/lib/demo/talker": "#!/bin/sh\n",
    "bin/tool": "#!/bin/sh\n",
}


class Rememberer:
    """Makes and recalls plans in one place after the other, each time as a command of its own would."""

    def __init__(self, folder: Path, pipe: subprocess.Popen[str]) -> None:
        self.folder = folder
        self._pipe = pipe
        self.environment: dict[str, str] = {}

    def settle(self, folder: Path) -> None:
        """Begin in an empty place."""
        self.folder = folder
        path = f"{folder}/bin:/usr/bin:/bin"
        self.environment = {
            "PATH": path,
            "HOME": str(folder),
            "PYTHONPATH": str(folder / "lib"),
            "AMENT_PREFIX_PATH": str(folder / "prefix"),
            "ORCHESTRA_CACHE": str(folder / "cache"),
            "ORCHESTRA_RUN": "a-run",
        }
        for name, text in _FILES.items():
            self.write(name, text)

    def write(self, name: str, text: str) -> None:
        """Write a file, which can be executed where it is a program."""
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        if text.startswith("#!"):
            path.chmod(0o755)

    def _ask(self, do: str, words: tuple[str, ...]) -> Any:
        question = {
            "do": do,
            "words": ["launch", *words],
            "folder": str(self.folder / "work"),
            "environment": self.environment,
        }
        _in(self._pipe).write(json.dumps(question) + "\n")
        _in(self._pipe).flush()
        answer = json.loads(_out(self._pipe).readline())
        assert answer is not None
        return answer

    def make(self, *words: str) -> Any:
        """Make a plan as a launch does, and keep it where that can be."""
        answer = self._ask("make", words or ("main.launch.yaml",))
        sys.stderr.write(
            f"kept: {answer['kept']}, {answer['why']}\n{answer['told']}"
        )  # seen where a test fails
        return answer

    def recall(self, *words: str) -> str | None:
        """Return the document that is remembered."""
        remembered: str | None = self._ask("recall", words or ("main.launch.yaml",))["document"]
        return remembered


def _processes(made: Any) -> tuple[model.Process, ...]:
    return document.loads(made["document"].encode("utf-8", "surrogatepass")).plan.processes


def _in(pipe: subprocess.Popen[str]) -> IO[str]:
    assert pipe.stdin is not None
    return pipe.stdin


def _out(pipe: subprocess.Popen[str]) -> IO[str]:
    assert pipe.stdout is not None
    return pipe.stdout


@pytest.fixture(scope="module")
def pipe(tmp_path_factory: pytest.TempPathFactory) -> Iterator[subprocess.Popen[str]]:
    program = Path(__file__).with_name("rememberer.py")
    lib = tmp_path_factory.mktemp("place") / "lib"
    environment = {**os.environ, "PYTHONPATH": f"{lib}:{os.environ.get('PYTHONPATH', '')}"}
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen([sys.executable, program], text=True, env=environment, **pipes) as popen:  # type: ignore[call-overload]
        popen.place = lib.parent
        yield popen
        popen.stdin.close()


@pytest.fixture
def plans(pipe: Any) -> Iterator[Rememberer]:
    """One place for all: it is on the import path of the process that answers."""
    rememberer = Rememberer(pipe.place, pipe)
    rememberer.settle(pipe.place)
    yield rememberer
    shutil.rmtree(pipe.place)


def test_what_has_not_changed_is_remembered_to_the_byte(plans: Rememberer) -> None:
    made = plans.make()
    assert made["kept"]
    assert _processes(made)
    assert plans.recall() == made["document"] == plans.make()["document"]
    plans.environment["ORCHESTRA_RUN"] = "another-run"
    plans.environment["NOBODY_READS_IT"] = "1"
    assert plans.recall() == made["document"]


def _replaced(name: str, old: str, new: str) -> Callable[[Rememberer], None]:
    def change(plans: Rememberer) -> None:
        text = (plans.folder / name).read_text()
        assert old in text
        plans.write(name, text.replace(old, new))

    return change


def _added(name: str, text: str = "") -> Callable[[Rememberer], None]:
    return lambda plans: plans.write(name, text)


def _set(name: str, value: str) -> Callable[[Rememberer], None]:
    return lambda plans: plans.environment.update({name: value})


def _without_run_bit(name: str) -> Callable[[Rememberer], None]:
    return lambda plans: (plans.folder / name).chmod(0o644)


def _removed(name: str) -> Callable[[Rememberer], None]:
    return lambda plans: (plans.folder / name).unlink()


def _earlier_package(plans: Rememberer) -> None:
    plans.write("early/share/ament_index/resource_index/packages/demo", "")
    plans.write("early/lib/demo/talker", "#!/bin/sh\n")
    plans.environment["AMENT_PREFIX_PATH"] = f"{plans.folder}/early:{plans.folder}/prefix"


def _earlier_program(plans: Rememberer) -> None:
    plans.write("sbin/tool", "#!/bin/sh\n")
    plans.environment["PATH"] = f"{plans.folder}/sbin:{plans.environment['PATH']}"


_CHANGES: dict[str, Callable[[Rememberer], None]] = {
    "the file": _replaced("work/main.launch.yaml", "nobody", "somebody"),
    "an included file": _replaced("work/part.launch.xml", "$(var name)", "other"),
    "a parameter file": _replaced("work/params.yaml", "rate: 1", "rate: 2"),
    "a file in Python": _replaced("work/part.launch.py", "no mode", "nothing"),
    "a module of it": _replaced("lib/helper.py", "helped", "no help"),
    "a file that it reads": _replaced("work/words.txt", "hello", "bye"),
    "a folder that it lists": _added("work/parts/two"),
    "a folder that it looks for": _added("work/extra/file"),
    "a variable that it reads": _set("MODE", "wild"),
    "a variable of a substitution": _set("ROBOT", "r2"),
    "a package that is found earlier": _earlier_package,
    "settings": _added("work/orchestra.toml", '[severity]\nORC001 = "off"\n'),
    "an executable of the same name": _earlier_program,
}


@pytest.mark.parametrize("change", _CHANGES.values(), ids=list(_CHANGES))
def test_a_change_makes_another_plan(plans: Rememberer, change: Callable[[Rememberer], None]) -> None:
    before = plans.make()
    assert before["kept"]
    change(plans)
    assert plans.recall() is None
    after = plans.make()
    assert after["kept"]
    assert plans.recall() == after["document"]


_FAULTS: dict[str, Callable[[Rememberer], None]] = {
    "an executable is gone": _removed("prefix/lib/demo/talker"),
    "it has lost its run bit": _without_run_bit("prefix/lib/demo/talker"),
    "a package is gone": _removed("prefix/share/ament_index/resource_index/packages/demo"),
    "a module of a package is gone": _removed("lib/grown/nodes/walker.py"),
    "a package in Python is none any more": _removed("lib/grown/__init__.py"),
    "a parameter file is gone": _removed("work/params.yaml"),
    "an included file is gone": _removed("work/part.launch.xml"),
}


@pytest.mark.parametrize("fault", _FAULTS.values(), ids=list(_FAULTS))
def test_what_is_not_there_any_more_is_missed(plans: Rememberer, fault: Callable[[Rememberer], None]) -> None:
    assert plans.make()["kept"]
    fault(plans)
    assert plans.recall() is None


def test_other_words_and_other_places_are_other_launches(plans: Rememberer) -> None:
    made = plans.make("main.launch.yaml", "robot:=r1")
    assert plans.recall() is None
    assert plans.recall("main.launch.yaml", "robot:=r2") is None
    assert plans.recall("main.launch.yaml", "robot:=r1") == made["document"]
    assert plans.recall("main.launch.yaml", "robot:=r1", "--no-cache") is None
    shutil.copytree(plans.folder / "work", plans.folder / "elsewhere/work")
    place, plans.folder = plans.folder, plans.folder / "elsewhere"
    assert plans.recall("main.launch.yaml", "robot:=r1") is None
    plans.folder = place


# Large enough for its compiled code to be kept as well.
_LARGE = f"""\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("rate", default_value="1"),
        ExecuteProcess(cmd=["tool", LaunchConfiguration("rate")]),
    ])
{"# It is a long file." * 1000}
"""


def test_plans_do_not_depend_on_code_that_is_kept(plans: Rememberer) -> None:
    plans.write("work/large.launch.py", _LARGE)
    made = plans.make("large.launch.py")
    assert list((plans.folder / "cache/codes").iterdir())
    other = plans.make("large.launch.py", "rate:=2")
    assert made["kept"]
    assert other["kept"]
    shutil.rmtree(plans.folder / "cache/codes")
    assert plans.recall("large.launch.py") == made["document"]
    assert plans.recall("large.launch.py", "rate:=2") == other["document"] != made["document"]


def test_nothing_is_kept_where_nobody_wants_it(plans: Rememberer) -> None:
    plans.write("work/large.launch.py", _LARGE)
    for file in ("main.launch.yaml", "large.launch.py"):
        assert not plans.make(file, "--no-cache")["kept"]
        assert not (plans.folder / "cache").exists()


_UNKNOWABLE = {
    "time": "import time\nnow = str(time.time())",
    "chance": "import random\nnow = str(random.random())",
    "a program": "import subprocess\nnow = subprocess.run(['date'], capture_output=True).stdout.decode()",
    "the network": "import socket\nnow = str(socket.getaddrinfo('localhost', 80))",
    "the kernel": "now = open('/proc/uptime').read()",
    "output": "print('hello')\nnow = ''",
    "an error stream": "import sys\nsys.stderr.write('hello')\nnow = ''",
    "a log": "import logging\nlogging.warning('hello')\nnow = ''",
    "a file that it writes": "open('/tmp/orchestra-test-written', 'w').close()\nnow = ''",
    "a temporary file": "import tempfile\nnow = tempfile.mkstemp()[1]",
    "a thread": "import threading\nthreading.Thread(target=print).start()\nnow = ''",
    "its process": "import os\nnow = str(os.getpid())",
}


@pytest.mark.parametrize("code", _UNKNOWABLE.values(), ids=list(_UNKNOWABLE))
def test_what_nobody_can_record_is_not_kept(plans: Rememberer, code: str) -> None:
    python = f"from launch import LaunchDescription\nfrom launch.actions import LogInfo\n{code}\n"
    python += "def generate_launch_description():\n    return LaunchDescription([LogInfo(msg=now)])\n"
    plans.write("work/odd.launch.py", python)
    assert not plans.make("odd.launch.py")["kept"]
    assert plans.recall("odd.launch.py") is None


@pytest.mark.parametrize(
    "action",
    [
        "log: {message: $(command 'date')}",
        "executable: {cmd: tool, limits: {memory: 1 GiB}}",
        'log: {message: "$(eval \'__import__(\\"time\\").time()\')"}',
    ],
)
def test_what_is_another_question_each_time_is_not_kept(plans: Rememberer, action: str) -> None:
    plans.write("work/odd.launch.yaml", f"launch:\n  - {action}\n")
    assert not plans.make("odd.launch.yaml")["kept"]


def test_a_launch_file_whose_code_decides_later_is_not_kept(plans: Rememberer) -> None:
    python = """\
from launch import LaunchDescription
from launch.actions import ExecuteProcess, OpaqueFunction, TimerAction
def generate_launch_description():
    return LaunchDescription([ExecuteProcess(cmd=["tool"]),
                              TimerAction(period=0.1, actions=[OpaqueFunction(function=lambda context: None)])])
"""
    plans.write("work/later.launch.py", python)
    assert not plans.make("later.launch.py")["kept"]


def test_warnings_are_told_again(plans: Rememberer) -> None:
    plans.write("work/params.yaml", "/nobody:\n  ros__parameters: {rate: 1}\n")
    made = plans.make()
    assert made["kept"]
    assert "nobody" in made["told"]
    assert plans._ask("recall", ("main.launch.yaml",))["told"] == made["told"]


def _entry(plans: Rememberer) -> Path:
    (entry,) = (plans.folder / "cache/plans").iterdir()
    return entry


def test_an_entry_that_is_damaged_or_of_others_is_none(plans: Rememberer) -> None:
    made = plans.make()
    entry = _entry(plans)
    whole = entry.read_bytes()
    assert stat.S_IMODE(entry.stat().st_mode) == 0o600
    for content in (b"", b"nonsense", whole[: len(whole) // 2], whole.replace(b'"told"', b'"tols"')):
        entry.write_bytes(content)
        assert plans.recall() is None
    entry.write_bytes(whole)
    assert plans.recall() == made["document"]
    entry.chmod(0o666)
    assert plans.recall() is None
    entry.chmod(0o600)
    if os.getuid() == 0:
        os.chown(entry, 12345, -1)
        assert plans.recall() is None


def test_an_entry_of_another_version_is_none(plans: Rememberer) -> None:
    plans.make()
    entry = _entry(plans)
    told, _, document = entry.read_bytes().partition(b"\n")[2].partition(b"\n")
    content = json.loads(told)
    _put(entry, content, document)
    assert plans.recall() is not None
    ours = str(Path(orchestra.__file__).parent)
    files = content["result"]["code"]
    for part in ("resolve/resolve.py", "load/yaml_file.py", "plan/build.py", "description/launch.py"):
        assert f"{ours}/{part}" in files
    files[f"{ours}/plan/build.py"][0] += 1
    _put(entry, content, document)
    assert plans.recall() is None


def _put(entry: Path, content: object, document: bytes) -> None:
    body = json.dumps(content).encode() + b"\n" + document
    entry.write_bytes(digest_of(body).encode() + b"\n" + body)


@pytest.mark.parametrize("place", ["/proc/nowhere", "/dev/full/cache", "work/main.launch.yaml"])
def test_where_nothing_can_be_kept_nothing_else_is_amiss(plans: Rememberer, place: str) -> None:
    plans.environment["ORCHESTRA_CACHE"] = place if place.startswith("/") else str(plans.folder / place)
    made = plans.make()
    assert _processes(made)
    assert made["told"] == ""
    assert plans.recall() is None
