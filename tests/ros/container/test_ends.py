"""How containers come to an end, and what components do to each other."""

from __future__ import annotations

import re
import signal
import time
from typing import TYPE_CHECKING

import pytest

from tests.ros.container.conftest import container
from tests.supervise.plans import PATIENCE, wait_for

if TYPE_CHECKING:
    from pathlib import Path

    from tests.ros.container.conftest import Asking

_TRIGGER = "std_srvs/srv/Trigger"


def test_a_signal_ends_it_cleanly(domain: dict[str, str], asking: Asking, tmp_path: Path) -> None:
    """Its own arguments have reached only the component that wants them."""
    words = ("-r", "chatter:=shared", "-p", "text:=everywhere")
    with container("component_container", domain, asking, tmp_path, *words) as box:
        box.loaded("Everything")
        box.loaded("Stubborn")
        box.loaded("Plain", node_name="own")
        given = {"forward_global_arguments": ("BOOL", True)}
        box.loaded("Plain", node_name="listening", extra_arguments=given)
        kind = "rcl_interfaces/srv/GetParameters"
        answers = [
            asking.call(f"/{name}/get_parameters", kind, names=["text"]) for name in ("own", "listening")
        ]
        assert [answer["values"] for answer in answers] == [[""], ["everywhere"]]
        seen = {"/chatter PUBLISHER own", "/shared PUBLISHER listening"}
        wait_for(lambda: seen <= {*asking.graph()}, "both topics")
        box.popen.send_signal(signal.SIGINT)
        assert box.popen.wait(PATIENCE) == 0
        asking.left_alone()
        assert "good-bye\n" in box.written
        assert "Traceback" not in box.written


@pytest.mark.parametrize("executable", ["component_container_mt", "component_container_isolated"])
def test_a_callback_that_waits_holds_up_no_other_component(
    executable: str, domain: dict[str, str], asking: Asking, tmp_path: Path
) -> None:
    """Not even one that is to go, which waits for the callback itself."""
    with container(executable, domain, asking, tmp_path) as box:
        box.loaded("Waiting")
        box.loaded("Meeting")
        asking.begin("/waiting/wait", _TRIGGER)
        wait_for(lambda: "waits" in box.written, "the callback")
        asking.meet("/meeting/meet", _TRIGGER)  # the order to go waits for a callback, but not without end
        unload = f"/{box.name}/_container/unload_node"
        begun = time.monotonic()
        asking.begin(unload, "composition_interfaces/srv/UnloadNode", unique_id=1)
        assert asking.call("/meeting/meet", _TRIGGER)["success"]
        assert asking.ended(unload)["success"]
        took = time.monotonic() - begun
        asking.drop("/waiting/wait")
        assert "met: True" in box.written
        if "at work" in box.written:  # a machine that stands still
            assert took > 5
        else:
            assert float(re.findall(r"stayed: (.*)", box.written)[0]) >= 0.1  # its answer is on the way
        assert box.list() == {2: "/meeting"}
        box.popen.send_signal(signal.SIGTERM)
        assert box.popen.wait(PATIENCE) == 0


@pytest.mark.parametrize(
    ("executable", "service", "status"),
    [
        ("component_container", "fail", 1),
        ("component_container_mt", "leave", 4),
        ("component_container_isolated", "fail", 1),
    ],
)
def test_a_callback_that_fails_ends_the_container_as_it_ends_a_process(
    executable: str, service: str, status: int, domain: dict[str, str], asking: Asking, tmp_path: Path
) -> None:
    with container(executable, domain, asking, tmp_path) as box:
        box.loaded("Stubborn")
        box.loaded("Failing", node_name="weak")
        asking.begin(f"/weak/{service}", _TRIGGER)
        assert box.popen.wait(PATIENCE) == status
        asking.drop(f"/weak/{service}")
        asking.left_alone()
        assert "good-bye" in box.written
        failed = (
            "[FATAL]" in box.written
            and "RuntimeError: out of order" in box.written
            and "[weak]" in box.written
        )
        assert failed == (service == "fail")


def test_an_executable_that_is_none_is_refused(
    domain: dict[str, str], asking: Asking, tmp_path: Path
) -> None:
    with container("component_contanier", domain, asking, tmp_path) as box:
        assert box.popen.wait(PATIENCE) == 2
        assert box.written.startswith(
            "there is no container 'component_contanier': there are component_container,"
        )
