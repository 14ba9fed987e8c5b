"""The words of the ROS command line."""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module
from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET

import pytest

from orchestra.cli.commands import COMMANDS
from orchestra.cli.ros.verbs import VerbParser
from orchestra.errors import UsageError

if TYPE_CHECKING:
    from pathlib import Path

    from tests.cli.conftest import Command

_ALL = [name for name, command in COMMANDS.items() if command.module.startswith("orchestra.cli.ros.")]
_COMMANDS = [name for name in _ALL if isinstance(import_module(COMMANDS[name].module).parser(), VerbParser)]


def _parser(command: str) -> VerbParser:
    made = import_module(COMMANDS[command].module).parser()
    assert isinstance(made, VerbParser)
    return made


@pytest.mark.parametrize("command", _COMMANDS)
def test_each_verb_names_a_tool_that_is_there(command: str) -> None:
    for name, verb in _parser(command).verbs.items():
        if verb.tool:
            pytest.importorskip("rclpy", reason="needs ROS")
            module, _, function = verb.tool.partition(":")
            tool = import_module(f"orchestra.ros.tools.{module}")
            assert callable(getattr(tool, function)), f"{command} {name}"


@pytest.mark.parametrize("command", _COMMANDS)
def test_each_verb_has_a_help(orchestra_here: Command, command: str) -> None:
    overview = orchestra_here(command)
    assert overview.returncode == 0
    for verb in _parser(command).verbs:
        assert f"\n  {verb} " in overview.stdout
        told = orchestra_here(command, verb, "--help")
        assert told.returncode == 0
        assert told.stdout.startswith(f"usage: orchestra {command} {verb} ")
        assert "--format {text,json}" in told.stdout


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("topic", "ecko"), "there is no verb 'ecko' of topic; did you mean 'echo'?"),
        (("topic", "--verbose"), "a verb is missing"),
        (("topic", "echo"), "the following arguments are required: TOPIC"),
        (("topic", "echo", "/a", "--once", "-n", "2"), "not allowed with argument"),
        (("topic", "pub", "/a", "std_msgs/msg/String", "-r", "0"), "'0' is no number above 0"),
        (("topic", "hz", "/a", "-w", "0"), "'0' is less than 1"),
        (("param", "get", "/a"), "the following arguments are required: NAME"),
        (("node", "list", "--spin-time", "-1"), "--spin-time"),
    ],
)
def test_words_that_make_no_sense_are_told(
    orchestra_here: Command, words: tuple[str, ...], told: str
) -> None:
    done = orchestra_here(*words)
    assert done.returncode == 2
    assert told in done.stderr


def test_options_may_stand_before_the_verb() -> None:
    options = _parser("topic").read(["--include-hidden-topics", "list", "-t"])
    assert (options.verb, options.include_hidden_topics, options.show_types) == ("list", True, True)


def test_the_options_of_the_ros_2_tools_are_understood() -> None:
    read = _parser("topic").read
    words = (
        "echo /a std_msgs/msg/String --qos-profile sensor_data --qos-depth 3 --qos-reliability reliable --csv"
    )
    echo = read(words.split())
    assert (echo.topic, echo.type, echo.qos_depth, echo.truncate_given) == (
        "/a",
        "std_msgs/msg/String",
        3,
        None,
    )
    pub = read(["pub", "-1", "/a", "std_msgs/msg/Int32", "{data: -1}", "-w", "2", "--keep-alive", "1"])
    assert (pub.once, pub.values, pub.wait_matching_subscriptions) == (True, "{data: -1}", 2)
    param = _parser("param").read(["set", "/a", "b", "-1"])
    assert param.value == "-1"


def test_a_verb_that_is_missing_is_no_bug() -> None:
    with pytest.raises(UsageError):
        _parser("node").read(["-x"])


def test_the_words_are_read_without_rclpy() -> None:
    """Nor is anything of it imported for what is installed."""
    code = (
        "import sys\n"
        "from orchestra.cli.main import main\n"
        "for words in (['interface', 'list'], ['pkg', 'list'], ['topic', '--help']): assert main(words) == 0\n"
        "heavy = {'rclpy', 'pydantic', 'yaml', 'numpy', 'rosidl_parser', 'orchestra.ros'} & set(sys.modules)\n"
        "assert not heavy, heavy\n"
    )
    subprocess.run([sys.executable, "-c", code], stdout=subprocess.DEVNULL, check=True)


def test_packages_are_listed_with_their_executables(orchestra_here: Command, prefix: Path) -> None:
    here = {"AMENT_PREFIX_PATH": str(prefix)}
    assert "demo\n" in orchestra_here("pkg", "list", **here).stdout
    assert orchestra_here("pkg", "prefix", "demo", **here).stdout == f"{prefix}\n"
    assert orchestra_here("pkg", "prefix", "demo", "--share", **here).stdout == f"{prefix}/share/demo\n"
    assert orchestra_here("pkg", "executables", "demo", **here).stdout == "demo echo\ndemo talker\n"
    paths = orchestra_here("pkg", "executables", "demo", "--full-path", **here).stdout
    assert paths == f"{prefix}/lib/demo/echo\n{prefix}/lib/demo/talker\n"
    unknown = orchestra_here("pkg", "prefix", "demmo", **here)
    assert (unknown.returncode, unknown.stderr) == (
        1,
        "error: Package not found: 'demmo'; did you mean demo?\n",
    )


def test_a_package_xml_is_shown(orchestra_here: Command, prefix: Path) -> None:
    here = {"AMENT_PREFIX_PATH": str(prefix)}
    assert orchestra_here("pkg", "xml", "demo", **here).returncode == 1
    text = "<package><version>1.2</version><depend>a</depend><depend>b</depend></package>\n"
    (prefix / "share" / "demo" / "package.xml").write_text(text)
    assert orchestra_here("pkg", "xml", "demo", **here).stdout == text
    assert orchestra_here("pkg", "xml", "demo", "-t", "depend", **here).stdout == "a\nb\n"


@pytest.mark.parametrize("error", [KeyError("uid not found: 1234"), OSError("No username set")], ids=repr)
def test_a_package_may_be_created_by_a_user_without_a_name(
    orchestra_here: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    def refuse() -> str:
        raise error

    monkeypatch.setattr("getpass.getuser", refuse)
    made = orchestra_here("pkg", "create", "my_robot", "--destination-directory", str(tmp_path))
    assert made.returncode == 0
    assert ">nobody</maintainer>" in (tmp_path / "my_robot" / "package.xml").read_text("utf-8")


def test_a_package_is_created_that_can_be_installed(orchestra_here: Command, tmp_path: Path) -> None:
    words = ("pkg", "create", "my_robot", "--destination-directory", str(tmp_path), "--node-name", "my_node")
    made = orchestra_here(*words, "--dependencies", "std_msgs", "--description", "a < b 'c'")
    assert made.returncode == 0
    folder = tmp_path / "my_robot"
    assert {path.removeprefix(f"creating {folder}/") for path in made.stdout.splitlines()} == {
        *("package.xml", "setup.py", "setup.cfg"),
        *("resource/my_robot", "my_robot/__init__.py", "my_robot/my_node.py"),
    }
    manifest = ET.fromstring((folder / "package.xml").read_text("utf-8"))  # noqa: S314 - we have written it
    assert [one.text for one in manifest.findall("depend")] == ["rclpy", "std_msgs"]
    assert manifest.findtext("description") == "a < b 'c'"
    asked = [sys.executable, "setup.py", "--name", "--description"]
    told = subprocess.run(asked, cwd=folder, capture_output=True, text=True, check=True)
    assert told.stdout.splitlines()[-2:] == ["my_robot", "a < b 'c'"]
    compile((folder / "my_robot" / "my_node.py").read_text("utf-8"), "my_node.py", "exec")
    again = orchestra_here(*words)
    assert (again.returncode, again.stderr) == (1, f"error: The directory already exists: {folder}\n")


@pytest.mark.parametrize(
    "words",
    [("My",), ("a-b",), ("test",), ("a_b", "--node-name", "1"), ("a_b", "--build-type", "ament_cmake")],
)
def test_a_package_that_could_not_be_used_is_not_created(
    orchestra_here: Command, tmp_path: Path, words: tuple[str, ...]
) -> None:
    folder = tmp_path / "here"
    folder.mkdir()
    done = orchestra_here("pkg", "create", *words, "--destination-directory", str(folder))
    assert done.returncode == 2
    assert list(folder.iterdir()) == []
