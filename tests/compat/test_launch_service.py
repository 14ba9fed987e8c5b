from __future__ import annotations

import asyncio
import threading
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch.actions import (
    OpaqueFunction,
    RegisterEventHandler,
    SetLaunchConfiguration,
)
from orchestra.compat.launch.event import Event
from orchestra.compat.launch.event_handler import EventHandler
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.compat.launch.launch_service import LaunchService
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({"PATH": "/usr/bin:/bin"}):
        yield


def _service(*entities: Any) -> LaunchService:
    service = LaunchService(argv=["a"], noninteractive=True, debug=True)
    service.include_launch_description(LaunchDescription(entities))
    return service


@pytest.mark.conforms(
    "1.2 LaunchService constructor",
    "1.2 LaunchService.include_launch_description",
    "1.2 LaunchService.run",
    "1.2 LaunchService.context",
    "D51",
)
def test_descriptions_are_visited_in_a_state_of_their_own() -> None:
    service = _service(SetLaunchConfiguration("a", "1"))
    assert "a" not in service.context.launch_configurations
    assert service.run() == 0
    assert service.context.launch_configurations["a"] == "1"
    assert (service.context.argv, service.event_loop, service.task) == (["a"], None, None)
    assert "a" not in LaunchService().context.launch_configurations


@pytest.mark.conforms("1.2 LaunchService.emit_event")
def test_events_are_handled_in_order_after_what_was_included() -> None:
    class Custom(Event):
        name = "custom"

    seen: list[Event] = []
    note = OpaqueFunction(function=lambda context: seen.append(context.locals.event))
    handler = EventHandler(matcher=lambda event: isinstance(event, Custom), entities=note)
    service = _service(RegisterEventHandler(handler))
    first, second = Custom(), Custom()
    service.emit_event(first)
    service.emit_event(second)
    assert service.run() == 0
    assert seen == [first, second]


def _fail(_: Any) -> None:
    raise RuntimeError("broken")


@pytest.mark.conforms("1.2 LaunchService return value")
def test_an_exception_ends_the_run_with_1() -> None:
    assert _service(OpaqueFunction(function=_fail)).run() == 1


@pytest.mark.conforms("1.2 LaunchService.run", "1.2 LaunchService.run_async")
def test_run_is_for_the_main_thread_and_run_async_is_not() -> None:
    errors: list[Exception] = []
    results: list[int] = []

    def elsewhere() -> None:
        try:
            _service().run()
        except RuntimeError as error:
            errors.append(error)
        results.append(asyncio.run(_service().run_async()))

    thread = threading.Thread(target=elsewhere)
    thread.start()
    thread.join(30)
    assert len(errors) == 1
    assert results == [0]


@pytest.mark.conforms("1.2 LaunchService second run")
def test_a_service_does_not_run_twice_at_once() -> None:
    found: list[Exception] = []

    def again(_: Any) -> None:
        try:
            service.run()
        except RuntimeError as error:
            found.append(error)

    service = _service(OpaqueFunction(function=again))
    assert service.run() == 0
    assert len(found) == 1


@pytest.mark.conforms("1.2 LaunchService.shutdown")
def test_shutdown_ends_the_run_from_inside() -> None:
    service = _service()

    def end(_: Any) -> None:
        service.shutdown()

    service.include_launch_description(LaunchDescription([OpaqueFunction(function=end)]))
    service.shutdown()
    assert not service.context.is_shutdown
    assert service.run(shutdown_when_idle=False) == 0
    assert service.context.is_shutdown
