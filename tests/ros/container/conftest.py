"""Containers in a domain of their own, and a client that asks them."""

from __future__ import annotations

import itertools
import json
import os
import signal
import subprocess
import sys
from contextlib import ExitStack, contextmanager, suppress
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.supervise.graph.discovery import quick_discovery
from orchestra.testing.domain import free_domain
from tests.killing import kill
from tests.supervise.plans import PATIENCE, PROCESSES, wait_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

_NUMBERS = itertools.count(1)
# What is different with a pool of threads is in `test_ends.py`.
EXECUTABLES = (
    "component_container",
    pytest.param("component_container_mt", marks=pytest.mark.long),
    "component_container_isolated",
)


class Asking:
    """The client of `tests/processes/components.py`. One that has died is followed by another."""

    def __init__(self, environment: dict[str, str]) -> None:
        self._environment = environment
        self._popen: subprocess.Popen[str] | None = None

    def call(self, service: str, kind: str, /, **fields: Any) -> dict[str, Any]:
        """Return the fields of a service's answer."""
        found: dict[str, Any] = self._asked({"call": service, "type": kind, "fields": fields})
        return found

    def meet(self, service: str, kind: str) -> None:
        """Make sure that a call of a service takes no longer than the service does."""
        self._asked({"meet": service, "type": kind})

    def begin(self, service: str, kind: str, /, **fields: Any) -> None:
        """Call a service and go on at once."""
        self._asked({"begin": service, "type": kind, "fields": fields})

    def ended(self, service: str) -> dict[str, Any]:
        """Return the fields of the answer to a call that has begun."""
        found: dict[str, Any] = self._asked({"end": service})
        return found

    def drop(self, service: str) -> None:
        """Wait no more for the answer to a call that has begun: who goes may take it along."""
        self._asked({"drop": service})

    def graph(self, *but: str) -> list[str]:
        """Return what is in the graph beside these nodes."""
        found: list[str] = self._asked({"graph": but})
        return found

    def left_alone(self) -> None:
        """Wait until nobody else is in the graph."""
        self._wait_without(lambda _: True, "an empty graph")

    def left_by(self, *names: str) -> None:
        """Wait until nothing of these nodes is in the graph."""
        self._wait_without(lambda one: any(name in one for name in names), f"the end of {names}")

    def _wait_without(self, is_one: Callable[[str], bool], what: str) -> None:
        """Wait until no entry of the graph is one of those.

        The client may go on for ever to believe in somebody who has left: what its middleware tells of nodes comes in
        one thread, and that a process has left in another (1 of 40 that ended while the client stood still). Then
        those who are there are asked themselves.
        """
        left: list[str] = []

        def is_over() -> bool:
            left[:] = filter(is_one, self.graph())
            return not left or not [*filter(is_one, self._nodes())]

        try:
            wait_for(is_over, what)
        except AssertionError:
            pytest.fail(f"still in the graph: {left}; those who are there: {self._nodes()}")

    def _nodes(self) -> list[str]:
        command = [sys.executable, "-m", "orchestra", "node", "list"]
        found = subprocess.run(command, env=self._environment, capture_output=True, text=True, check=True)
        return [name for name in found.stdout.split() if name != "/asking_client"]

    def close(self) -> None:
        """End the client."""
        if self._popen is None:
            return
        popen, self._popen = self._popen, None
        kill(popen)
        for pipe in (popen.stdin, popen.stdout):
            assert pipe
            with suppress(BrokenPipeError):
                pipe.close()

    def _asked(self, order: dict[str, Any]) -> Any:
        popen = self._client()
        assert popen.stdin
        with suppress(BrokenPipeError):  # it has died, as reading tells
            popen.stdin.write(json.dumps(order) + "\n")
            popen.stdin.flush()
        found = self._read(popen)
        if "failure" in found:
            pytest.fail(f"{order}: {found['failure']}")
        return found["answer"]

    def _client(self) -> subprocess.Popen[str]:
        if self._popen is not None and self._popen.poll() is not None:
            self.close()
        if self._popen is None:
            self._popen = subprocess.Popen(
                [sys.executable, str(PROCESSES / "components.py")],
                env=self._environment,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                text=True,
            )
            assert self._read(self._popen) == "ready"
        return self._popen

    def _read(self, popen: subprocess.Popen[str]) -> Any:
        assert popen.stdout
        line = popen.stdout.readline()
        if not line:
            self.close()
            pytest.fail("the client has died; the next test has another one")
        return json.loads(line)


class Box:
    """A container that runs, and what it has written."""

    def __init__(self, popen: subprocess.Popen[bytes], name: str, asking: Asking, path: Path) -> None:
        self.popen = popen
        self.name = name
        self.asking = asking
        self._path = path

    @property
    def written(self) -> str:
        """All that it has written."""
        return self._path.read_text("utf-8")

    def load(self, plugin: str, **fields: Any) -> dict[str, Any]:
        """Ask it to load a component of `tests/processes/components.py`."""
        whole = plugin if ":" in plugin else f"components:{plugin}"
        return self._asked("LoadNode", "load_node", plugin_name=whole, **fields)

    def loaded(self, plugin: str, **fields: Any) -> str:
        """Return the full name of a component that it loads."""
        answer = self.load(plugin, **fields)
        assert answer["success"], answer
        return str(answer["full_node_name"])

    def unload(self, number: int) -> dict[str, Any]:
        return self._asked("UnloadNode", "unload_node", unique_id=number)

    def list(self) -> dict[int, str]:
        answer = self._asked("ListNodes", "list_nodes")
        return dict(zip(answer["unique_ids"], answer["full_node_names"], strict=True))

    def empty(self) -> None:
        """Unload whatever is there, and wait until nothing of it is seen."""
        for number in self.list():
            assert self.unload(number) == {"success": True, "error_message": ""}
        wait_for(lambda: not self.asking.graph(self.name), "an empty graph")

    def _asked(self, kind: str, service: str, **fields: Any) -> dict[str, Any]:
        of_type = f"composition_interfaces/srv/{kind}"
        return self.asking.call(f"/{self.name}/_container/{service}", of_type, **fields)


@pytest.fixture(scope="package")
def domain(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """An environment with a domain in which nobody else is, and the components on the path."""
    pytest.importorskip("rclpy", reason="needs ROS")
    declared = tmp_path_factory.mktemp("declared")
    points = declared / "parts-1.0.dist-info" / "entry_points.txt"
    points.parent.mkdir()
    points.write_text("[rclpy_components]\nparts::Plain = components:Plain\n", "utf-8")
    with free_domain({}) as number:
        yield {
            **os.environ,
            **quick_discovery(os.environ, tmp_path_factory.mktemp("profiles")),
            "ROS_DOMAIN_ID": str(number),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "PYTHONPATH": os.pathsep.join([str(PROCESSES), str(declared), os.environ.get("PYTHONPATH", "")]),
            "NO_COLOR": "1",
        }


@pytest.fixture(scope="package")
def asking(domain: dict[str, str]) -> Iterator[Asking]:
    found = Asking(domain)
    yield found
    found.close()


@contextmanager
def container(
    executable: str, domain: dict[str, str], asking: Asking, folder: Path, *words: str
) -> Iterator[Box]:
    """Have a container, which has a name that none had before."""
    name = f"box{next(_NUMBERS)}"
    command = [sys.executable, "-m", "orchestra.ros.container", executable]
    path = folder / executable
    with (
        path.open("wb") as output,
        subprocess.Popen(
            [*command, "--ros-args", "-r", f"__node:={name}", *words],
            env=domain,
            stdout=output,
            stderr=output,
        ) as popen,
    ):
        try:
            yield Box(popen, name, asking, path)
            popen.send_signal(signal.SIGINT)  # one that is killed stays in the graphs of others for 20 s
            popen.wait(PATIENCE)
        finally:
            kill(popen)


class Boxes:
    """A container for the tests of a module. One that has ended is followed by another."""

    def __init__(self, executable: str, domain: dict[str, str], asking: Asking, folder: Path) -> None:
        self._wanted = (executable, domain, asking, folder)
        self._held = ExitStack()
        self._box: Box | None = None

    def one_that_runs(self) -> Box:
        if self._box is None or self._box.popen.poll() is not None:
            self.close()
            self._box = self._held.enter_context(container(*self._wanted))
        return self._box

    def close(self) -> None:
        self._box = None
        self._held.close()


@pytest.fixture(scope="module", params=EXECUTABLES)
def boxes(
    request: pytest.FixtureRequest,
    domain: dict[str, str],
    asking: Asking,
    tmp_path_factory: pytest.TempPathFactory,
) -> Iterator[Boxes]:
    """Each of the executables."""
    found = Boxes(request.param, domain, asking, tmp_path_factory.mktemp("box"))
    yield found
    found.close()


@pytest.fixture
def box(boxes: Boxes) -> Box:
    """A container of each of the executables."""
    return boxes.one_that_runs()
