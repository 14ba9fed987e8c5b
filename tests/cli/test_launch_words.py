"""The words and options of `ros2 launch`, and the forms in which a launch file can be named, of the real program."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from pathlib import Path
    from subprocess import CompletedProcess

    from .conftest import Command


@pytest.fixture
def orchestra(orchestra_quickly: Command) -> Command:
    """Run the command; what starts nothing, in this process."""
    return orchestra_quickly


_YAML = "launch:\n  - arg: {name: a, default: x}\n  - executable: {cmd: 'echo [$(var a)]', name: tell}\n"
_XML = '<launch><arg name="a" default="x"/><executable cmd="echo [$(var a)]" name="tell"/></launch>\n'
_PYTHON = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration

def generate_launch_description():
    told = ["[", LaunchConfiguration("a"), "]"]
    return LaunchDescription([
        DeclareLaunchArgument("a", default_value="x"), ExecuteProcess(cmd=["echo", told], name="tell")
    ])
"""


@pytest.fixture(autouse=True)
def _files(folder: Path, prefix: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    launch = prefix / "share" / "demo" / "launch"
    texts = {"yaml.launch.yaml": _YAML, "xml_launch.xml": _XML, "python.launch.py": _PYTHON}
    for name, text in texts.items():
        (launch / name).write_text(text)
        (folder / name).write_text(text)
    for name in ("both.launch.yaml", "both_launch.yaml"):
        (launch / name).write_text(_YAML)


_FORMS = [
    "yaml.launch.yaml",
    "./xml_launch.xml",
    "python.launch.py",
    "demo yaml.launch.yaml",
    "demo launch/xml_launch.xml",
    "demo python.launch.py",
    "demo yaml",
    "demo xml",
    "demo python",
    "demo/yaml",
    "demo/xml",
    "demo/python",
    "demo/python.launch.py",
]


@pytest.mark.conforms("5.2 package and file", "5.2 loader")
@pytest.mark.parametrize("form", ["./python.launch.py", "demo xml_launch.xml", "demo python", "demo/yaml"])
def test_a_named_launch_file_is_launched(orchestra: Command, form: str) -> None:
    found = orchestra("launch", *form.split(), "a:=moon")
    assert found.returncode == 0
    assert "[moon]" in found.stdout


@pytest.mark.conforms("5.2 package and file", "5.2 a file")
@pytest.mark.parametrize("form", _FORMS)
def test_a_launch_file_can_be_named_in_many_ways(orchestra: Command, form: str) -> None:
    plan = orchestra("plan", *form.split(), "a:=moon", "--format", "json")
    assert [process["command"] for process in json.loads(plan.stdout)["processes"]] == [["echo", "[moon]"]]


@pytest.mark.parametrize(
    "form",
    [
        "xml_launch.xml",
        "demo python.launch.py",
        "demo yaml",
        "demo/yaml python.launch.py",
        "demo xml demo yaml .",
    ],
)
def test_the_same_forms_can_be_checked(orchestra: Command, form: str) -> None:
    found = orchestra("check", *form.split(), "a:=moon")
    assert (found.returncode, found.stderr) == (0, "")
    assert found.stdout.startswith("no problems in ")


def test_a_package_can_be_checked_as_a_whole(orchestra: Command) -> None:
    assert orchestra("check", "demo").stdout == "no problems in 5 files\n"
    assert orchestra("check", "--no-cache", "demo", "python.launch.py").stdout == "no problems in 6 files\n"


@pytest.mark.conforms("5.2 package and file")
@pytest.mark.parametrize(
    ("command", "form", "message"),
    [
        ("launch", "demo both", "has more than one both: launch/both.launch.yaml, launch/both_launch.yaml"),
        (
            "plan",
            "demo/both",
            "more than one launch file is demo/both: launch/both.launch.yaml, launch/both_launch.yaml",
        ),
        (
            "launch",
            "demo yalm.launch.yaml",
            "has no launch file yalm.launch.yaml: did you mean 'yaml.launch.yaml'?",
        ),
        ("check", "demo pyhton", "has no launch file pyhton: did you mean 'python'?"),
        ("launch", "demo/pyhton", "there is no launch file demo/pyhton, nor has the package 'demo' one"),
    ],
)
def test_a_name_that_means_nothing_is_a_mistake(
    orchestra: Command, command: str, form: str, message: str
) -> None:
    found = orchestra(command, *form.split())
    assert (found.returncode, found.stdout) == (2, "")
    told, helped = found.stderr.splitlines()
    assert told.startswith("error: ")
    assert message in told
    assert helped == f"help: see 'orchestra {command} --help'"


@pytest.mark.conforms("5.2 unknown package")
def test_a_package_that_is_not_there_is_a_mistake(orchestra: Command) -> None:
    launched = orchestra("launch", "dmeo", "python").stderr
    assert launched.startswith("error: there is no package 'dmeo': did you mean 'demo'?\n")
    checked = orchestra("check", "dmeo", "python").stderr
    assert checked.startswith(
        "error: there is no file, folder or package dmeo; did you mean the package 'demo'?\n"
    )
    unset = orchestra("launch", "dmeo", "python", AMENT_PREFIX_PATH="").stderr
    assert "(AMENT_PREFIX_PATH is not set: the setup file of a workspace sets it)\n" in unset


@pytest.mark.conforms("5.2 no file")
def test_a_package_alone_is_answered_with_its_launch_files(orchestra: Command) -> None:
    found = orchestra("launch", "demo")
    assert found.returncode == 2
    assert found.stderr.startswith(
        "error: which launch file of the package 'demo'? it has both.launch.yaml, both_launch.yaml, python.launch.py,"
    )


@pytest.mark.conforms("5.3 a:=b", "5.3 a:=b:=c", "5.3 a:=", "5.3 repeated", "D47", "5.3 quoting")
@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("a:=b", "[b]"),
        ("a:=b:=c", "[b:=c]"),
        ("a:=", "[]"),  # upstream has no way to say it
        ("a:=b a:=c", "[c]"),
    ],
)
def test_launch_arguments(orchestra: Command, words: str, told: str) -> None:
    found = orchestra("launch", "python.launch.py", *words.split())
    assert found.returncode == 0
    assert told in found.stdout


@pytest.mark.conforms("5.3 a")
@pytest.mark.parametrize("word", ["a", ":=b", "a :=b", ""])
def test_what_is_no_launch_argument_is_a_mistake(orchestra: Command, word: str, home: Path) -> None:
    found = orchestra("launch", "yaml.launch.yaml", word)
    assert (found.returncode, found.stdout) == (2, "")
    assert f"'{word}' is none of NAME:=VALUE and NODE:NAME:=VALUE" in found.stderr
    assert not home.exists()


def test_an_equals_sign_alone_is_probably_a_slip(orchestra: Command) -> None:
    assert "did you mean 'a:=b'?" in orchestra("launch", "yaml.launch.yaml", "a=b").stderr


@pytest.mark.conforms("5.3 undeclared", "D3")
def test_an_argument_that_there_is_not_is_a_mistake(orchestra: Command) -> None:
    """Upstream takes it without a word."""
    found = orchestra("launch", "python.launch.py", "bb:=x")
    assert (found.returncode, found.stdout) == (2, "")
    assert "command line:1:1: error: " in found.stderr


@pytest.mark.conforms("5.1 --noninteractive", "5.1 --debug")
@pytest.mark.parametrize(
    "words",
    [
        "-n -d -a demo yaml a:=b",
        "demo --noninteractive --debug yaml --show-all-subprocesses-output a:=b",
        "demo yaml a:=b -nda",
    ],
)
def test_options_stand_before_and_behind_the_words(orchestra: Command, words: str) -> None:
    found = orchestra("launch", *words.split())
    assert found.returncode == 0
    assert "[b]" in found.stdout


def _commands(found: CompletedProcess[str]) -> list[Any]:
    return [process["command"] for process in json.loads(found.stdout)["processes"]]


@pytest.mark.conforms("5.1 --launch-prefix", "5.1 --launch-prefix-filter")
@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ((), ["echo", "[x]"]),
        (("--launch-prefix", "env A=1"), ["env", "A=1", "echo", "[x]"]),
        (("--launch-prefix=env 'A B'=1",), ["env", "A B=1", "echo", "[x]"]),
        (("launch-prefix:=nice", "--launch-prefix", "env"), ["env", "echo", "[x]"]),
        (("launch-prefix:=nice", "launch-prefix-filter:=e"), ["nice", "echo", "[x]"]),
        (("--launch-prefix", "nice", "--launch-prefix-filter", "ec.o"), ["nice", "echo", "[x]"]),
        (("--launch-prefix", "nice", "--launch-prefix-filter", "talker|cho"), ["echo", "[x]"]),
        (("--launch-prefix", "nice", "--launch-prefix-filter", ""), ["nice", "echo", "[x]"]),
    ],
)
def test_a_prefix_for_all_processes(
    orchestra: Command, options: tuple[str, ...], expected: list[str]
) -> None:
    assert _commands(orchestra("plan", "yaml.launch.yaml", "--format", "json", *options)) == [expected]


@pytest.mark.conforms("5.1 --launch-prefix")
def test_a_prefix_is_run(orchestra: Command) -> None:
    found = orchestra("launch", "yaml.launch.yaml", "--launch-prefix", "sh -c 'echo before; exec \"$@\"' sh")
    assert found.returncode == 0
    assert "before" in found.stdout
    assert "[x]" in found.stdout


@pytest.mark.conforms("5.1 --launch-prefix-filter")
@pytest.mark.parametrize("command", ["launch", "plan"])
def test_a_filter_wants_a_prefix(orchestra: Command, command: str) -> None:
    found = orchestra(command, "yaml.launch.yaml", "--launch-prefix-filter", "e")
    assert (found.returncode, found.stdout) == (2, "")
    assert found.stderr.startswith("error: --launch-prefix-filter wants --launch-prefix too\n")


@pytest.mark.parametrize(
    ("options", "message", "source"),
    [
        (("--launch-prefix", "x", "--launch-prefix-filter", "("), "is no regular expression", "launch-prefix-filter:=("),
        (("--launch-prefix", "'x"), "is no command", "launch-prefix:='x"),
    ],
)  # fmt: skip
def test_a_faulty_prefix_is_pointed_at(
    orchestra: Command, options: tuple[str, ...], message: str, source: str
) -> None:
    found = orchestra("launch", "yaml.launch.yaml", "a:=b", *options)
    assert (found.returncode, found.stdout) == (2, "")
    assert message in found.stderr
    assert source in found.stderr


@pytest.mark.conforms("5.1 --print", "D46", "5.4 -p")
def test_print_is_the_plan(orchestra: Command, home: Path) -> None:
    words = ("demo", "python", "a:=b", "--launch-prefix", "nice")
    planned = orchestra("plan", *words)
    assert "nice echo '[b]'" in planned.stdout
    for flag in ("-p", "--print", "--print-description", "-np"):
        printed = orchestra("launch", *words, flag)
        assert (printed.returncode, printed.stdout, printed.stderr) == (0, planned.stdout, planned.stderr)
    assert not home.exists()
