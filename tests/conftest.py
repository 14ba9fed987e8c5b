"""What holds for every test: nothing that a session started outlives it."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import tempfile
import time
import uuid
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING

import hypothesis
import pytest

from tests.heeding import heed_signals
from tests.held_up import pytest_runtest_protocol  # noqa: F401 - a hook
from tests.pressure import Deadline
from tests.restoring import environment_restored

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator

# Inherited by every process that a test starts, directly or through Orchestra.
_SESSION = "ORCHESTRA_TEST_SESSION"
_MARK = b"ORCHESTRA_RUN="
# As long as Orchestra itself may take to end everything, in seconds; on a machine that is busy up to three times as long.
_PATIENCE = 6.0
# In seconds: how long a long check may take that does not say it itself, on a busy machine.
_LONG = 3_600

# Domains of ROS that stand in tests, each in one module. Whoever looks for a free one takes none of them.
_DOMAINS = range(20, 81)
# Files of tests that take half a minute or more in all, or have a test that does: they come first, so that no worker is
# still at one of them when the others have nothing left to do.
_SLOWEST = Path(__file__).with_name("slowest.txt").read_text("utf-8").split()
_HELD = pytest.StashKey[ExitStack]()

# How long an example takes says more of what else the machine does.
_UNTIMED = hypothesis.settings(deadline=None, suppress_health_check=[hypothesis.HealthCheck.too_slow])
hypothesis.settings.register_profile("untimed", _UNTIMED)
# The long checks try three times as many, and others each time.
hypothesis.settings.register_profile("steady", _UNTIMED, derandomize=True, max_examples=33)


def pytest_configure(config: pytest.Config) -> None:
    # The same code is tried with the same examples each time; the long checks look for others in every run.
    if not config.getoption("--hypothesis-profile"):
        hypothesis.settings.load_profile("steady" if config.option.markexpr == "not long" else "untimed")
    heed_signals()
    os.environ[_SESSION] = uuid.uuid4().hex
    # Of pytest: where the folders of tests are, which stay for a while.
    elsewhere = os.environ.setdefault("PYTEST_DEBUG_TEMPROOT", tempfile.gettempdir())
    # The control sockets of this session's runs, among which no other's are, nor those of the user.
    session = tempfile.mkdtemp(prefix="orchestra-tests-", dir=elsewhere)
    os.environ["XDG_RUNTIME_DIR"] = session
    os.environ["ORCHESTRA_CACHE"] = f"{session}/cache"
    # Temporary files: those of commands, and ours. Of commands some are killed.
    os.environ["TMPDIR"], tempfile.tempdir = f"{session}/theirs", f"{session}/ours"
    for folder in (os.environ["TMPDIR"], tempfile.tempdir):
        Path(folder).mkdir()
    # Hypothesis makes it when it is first used, in the folder that code is imported from: a plan that depends on what is
    # there would be made again.
    (config.rootpath / ".hypothesis").mkdir(exist_ok=True)
    # Hundreds of commands are started: without bytecode each of them would compile all that it imports.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    if hasattr(
        config.option, "loadscopereorder"
    ):  # else pytest-xdist begins with the files that have the most tests
        config.option.loadscopereorder = False
    config.stash[_HELD] = ExitStack()
    if not hasattr(config, "workerinput"):
        _hold_domains(config.stash[_HELD])


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    order = {Path(__file__).parent / name: number for number, name in enumerate(_SLOWEST)}
    items.sort(key=lambda item: order.get(item.path, len(order)))
    for item in items:
        if item.get_closest_marker("long") and not item.get_closest_marker("timeout"):
            item.add_marker(pytest.mark.timeout(_LONG))


def _hold_domains(held: ExitStack) -> None:
    """Hold the locks of `orchestra.testing.domain` that no other session of tests on this machine holds already."""
    for domain in _DOMAINS:
        lock = held.enter_context(socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM))
        with suppress(OSError):
            lock.bind(f"\0orchestra-ros-domain-{domain}")


def pytest_unconfigure(config: pytest.Config) -> None:
    config.stash[_HELD].close()
    shutil.rmtree(os.environ["XDG_RUNTIME_DIR"], ignore_errors=True)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call() -> Generator[None, object, object]:
    """Put the environment back after each test; a fixture would take ten times as long."""
    with environment_restored():
        return (yield)


@pytest.fixture(scope="module", autouse=True)
def the_process_stays_as_it_is() -> Iterator[None]:
    """Fail where the tests of a file leave another working directory, umask, or handler of a signal."""
    before = _state()
    yield
    assert _state() == before


def _state() -> dict[str, object]:
    mask = os.umask(0)
    os.umask(mask)
    # pytest-timeout has another one of its own for each test.
    handlers = {number: signal.getsignal(number) for number in signal.valid_signals() - {signal.SIGALRM}}
    return {"folder": Path.cwd(), "umask": mask, "handlers": handlers}


@pytest.fixture(scope="session", autouse=True)
def nothing_outlives_the_session() -> Iterator[None]:
    """Fail where a process with the mark of a run that this session started is left at its end."""
    yield
    deadline = Deadline(_PATIENCE)
    while (left := _survivors()) and not deadline.is_over:
        time.sleep(0.1)
    assert not left, f"left by runs of this session: {left}"


@pytest.fixture(scope="session", autouse=True)
def no_folder_is_left() -> Iterator[None]:
    """Fail where Orchestra, used in this process, has left a temporary folder."""
    yield
    left = [path.name for path in Path(tempfile.gettempdir()).glob("orchestra-*")]
    assert not left, f"left in {tempfile.gettempdir()}: {left}"


def _survivors() -> list[str]:
    session = f"{_SESSION}={os.environ[_SESSION]}".encode()
    return [
        f"{pid}: {_read(pid, 'cmdline').replace(bytes(1), b' ').decode('utf-8', 'replace')}"
        for pid in os.listdir("/proc")  # noqa: PTH208 - names are all that is needed
        if pid.isdigit() and int(pid) != os.getpid() and _belongs(_read(pid, "environ").split(b"\0"), session)
    ]


def _belongs(environment: list[bytes], session: bytes) -> bool:
    return session in environment and any(entry.startswith(_MARK) for entry in environment)


def _read(pid: str, name: str) -> bytes:
    try:
        return Path(f"/proc/{pid}/{name}").read_bytes()
    except OSError:
        return b""
