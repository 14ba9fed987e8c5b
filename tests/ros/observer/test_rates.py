"""Rates of messages, with real publishers."""

from __future__ import annotations

import contextlib
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from tests.ros.observer.conversation import Domain, observing
from tests.supervise.plans import PROCESSES, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.ros.observer.conversation import Conversation

WINDOW = 0.5


@pytest.fixture(scope="module")
def domain(tmp_path_factory: pytest.TempPathFactory) -> Domain:
    return Domain(34, tmp_path_factory.mktemp("discovery"))


@pytest.fixture(scope="module")
def observer(domain: Domain) -> Iterator[Conversation]:
    with observing(domain) as conversation:
        yield conversation


@contextlib.contextmanager
def publishing(domain: Domain, *words: str) -> Iterator[None]:
    """Publish ten times a second."""
    command = [sys.executable, str(PROCESSES / "publisher.py"), *words]
    with subprocess.Popen(command, env=domain.environment, stdout=subprocess.DEVNULL) as popen:
        yield
        popen.terminate()


def await_rate(observer: Conversation, name: str, least: float, most: float) -> None:
    """Wait until a rate is told, from now on, that lies between the two."""
    before = len(observer.heard(name))

    def found() -> bool:
        return any(least <= message["rate"] <= most for message in observer.heard(name)[before:])

    wait_for(found, f"a rate of {least} to {most}; {observer.heard(name)[-5:]}")


def test_the_rate_follows_the_publishers_as_they_come_and_go(observer: Conversation, domain: Domain) -> None:
    """Of one kind, then of both kinds of reliability together; what is latched is no sign of life."""
    observer.ask("rate", "rate", topic="/chat", window=WINDOW)
    await_rate(observer, "rate", 0, 0)
    with publishing(domain, "/chat,RELIABLE,TRANSIENT_LOCAL,0"):
        await_rate(observer, "rate", 7, 13)
        with publishing(domain, "/chat,BEST_EFFORT,VOLATILE,0"):
            await_rate(observer, "rate", 17, 23)
        await_rate(observer, "rate", 7, 13)
    with publishing(domain, "/chat,RELIABLE,TRANSIENT_LOCAL,1"):
        await_rate(observer, "rate", 0, 0)
    observer.forget("rate")
    observer.caught_up()
    told = len(observer.heard("rate"))
    observer.ask("later", "rate", topic="/nobody", window=WINDOW)
    await_rate(observer, "later", 0, 0)
    assert len(observer.heard("rate")) == told
