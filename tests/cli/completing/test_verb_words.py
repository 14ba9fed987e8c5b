"""Words of commands that have verbs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.cli.completing.command_line import candidates

if TYPE_CHECKING:
    from pathlib import Path


def _words(*before: str, begun: str = "") -> list[str]:
    return [found.word for found in candidates(before, begun)]


def test_verbs_are_completed_with_what_they_do() -> None:
    assert _words("topic", begun="e") == ["echo"]
    (found,) = candidates(["param"], "du")
    assert (found.word, found.description) == ("dump", "write all parameters of a node as a parameter file")
    assert _words("topic", "--include-hidden-topics", begun="ec") == ["echo"]
    assert _words("topic", "ecko", begun="") == []


def test_options_of_a_verb_are_completed() -> None:
    assert _words("topic", "echo", "/a", begun="--qos-rel") == ["--qos-reliability"]
    assert _words("topic", "echo", "/a", "--qos-durability", begun="v") == ["volatile"]
    assert _words("topic", "echo", "/a", begun="--qos-profile=sen") == ["--qos-profile=sensor_data"]


def test_types_and_packages_are_completed(prefix: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    index = prefix / "share" / "ament_index" / "resource_index" / "rosidl_interfaces"
    index.mkdir()
    (index / "demo").write_text("msg/One.msg\nsrv/Two.srv\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    assert _words("topic", "pub", "/a", begun="demo/") == ["demo/msg/One"]
    assert _words("service", "call", "/a", begun="demo/") == ["demo/srv/Two"]
    assert _words("interface", "show", begun="demo/") == ["demo/msg/One", "demo/srv/Two"]
    assert _words("pkg", "prefix", begun="dem") == ["demo"]


def test_messages_are_completed_with_their_defaults() -> None:
    pytest.importorskip("std_msgs", reason="needs ROS")
    assert _words("topic", "pub", "/a", "std_msgs/msg/Header") == [
        "{stamp: {sec: 0, nanosec: 0}, frame_id: ''}"
    ]
    assert _words("service", "call", "/a", "std_srvs/srv/SetBool") == ["{data: false}"]
    assert _words("topic", "pub", "/a", "std_msgs/msg/Header", begun="{s") == []
    assert _words("topic", "pub", "/a", "std_msgs/msg/Heder") == []


def test_another_name_of_a_command_is_completed_as_its_own() -> None:
    assert _words("wtf", begun="--on") == ["--only"]


def test_files_are_completed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "values.yaml").write_text("")
    assert _words("param", "load", "/a", begun="val") == ["values.yaml"]
