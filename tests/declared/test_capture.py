"""`orchestra schema capture` asks real nodes."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import jsonschema
import pytest
import yaml

from orchestra.declared.documents import Document
from orchestra.declared.generated import read_definition
from orchestra.declared.interfaces.model import Qos
from orchestra.declared.interfaces.own_form import read_interface
from orchestra.declared.kinds import is_definition
from orchestra.declared.plain_schema import read_plain
from orchestra.errors import Problems

if TYPE_CHECKING:
    from collections.abc import Iterator

pytest.importorskip("rclpy", reason="needs ROS")

_NODE = Path(__file__).parents[1] / "processes" / "declaring_node.py"
_REACH = {"ROS_DOMAIN_ID": "55", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "NO_COLOR": "1"}
_NAME = "/robot1/declaring"


def _command(*words: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "orchestra", "schema", *words],
        env={**os.environ, **_REACH, **environment},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )


@contextmanager
def _running(*words: str, announced: str = "") -> Iterator[None]:
    """Run a node, which says a line when it is ready where one is `announced`."""
    command = [sys.executable, *words]
    output = subprocess.PIPE if announced else subprocess.DEVNULL
    with subprocess.Popen(
        command, env={**os.environ, **_REACH}, stdout=output, stderr=subprocess.DEVNULL, text=True
    ) as process:
        try:
            if process.stdout is not None:
                assert process.stdout.readline() == announced
            yield
        finally:
            process.kill()


@pytest.fixture(scope="module")
def node() -> Iterator[str]:
    with _running(str(_NODE), _NAME, announced="ready\n"):
        yield _NAME


@pytest.fixture(scope="module")
def captured(node: str, tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Any], Any]:
    """The schema of the node, and its interfaces."""
    folder = tmp_path_factory.mktemp("captured")
    done = _command(
        "capture",
        node,
        "--output",
        str(folder / "s.json"),
        "--interfaces",
        str(folder / "i.yaml"),
        "--timeout",
        "60",
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    interfaces = yaml.safe_load((folder / "i.yaml").read_text("utf-8"))
    return json.loads((folder / "s.json").read_text("utf-8")), interfaces


def test_every_type_has_its_schema(captured: tuple[dict[str, Any], Any]) -> None:
    schema, _ = captured
    jsonschema.Draft202012Validator.check_schema(schema)
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert schema["additionalProperties"] is False
    properties = schema["properties"]
    assert properties["flag"] == {
        "type": "boolean",
        "x-ros-type": "bool",
        "description": "A boolean",
        "default": True,
    }
    assert properties["speed"] == {
        "type": "number",
        "x-ros-type": "double",
        "minimum": 0.0,
        "maximum": 5.0,
        "default": 1.5,
    }
    assert properties["level"]["x-ros-step"] == 0.25
    assert properties["count"] == {
        "type": "integer",
        "x-ros-type": "integer",
        "minimum": 1,
        "maximum": 9,
        "x-ros-step": 2,
        "default": 3,
    }
    assert properties["rest"]["multipleOf"] == 4
    assert properties["name"] == {
        "type": "string",
        "x-ros-type": "string",
        "readOnly": True,
        "x-ros-additional-constraints": "one letter",
        "default": "x",
    }
    assert properties["data"]["x-ros-type"] == "byte_array"
    assert properties["data"]["default"] == [1, 255]
    assert properties["counts"] == {
        "type": "array",
        "items": {"type": "integer"},
        "x-ros-type": "integer_array",
        "default": [1, 2],
    }
    assert [properties[name]["x-ros-type"] for name in ("flags", "speeds", "names")] == [
        "bool_array",
        "double_array",
        "string_array",
    ]
    assert properties["limits"]["properties"]["max"] == {
        "type": "number",
        "x-ros-type": "double",
        "default": 2.0,
    }
    assert properties["any"] == {}
    assert properties["later"]["x-ros-type"] == "double_array"
    assert "default" not in properties["later"]
    assert "default" not in properties["endless"]
    assert "use_sim_time" not in properties


def test_a_captured_schema_takes_what_the_node_has(captured: tuple[dict[str, Any], Any]) -> None:
    schema, _ = captured
    assert (
        read_plain(
            {
                **schema,
                "properties": {key: value for key, value in schema["properties"].items() if key != "rest"},
            }
        )
        is not None
    )


def test_interfaces_are_named_as_the_node_names_them(captured: tuple[dict[str, Any], Any]) -> None:
    _, interfaces = captured
    problems = Problems()
    read = read_interface(Document("i.yaml", "", interfaces), problems)
    assert list(problems) == []
    assert read is not None
    endless = float("inf")
    found = {(item.kind, item.name, item.type): item.qos for item in read.endpoints}
    assert found == {
        ("publishers", "chatter", "std_msgs/msg/String"): Qos(
            "reliable", "transient_local", "automatic", endless, endless
        ),
        ("publishers", "/everywhere", "std_msgs/msg/Int32"): Qos(
            "reliable", "volatile", "automatic", endless, endless
        ),
        ("subscriptions", "~/numbers", "std_msgs/msg/Int32"): Qos(
            "best_effort", "volatile", "manual_by_topic", 0.5, 2.0
        ),
        ("service_servers", "~/go", "std_srvs/srv/Trigger"): Qos(),
        ("service_clients", "switch", "std_srvs/srv/SetBool"): Qos(),
    }


def test_a_definition_of_the_node_is_one(node: str) -> None:
    done = _command("capture", node, "--format", "gpl", "--timeout", "60")
    assert (done.returncode, done.stderr) == (0, "")
    document = yaml.safe_load(done.stdout)
    assert is_definition(document)
    problems = Problems()
    read = read_definition(Document("d.yaml", done.stdout, document), problems)
    assert list(problems) == []
    assert read is not None
    assert list(read.faults({"speed": 2.0, "limits.max": 1.0, "data.x": 1, "later": (1.0,)})) == []
    assert [fault.kind for fault in read.faults({"speed": 9.0, "later": (1.0,)})] == ["value"]


def test_a_node_that_is_not_there(node: str) -> None:
    done = _command("capture", "/robot1/declarign", "--timeout", "6")
    assert done.returncode == 1
    assert "there is no node /robot1/declarign" in done.stderr
    assert f"did you mean {node}?" in done.stderr


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["capture"], "the full name of a node is missing"),
        (["capture", "/a//b"], "is no full name of a node"),
        (["capture", "/a", "--timeout", "-1"], "a number of seconds"),
        (["plan", "--output", "x"], "goes with capture"),
        (["plan", "/a"], "goes with capture"),
    ],
)
def test_what_makes_no_sense(words: list[str], told: str) -> None:
    done = _command(*words)
    assert done.returncode == 2
    assert told in done.stderr


def test_a_node_of_a_run_is_reached_as_those_of_the_run(tmp_path: Path) -> None:
    """It is in another domain than the command."""
    launch = tmp_path / "a.launch.yaml"
    launch.write_text(
        f"launch: [{{executable: {{cmd: [{sys.executable}, {_NODE}, /robot2/declaring]}}}}]", "utf-8"
    )
    home = {**os.environ, **_REACH, "ORCHESTRA_HOME": str(tmp_path / "home")}
    orchestra = [sys.executable, "-m", "orchestra"]
    started = subprocess.run(
        [*orchestra, "launch", str(launch), "--detach", "--name", "captured"],
        env={**home, "ROS_DOMAIN_ID": "56"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    assert started.returncode == 0, started.stderr
    try:
        done = _command(
            "capture",
            "/robot2/declaring",
            "--timeout",
            "60",
            "--run",
            "captured",
            ORCHESTRA_HOME=str(tmp_path / "home"),
        )
    finally:
        subprocess.run([*orchestra, "down", "--run", "captured"], env=home, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["properties"]["speed"]["default"] == 1.5


_BRINGUP = Path(__file__).parents[2] / "bringup" / "params"
# What the schema says beyond the descriptors: constraints of words, sizes of lists, and defaults that follow from others.
# Declared where there is a value for them, or where control is used.
_WHERE_WANTED = {
    *("control_config", "initial_state", "control_timeout", "stamped_control"),
    *("acceleration_limits", "acceleration_gains", "deceleration_limits", "deceleration_gains"),
}
_BEYOND = {"enum", "minItems", "maxItems", "exclusiveMinimum", "x-ros-type", "description", "default"}


@pytest.mark.parametrize("name", ["simulation", "ekf", "velocity_controller"])
def test_the_schemas_of_the_bringup_are_those_of_its_nodes(name: str) -> None:
    with _running("-m", f"bringup.nodes.{name}", "--ros-args", "-r", f"__node:={name}_of_test"):
        done = _command("capture", f"/{name}_of_test", "--timeout", "60")
    assert (done.returncode, done.stderr) == (0, "")
    real = json.loads(done.stdout)["properties"]
    written = json.loads((_BRINGUP / f"{name}.schema.json").read_text("utf-8"))
    assert written["additionalProperties"] is False
    assert set(real) <= set(written["properties"])
    assert set(written["properties"]) - set(real) <= _WHERE_WANTED
    for key, found in real.items():
        said = written["properties"][key]
        types = said["x-ros-type"]
        assert found["x-ros-type"] in (types if isinstance(types, list) else [types]), key
        kinds = said.get("type")
        if isinstance(kinds, list):  # it takes several types, and has one of them at a time
            assert found["type"] in kinds, key
            said = {**said, "type": found["type"]}
        assert {word: value for word, value in said.items() if word not in _BEYOND} == {
            word: value for word, value in found.items() if word not in _BEYOND
        }, key
        assert found.get("description") in (None, said.get("description")), key
        assert said.get("default", found.get("default")) == found.get("default"), key
