"""What code has asked for in vain, has caught, and goes no further without: told as if it had not been caught."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from tests.cli.conftest import Command

_ABOVE: Final = """\
import contextlib, os, sys, yaml
from importlib.util import find_spec
from ament_index_python.packages import PackageNotFoundError, get_package_share_directory
from launch import LaunchDescription
from launch.actions import LogInfo

"""
_BELOW: Final = """

def generate_launch_description():
    {}
    return LaunchDescription([LogInfo(msg=str(found))])
"""
_TRIED: Final = "try:\n    import qq_xacro\n{}except ImportError as error:\n    {}\n"
_LOADING: Final = """\
def load(package):
    try:
        with open(os.path.join(get_package_share_directory(package), 'a.yaml')) as stream:
            return yaml.safe_load(stream)
    except Exception:
        return None
"""
_FINDING: Final = """\
def find(*packages):
    for package in packages:
        try:
            return get_package_share_directory(package)
        except PackageNotFoundError:
            continue
    raise FileNotFoundError('none of ' + ', '.join(packages))
"""


@pytest.fixture
def problems(orchestra_here: Command, folder: Path) -> Callable[..., list[dict[str, Any]]]:
    """Return what `orchestra check` tells of such code of a module, and of a function behind it."""

    def told(above: str, inside: str) -> list[dict[str, Any]]:
        (folder / "a.launch.py").write_text(_ABOVE + above + _BELOW.format(inside.replace("\n", "\n    ")))
        result = orchestra_here(
            "check", "--no-cache", "--format", "json", "a.launch.py", AMENT_PREFIX_PATH=""
        )
        return list(json.loads(result.stdout[result.stdout.index("[") :]))

    return told


@pytest.mark.parametrize(
    ("above", "inside", "code"),
    [
        (_TRIED.format("", "print('no xacro')"), "found = qq_xacro.process_file('a.xacro')", "ORC036"),
        (_TRIED.format("", "qq_xacro = None"), "found = qq_xacro.process_file('a.xacro')", "ORC036"),
        (_TRIED.format("", "raise RuntimeError('get xacro') from error"), "found = 1", "ORC036"),
        (_TRIED.format("", "sys.exit(1)"), "found = 1", "ORC036"),
        (
            _TRIED.format("    HAS = True\n", "HAS = False"),
            "found = 1\nif not HAS:\n    raise RuntimeError('get xacro')",
            "ORC036",
        ),
        ("with contextlib.suppress(ImportError):\n    import qq_xacro\n", "found = qq_xacro", "ORC036"),
        ("", "found = 1\nif find_spec('qq_xacro') is None:\n    raise RuntimeError('get xacro')", "ORC036"),
        (
            "HAS = find_spec('qq_xacro') is not None\n",
            "found = 1\nif not HAS:\n    raise RuntimeError('get xacro')",
            "ORC036",
        ),
        (_LOADING, "found = load('qq_arm')['limits']", "ORC030"),
        (_LOADING, "found = {}\nfound.update(load('qq_arm'))", "ORC030"),
        (_FINDING, "found = find('qq_arm', 'qq_hand')", "ORC030"),
        (
            "",
            "try:\n    found = get_package_share_directory('qq_arm')\n"
            "except PackageNotFoundError:\n    found = None\nfound = os.path.join(found, 'a.yaml')",
            "ORC030",
        ),
        (
            "",
            "try:\n    folder = get_package_share_directory('qq_arm')\n    found = open(folder + '/a.urdf').read()\n"
            "except Exception:\n    print('no urdf')",
            "ORC030",
        ),
    ],
)
def test_what_was_caught_and_is_lacking_is_no_mistake(
    problems: Callable[..., list[dict[str, Any]]], above: str, inside: str, code: str
) -> None:
    told = problems(above, inside)
    assert [(problem["code"], problem["severity"]) for problem in told] == [(code, "note")]
    assert "'qq_" in told[0]["message"]
    further = "the code has caught that, and goes no further at a.launch.py:"
    assert [note for note in told[0]["notes"] if note.startswith(further)]


@pytest.mark.parametrize(
    ("above", "inside", "message"),
    [
        (_TRIED.format("", "pass"), "found = lookup(1)", "there is no name 'lookup' here"),
        (_TRIED.format("", "pass"), "raise RuntimeError('always')", "RuntimeError: always"),
        (_TRIED.format("", "pass"), "found = os.gone", "os has no 'gone'"),
        (
            "try:\n    import jsonn\nexcept ImportError:\n    jsonn = None\n",
            "found = jsonn.load('')",
            "None has no",
        ),
        ("found = None\n", "raise SystemExit(2)", "the code ends the program: SystemExit(2)"),
    ],
)
def test_what_is_wrong_anyway_stays_a_mistake(
    problems: Callable[..., list[dict[str, Any]]], above: str, inside: str, message: str
) -> None:
    (told,) = problems(above, inside)
    assert told["severity"] == "error"
    assert message in told["message"]
