"""The running node's parameters, over its parameter services."""

from __future__ import annotations

import signal
import threading
from typing import TYPE_CHECKING, Any

import pytest
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient

from bringup.world.settings import TABLE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from contextlib import AbstractContextManager

    Start = Callable[..., AbstractContextManager[Any]]
    Listen = Callable[[int], AbstractContextManager[Any]]
    Ask = Callable[..., Any]

DOMAIN = 28


@pytest.fixture(scope="module")
def client(start: Start, listen: Listen) -> Iterator[AsyncParameterClient]:
    """A client of a running node that was given `speed` as a whole number."""
    arguments = ("-r", "__ns:=/fleet", "-p", "speed:=2", "-p", "status_period:=1000.0")
    with listen(DOMAIN) as ears, start(DOMAIN, *arguments) as run:
        client = AsyncParameterClient(ears.node, "/fleet/simulation")
        assert client.wait_for_services(60.0)
        yield client
        run.process.send_signal(signal.SIGINT)
        status, _ = run.end()
        assert status == 0


def answer(ask: Callable[..., Any], *arguments: Any) -> Any:
    """The result of a call, which the listener's own thread brings.

    An answer that comes before the two sides know each other in both directions is lost: a client asks again.
    """
    done = threading.Event()
    for _ in range(12):
        future = ask(*arguments)
        future.add_done_callback(lambda _future: done.set())
        if done.wait(5.0):
            break
    assert future.done()
    return future.result()


def test_every_setting_is_described_with_its_range(client: AsyncParameterClient) -> None:
    described = answer(client.describe_parameters, [setting.name for setting in TABLE]).descriptors
    for setting, descriptor in zip(TABLE, described, strict=True):
        assert descriptor.description == setting.description
        assert descriptor.read_only is not setting.changeable
        if isinstance(setting.default, float):
            span = descriptor.floating_point_range[0]
            assert (span.from_value, span.to_value) == (setting.low, setting.high)


def test_a_whole_number_is_taken_for_a_real_one(client: AsyncParameterClient) -> None:
    value = answer(client.get_parameters, ["speed"]).values[0]
    assert (Parameter.Type(value.type), value.double_value) == (Parameter.Type.DOUBLE, 2.0)


@pytest.mark.parametrize(
    ("parameter", "refusal"),
    [
        (Parameter("speed", value=4.0), ""),
        (Parameter("speed", value=-1.0), "out of range"),
        (Parameter("status_period", value=0.0), "out of range"),
        (Parameter("world", value="maze"), "read-only"),
    ],
)
def test_what_can_be_changed_while_it_runs(
    client: AsyncParameterClient, parameter: Parameter, refusal: str
) -> None:
    result = answer(client.set_parameters, [parameter]).results[0]
    assert result.successful is not bool(refusal)
    assert refusal in result.reason
