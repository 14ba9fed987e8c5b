from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING

import pytest
from std_msgs.msg import String

from orchestra.errors import UsageError
from orchestra.ros import interfaces
from orchestra.ros.interfaces import UnknownMessageTypeError, message_type, tf_message_type

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.parametrize("name", ["std_msgs/msg/String", "std_msgs/String"])
def test_a_message_type_is_found_by_its_name(name: str) -> None:
    assert message_type(name) is String


@pytest.mark.parametrize("name", ["tf2_msgs/msg/TFMessage", "tf2_msgs/TFMessage"])
def test_tf_needs_no_package(name: str) -> None:
    assert message_type(name) is tf_message_type()


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("std_msg/msg/String", "package std_msg is not installed or has no messages; did you mean std_msgs"),
        ("std_msgs/msg/Strin", "package std_msgs has no message Strin; did you mean String"),
        ("std_msgs/msg/_string", "has no message _string"),
        ("os/msg/path", "package os is not installed or has no messages"),
        ("std_srvs/srv/Trigger", "names a type of kind srv"),
        ("tf2_msgs/msg/TF2Eror", "package tf2_msgs has no message TF2Eror; did you mean TF2Error"),
        ("String", "expected package/msg/Name"),
        ("", "expected package/msg/Name"),
        ("std_msgs/msg/String/", "expected package/msg/Name"),
        ("std_msgs/msgs/String", "expected package/msg/Name"),
        ("../msg/String", "expected package/msg/Name"),
    ],
)
def test_what_is_missing_is_told(name: str, told: str) -> None:
    with pytest.raises(UnknownMessageTypeError, match=told):
        message_type(name)


def test_a_wrong_name_is_the_users_mistake() -> None:
    assert issubclass(UnknownMessageTypeError, UsageError)


def _run(program: str, *path: Path) -> str:
    done = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path[:0] = {[str(entry) for entry in path]!r}\n{program}"],
        check=True,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.stderr == ""
    return done.stdout.strip()


def _package(folder: Path, content: str) -> Path:
    messages = folder / "tf2_msgs" / "msg"
    messages.mkdir(parents=True)
    (messages.parent / "__init__.py").touch()
    (messages / "__init__.py").write_text(content)
    return folder


_ASK = "from orchestra.ros.interfaces import tf_message_type, message_type, install\n"


def test_an_installed_package_wins(tmp_path: Path) -> None:
    found = _run(
        _ASK + "import tf2_msgs.msg as real\n"
        "print(tf_message_type() is real.TFMessage is message_type('tf2_msgs/msg/TFMessage'), install(),"
        " 'geometry_msgs' in sys.modules)",
        _package(tmp_path, "class TFMessage: ..."),
    )
    assert found == "True False False"


def test_a_broken_package_is_not_passed_over(tmp_path: Path) -> None:
    folder = _package(tmp_path, "import what_it_needs")
    program = _ASK + "try: tf_message_type()\nexcept ModuleNotFoundError as error: print(error.name)"
    assert _run(program, folder) == "what_it_needs"


def test_user_code_imports_the_package_once_installed() -> None:
    found = _run(
        _ASK + "print(install())\n"
        "import tf2_msgs.msg\n"
        "from tf2_msgs.msg import TFMessage\n"
        "import copy, pickle\n"
        "message = TFMessage()\n"
        "print(TFMessage is tf_message_type(), pickle.loads(pickle.dumps(message)) == message, install())"
    )
    assert found.split() == ["True", "True", "True", "False"]


def test_without_asking_there_is_no_such_package() -> None:
    assert _run(_ASK + "tf_message_type()\nprint('tf2_msgs' in sys.modules)") == "False"


@pytest.mark.parametrize("order", ["import rclpy\n{}", "{}\nimport rclpy"])
def test_it_does_not_matter_when_rclpy_is_imported(order: str) -> None:
    program = order.format(_ASK + "found = tf_message_type()") + (
        "\nfrom rclpy.serialization import serialize_message\nprint(serialize_message(found()).hex())"
    )
    assert _run(program) == "0001000000000000"


def test_a_node_that_wants_tf_pays_for_nothing_else() -> None:
    program = _ASK.replace(", message_type", "") + (
        "type(tf_message_type()).__import_type_support__()\n"
        "print(sorted({'rclpy', 'difflib', 'orchestra.errors'} & sys.modules.keys()))"
    )
    assert _run(program) == "[]"


def test_the_room_has_no_other_names() -> None:
    with pytest.raises(AttributeError, match="no attribute 'tf_type'"):
        _ = interfaces.tf_type  # type: ignore[attr-defined]  # the point of the test
    assert all(getattr(interfaces, name) for name in interfaces.__all__)
