"""Packages of definitions are built into a cache: whole or not at all, once, and again when something has changed."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from orchestra.resolve.interfaces import prefixes, sources
from orchestra.resolve.interfaces.available import available
from orchestra.ros.interfaces.building import build as building
from orchestra.ros.interfaces.building.build import Builder, MistakesError
from tests.ros.interfaces import own
from tests.ros.interfaces.test_talking import conversation, right

_COMPILES = prefixes.has_compiler(os.environ)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return own.write(tmp_path / "ws" / "src" / "own_interfaces")


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    return {**os.environ, "ORCHESTRA_CACHE": str(tmp_path / "cache")}


def _orchestra(*words: str, cwd: Path, environment: dict[str, str]) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-W", "ignore", "-m", "orchestra", *words],
        cwd=cwd,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=400,
    )


def _plain(folder: Path, environment: dict[str, str]) -> building.Built:
    cache = prefixes.this_cache(environment, compiles=False)
    source = sources.in_folder(folder)
    assert cache is not None
    assert source is not None
    return Builder({source.name: source}, cache, environment).build(source)


def test_without_a_compiler_it_is_laid_out_at_once(folder: Path, environment: dict[str, str]) -> None:
    words = ("interface", "build", "--without-compiler", "--format", "json")
    done = _orchestra(*words, cwd=folder, environment=environment)
    assert (done.returncode, done.stderr) == (0, "")
    (told,) = json.loads(done.stdout)
    assert (told["package"], told["definitions"], told["compiled"]) == ("own_interfaces", 5, False)
    python = str(prefixes.python_folder(Path(told["prefix"])))
    right(conversation(None, None, server_path=python, client_path=python))
    again = _orchestra(*words, cwd=folder, environment=environment)
    assert json.loads(again.stdout) == [{**told, "seconds": None}]


def test_the_tools_find_what_was_built_from_anywhere(
    folder: Path, environment: dict[str, str], tmp_path: Path
) -> None:
    _plain(folder, environment)
    shown = _orchestra(
        "interface", "show", "own_interfaces/srv/Ask", cwd=tmp_path / "cache", environment=environment
    )
    assert shown.stdout.splitlines()[:3] == [
        "Whole whole",
        "\tstd_msgs/Header header",
        "\t\tbuiltin_interfaces/Time stamp",
    ]
    (folder / "msg" / "New.msg").write_text("int8 a 7\n")
    proto = _orchestra(
        "interface", "proto", "own_interfaces/msg/New", cwd=tmp_path / "cache", environment=environment
    )
    assert proto.stdout == '"a: 7\n"\n', proto.stderr


def test_another_definition_is_another_prefix(folder: Path, environment: dict[str, str]) -> None:
    first = _plain(folder, environment)
    assert _plain(folder, environment) == first._replace(seconds=None)
    (folder / "msg" / "Part.msg").write_text("int8 a\n")
    second = _plain(folder, environment)
    assert second.prefix != first.prefix
    assert prefixes.latest(first.prefix.parent) == {"own_interfaces": second.prefix}


def test_what_it_needs_is_part_of_the_name(folder: Path, environment: dict[str, str]) -> None:
    user = own.write(folder.parent / "user_interfaces")
    (user / "package.xml").write_text("<package><name>user_interfaces</name></package>")
    (user / "msg" / "Part.msg").write_text("own_interfaces/Part part\n")

    def prefix() -> Path:
        known = available(folder, environment)
        cache = prefixes.this_cache(environment, compiles=False)
        assert cache is not None
        built = Builder(known, cache, environment)
        built.build(known["user_interfaces"])
        assert [each.source.name for each in built.built] == ["own_interfaces", "user_interfaces"]
        return built.built[-1].prefix

    first = prefix()
    (folder / "msg" / "Part.msg").write_text("int8 a\n")
    assert prefix() != first


def test_half_of_a_build_is_never_used(
    folder: Path, environment: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def killed(*_: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(prefixes, "RECORD", "no/such/folder.json")
        with pytest.raises(OSError, match="no/such"):
            _plain(folder, environment)
    with monkeypatch.context() as patched:
        patched.setattr(building.os, "replace", killed)  # type: ignore[attr-defined]  # of the module under test
        with pytest.raises(KeyboardInterrupt):
            _plain(folder, environment)
    cache = Path(environment["ORCHESTRA_CACHE"], "interfaces")
    assert [path.name for path in cache.iterdir() if not path.name.startswith(".")] == []
    assert _plain(folder, environment).seconds is not None


def test_many_that_build_at_once_get_one_whole_prefix(folder: Path, environment: dict[str, str]) -> None:
    words = [
        sys.executable,
        "-W",
        "ignore",
        "-m",
        "orchestra",
        "interface",
        "build",
        "--without-compiler",
        "--format",
        "json",
    ]
    started = [
        subprocess.Popen(words, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True)
        for _ in range(4)
    ]
    told = [json.loads(process.communicate(timeout=120)[0]) for process in started]
    assert len({each[0]["prefix"] for each in told}) == 1
    assert sum(each[0]["seconds"] is not None for each in told) == 1


@pytest.mark.parametrize(
    ("file", "text", "told"),
    [
        ("msg/Part.msg", "flaot64 a\n", ("msg/Part.msg", 1, 1, "'flaot64' is not a type")),
        (
            "msg/Part.msg",
            "int8 a\nPrat b\n",
            ("msg/Part.msg", 2, 1, "has no message 'Prat'; did you mean 'Part'"),
        ),
        ("msg/Part.msg", "std_msgs/Heade a\n", ("msg/Part.msg", 1, 1, "did you mean 'Header'")),
        ("msg/Part.msg", "no_msgs/A a\n", ("msg/Part.msg", 1, 1, "there is no package 'no_msgs'")),
        (
            "msg/Part.msg",
            "Whole a\n",
            ("msg/Part.msg", 1, 1, "cannot hold itself: Part holds Whole holds Part"),
        ),
        ("srv/Ask.srv", "Part a\nint8 a\n---\n", ("srv/Ask.srv", 2, 6, "there is a field 'a' already")),
    ],
)
def test_a_wrong_definition_is_one_problem_at_its_place(
    folder: Path, environment: dict[str, str], file: str, text: str, told: tuple[str, int, int, str]
) -> None:
    (folder / file).write_text(text)
    done = _orchestra(
        "interface", "build", "--only-check", "--format", "json", cwd=folder, environment=environment
    )
    assert (done.returncode, done.stdout) == (2, "")
    (problem,) = json.loads(done.stderr)
    assert (problem["code"], problem["file"], problem["line"], problem["column"]) == ("ORC150", *told[:3])
    assert told[3] in problem["message"]


def test_all_mistakes_are_told_at_once(folder: Path, environment: dict[str, str]) -> None:
    (folder / "msg" / "Part.msg").write_text("flaot64 a\n")
    (folder / "srv" / "Ask.srv").write_text("int8 a\n")
    with pytest.raises(MistakesError) as caught:
        _plain(folder, environment)
    assert len(caught.value.found) == 2


def test_sources_are_found_as_colcon_finds_packages(folder: Path, tmp_path: Path) -> None:
    deep = own.write(folder.parent / "group" / "more" / "deep_interfaces")
    (deep / "package.xml").write_text("<package><name>deep_interfaces</name></package>")
    hidden = own.write(folder.parent / "ignored" / "other")
    (hidden.parent / "COLCON_IGNORE").touch()
    own.write(folder / "inside")
    listed = own.write(tmp_path / "listed" / "x")
    (listed / "package.xml").write_text(
        "<package><!-- <name>no</name> --><name>listed_interfaces</name></package>"
    )
    path = {"ORCHESTRA_INTERFACE_PATH": str(tmp_path / "listed")}
    for start in (folder, folder / "msg", tmp_path / "ws", folder.parent):
        found = sources.found_in(sources.places(start, path))
        assert sorted(found) == ["deep_interfaces", "listed_interfaces", "own_interfaces"]
        assert found["own_interfaces"].folder == folder


@pytest.mark.long
@pytest.mark.timeout(900)
@pytest.mark.skipif(not _COMPILES, reason="there is no compiler")
def test_what_is_compiled_and_what_is_not_talk_to_each_other(
    folder: Path, environment: dict[str, str], tmp_path: Path
) -> None:
    user = own.write(folder.parent / "user_interfaces")
    (user / "package.xml").write_text("<package><name>user_interfaces</name></package>")
    (user / "msg" / "Part.msg").write_text("own_interfaces/Part part\ntf2_msgs/TF2Error error\n")
    for name in ("msg/Whole.msg", "msg/Nothing.msg", "srv/Ask.srv", "action/Go.action"):
        (user / name).unlink()
    done = _orchestra(
        "interface", "build", ".", "--format", "json", cwd=folder.parent, environment=environment
    )
    assert done.returncode == 0, done.stderr
    told = {each["package"]: each for each in json.loads(done.stdout)}
    assert sorted(told) == ["own_interfaces", "tf2_msgs", "user_interfaces"]
    assert all(each["compiled"] for each in told.values())
    path = os.pathsep.join(str(prefixes.python_folder(Path(each["prefix"]))) for each in told.values())
    given = tmp_path / "messages"
    for writes, reads in ((("", path), (str(folder), "")), ((str(folder), ""), ("", path))):
        done_writing = _exchange("write", given, *writes)
        assert _exchange("read", given, *reads) == done_writing
    right(conversation(folder, None, client_path=path))
    right(conversation(None, folder, server_path=path))


_EXCHANGE = """
import random, sys
from pathlib import Path
from orchestra.ros.interfaces.definitions import install
action, given, folder = sys.argv[1:]
if folder:
    install("own_interfaces", folder)
from own_interfaces.action import Go
from own_interfaces.msg import Nothing, Part, Whole
from own_interfaces.srv import Ask
from rclpy.serialization import deserialize_message, serialize_message
from tests.ros.interfaces.wheels import filled
from tests.ros.interfaces.test_wheel_types import _told
kinds = [Nothing, Part, Whole, Ask.Request, Ask.Response, Go.Goal, Go.Result, Go.Feedback]
kinds += [Go.Impl.FeedbackMessage, Go.Impl.SendGoalService.Request, Go.Impl.GetResultService.Response]
chance = random.Random(3)
for number, kind in enumerate(kinds * 5):
    path = Path(f"{given}.{number}")
    message = filled(kind, chance)
    if action == "write":
        path.write_bytes(serialize_message(message))
    else:
        assert deserialize_message(path.read_bytes(), kind) == message, (message, path.read_bytes())
    print(repr(message))
for kind in kinds:
    print(_told(kind, "msg"))
print(_told(Ask, "srv"))
"""


def _exchange(action: str, given: Path, folder: str, path: str) -> str:
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", _EXCHANGE, action, str(given), folder],
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join(filter(None, [path, str(Path(__file__).parents[3])])),
        },
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout
