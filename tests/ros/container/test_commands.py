"""`orchestra component`, beside containers that run."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.cli.main import main
from tests.killing import kill
from tests.ros.container.conftest import Boxes
from tests.supervise.plans import PATIENCE

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tests.ros.container.conftest import Asking, Box


# Of a busy machine; what is whole, or answers, is waited for no longer.
_PATIENT = ("--timeout", "60", "--spin-time", "60")


@pytest.fixture(scope="module")
def boxes(
    domain: dict[str, str], asking: Asking, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Boxes]:
    found = Boxes("component_container", domain, asking, tmp_path_factory.mktemp("box"))
    found.one_that_runs().list()  # it is there
    yield found
    found.close()


def _ask(domain: dict[str, str], *words: str) -> tuple[int, str, str]:
    done = subprocess.run(
        [sys.executable, "-m", "orchestra", "component", *words, *_PATIENT],
        env=domain,
        capture_output=True,
        text=True,
        check=False,
        timeout=100,
    )
    return done.returncode, done.stdout, done.stderr


def test_a_component_comes_and_goes_by_commands(box: Box, domain: dict[str, str], asking: Asking) -> None:
    full = f"/{box.name}"
    given = (
        "-n",
        "one",
        "--node-namespace",
        "/deep",
        "-r",
        "chatter:=/loud",
        "-p",
        "reals:=[1.5, 2]",
        "-p",
        "text:=!!str 1",
    )
    extra = ("-e", "use_intra_process_comms:=true", "--log-level", "DEBUG")
    status, told, errors = _ask(domain, "load", full, "demo", "components:Plain", *given, *extra)
    assert (status, errors) == (0, "")
    assert told == f"Loaded component 1 into '{full}' container node as '/deep/one'\n"
    names = ["reals", "text"]
    answer = asking.call("/deep/one/get_parameters", "rcl_interfaces/srv/GetParameters", names=names)
    assert answer["values"] == [[1.5, 2.0], "1"]
    assert box.loaded("Plain") == "/plain"
    assert _ask(domain, "list")[1] == f"{full}\n  1  /deep/one\n  2  /plain\n"
    status, told, errors = _ask(domain, "unload", full, "1", "7", "2")
    assert (status, told) == (1, f"Unloaded component 1 from '{full}' container node\n")
    assert errors == (
        f"error: Failed to unload component 7 from '{full}' container node: No node found with unique_id: 7\n"
    )
    assert box.list() == {2: "/plain"}
    status, told, _ = _ask(domain, "load", full, "", "components:Plain", "-n", "last", "--format", "json")
    assert (status, json.loads(told)) == (0, {"container": full, "uid": 3, "name": "/last"})


def test_what_a_container_refuses_is_an_error(box: Box, domain: dict[str, str]) -> None:
    status, told, errors = _ask(domain, "load", box.name, "demo", "components:Broken")
    reason = "Component constructor threw an exception: ValueError: no such device"
    assert (status, told, errors) == (1, "", f"error: Failed to load component: {reason}\n")
    status, _, errors = _ask(domain, "load", f"/{box.name}", "demo", "components:Plain", "-p", "rate=1")
    assert (status, errors.splitlines()[0]) == (2, "error: 'rate=1' is not NAME:=VALUE")


def test_a_component_runs_in_a_container_of_its_own(domain: dict[str, str], asking: Asking) -> None:
    words = ("standalone", "demo", "components:Stubborn", "-c", "sole")
    command = [sys.executable, "-m", "orchestra", "component", *words, *_PATIENT]
    with subprocess.Popen(command, env=domain, stdout=subprocess.PIPE, text=True) as popen:
        try:
            assert popen.stdout is not None
            assert (
                popen.stdout.readline() == "Loaded component 1 into '/sole' container node as '/stubborn'\n"
            )
            popen.send_signal(signal.SIGINT)
            assert popen.stdout.read() == "good-bye\n"
            assert popen.wait(PATIENCE) == 130
        finally:
            kill(popen)
    asking.left_by("sole", "stubborn")


def test_the_components_that_packages_register_are_listed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    metadata = tmp_path / "demo_parts-1.0.dist-info" / "entry_points.txt"
    metadata.parent.mkdir()
    metadata.write_text(
        "[rclpy_components]\ndemo::Talker = demo.talker:Talker\nLone = demo.lone:Lone\n", "utf-8"
    )
    index = tmp_path / "share" / "ament_index" / "resource_index"
    for path, text in (
        ("packages/composition", ""),
        (
            "rclcpp_components/composition",
            "composition::Talker;lib/libtalker.so\ncomposition::Server;lib/libserver.so\n",
        ),
    ):
        (index / path).parent.mkdir(parents=True, exist_ok=True)
        (index / path).write_text(text, "utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setenv("AMENT_PREFIX_PATH", os.fspath(tmp_path))
    assert main(["component", "types"]) == 0
    shown = capsys.readouterr().out
    assert (
        shown == "composition\n  composition::Talker\n  composition::Server\ndemo\n  demo::Talker\n  Lone\n"
    )
    assert main(["component", "types", "composition"]) == 0
    assert capsys.readouterr().out == "composition::Talker\ncomposition::Server\n"
    assert main(["component", "types", "compositon"]) == 1
    assert (
        capsys.readouterr().err == "error: no package compositon has components; did you mean composition?\n"
    )
