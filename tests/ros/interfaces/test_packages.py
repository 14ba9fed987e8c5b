"""Packages of definitions are imported like packages that are installed."""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from tests.ros.interfaces import own

if TYPE_CHECKING:
    from pathlib import Path

_INSTALL = (
    "from orchestra.ros.interfaces.definitions import install\nprint(install('own_interfaces', {folder!r}))\n"
)


def _run(folder: Path, program: str, *path: Path) -> list[str]:
    begin = f"import sys; sys.path[:0] = {[str(entry) for entry in path]!r}\n"
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", begin + _INSTALL.format(folder=str(folder)) + program],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split("\n")[:-1]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return own.write(tmp_path / "src" / "own_interfaces")


def test_every_way_to_import_and_to_copy(folder: Path) -> None:
    program = (
        "import copy, pickle, own_interfaces.action\n"
        "from own_interfaces.msg import *\n"
        "from own_interfaces.msg._whole import Whole as Same\n"
        "from own_interfaces import srv\n"
        "from own_interfaces.srv import Ask_Request\n"
        "from own_interfaces.action import Go, Go_SendGoal_Request\n"
        "whole = Whole(parts=[Part(name='x')])\n"
        "print(Whole is Same, srv.Ask.Request is Ask_Request, Go.Goal.__name__, dir(srv)[:4])\n"
        "print(pickle.loads(pickle.dumps(whole)) == whole, copy.deepcopy(whole) == whole, copy.copy(whole) == whole)\n"
        "print(Part.BIG, Part.S, Part().wide, Part.NAME__DEFAULT, Part().point, Whole().letter)\n"
        "other = copy.deepcopy(whole); other.parts[0].name = 'y'; print(other == whole)\n"
        "print(install('own_interfaces', '/'), Go.Impl.SendGoalService.Request is Go_SendGoal_Request)\n"
        "try: Go()\n"
        "except NotImplementedError as error: print(error)\n"
        "try: from own_interfaces.msg import Hole\n"
        "except ImportError as error: print('no Hole')\n"
    )
    assert _run(folder, program) == [
        "True",
        "True True Go_Goal ['Ask', 'Ask_Event', 'Ask_Request', 'Ask_Response']",
        "True True True",
        "-5 hi wod ab [1. 2. 3.] 65",
        "False",
        "False True",
        "Action classes can not be instantiated",
        "no Hole",
    ]


def test_a_real_package_wins(folder: Path, tmp_path: Path) -> None:
    real = tmp_path / "installed" / "own_interfaces" / "msg"
    real.mkdir(parents=True)
    (real / "__init__.py").write_text("class Whole: ...")
    (real.parent / "__init__.py").touch()
    program = "from own_interfaces.msg import Whole; print(Whole.__module__)"
    assert _run(folder, program, tmp_path / "installed") == ["False", "own_interfaces.msg"]


def test_the_folder_of_the_source_is_not_taken_for_the_package(folder: Path) -> None:
    program = "from own_interfaces.msg import Whole; print(Whole.__module__)"
    assert _run(folder, program, folder.parent) == ["True", "own_interfaces.msg._whole"]


def test_nothing_is_read_before_it_is_used(folder: Path) -> None:
    (folder / "msg" / "Bad.msg").write_text("flaot64 a\n")
    program = (
        "import own_interfaces.msg\n"
        "print('rosidl_adapter' in sys.modules)\n"
        "from own_interfaces.msg import Part\n"
        "try: from own_interfaces.msg import Bad\n"
        "except ImportError as error: print(error)\n"
    )
    found = _run(folder, program)
    assert found[:2] == ["True", "False"]
    assert "msg/Bad.msg:1:1: 'flaot64' is not a type" in found[2]


def test_what_orchestra_brings_comes_with_the_first(folder: Path) -> None:
    program = (
        "from tf2_msgs.action import LookupTransform\n"
        "from tf2_msgs.srv import FrameGraph\n"
        "from tf2_msgs.msg import TF2Error, TFMessage\n"
        "from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode\n"
        "for kind in (LookupTransform, FrameGraph, TFMessage, TF2Error, ListNodes, LoadNode, UnloadNode):\n"
        "    type(kind).__import_type_support__()\n"
        "    assert type(kind)._TYPE_SUPPORT is not None\n"
        "print(TFMessage.__module__, TF2Error.TIMEOUT_ERROR, LookupTransform.Result().error.error)"
    )
    assert _run(folder, program) == ["True", "tf2_msgs.msg._tf_message 5 0"]


def test_the_interpreter_ends_cleanly_with_services_and_actions(folder: Path) -> None:
    program = (
        "import gc\n"
        "from rclpy.serialization import deserialize_message, serialize_message\n"
        "from own_interfaces.msg import Whole\n"
        "from own_interfaces.srv import Ask\n"
        "from own_interfaces.action import Go\n"
        "for kind in (Ask, Go): type(kind).__import_type_support__()\n"
        "request = Ask.Request(number=7)\n"
        "print(deserialize_message(serialize_message(request), Ask.Request) == request)\n"
        "del Ask, Go, Whole; gc.collect()"
    )
    assert _run(folder, program) == ["True", "True"]
