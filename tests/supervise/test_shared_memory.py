"""What nodes that were killed leave in shared memory goes; what living ones use stays."""

from __future__ import annotations

import contextlib
import fcntl
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.environment import node_environment
from orchestra.supervise.host import this_host
from orchestra.supervise.keeping import proc, shared_memory
from orchestra.values import Restart
from tests.chaos.stage import unshare_words
from tests.supervise.plans import PROCESSES, alive, launched, plan, process, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Process

SHM = Path("/dev/shm")  # noqa: S108 - it is
OURS, OTHER = "75", "76"
# Where there is less, nodes talk by UDP.
_NEEDED = 32 << 20
PUBLISHER = (sys.executable, str(PROCESSES / "publisher.py"))
TOPIC = "/topic,RELIABLE,VOLATILE,0"


def _free() -> int:
    found = os.statvfs(SHM)
    return found.f_bavail * found.f_frsize


pytestmark = pytest.mark.skipif(_free() < _NEEDED, reason=f"{SHM} is too small or full")


# Says as much as it can, and hears, in one process each.
TALKER = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("talker")
publisher = node.create_publisher(String, "said", 10)
node.create_timer(0.001, lambda: publisher.publish(String(data="x" * 300)))
try:
    rclpy.spin(node)
except (KeyboardInterrupt, rclpy.executors.ExternalShutdownException):
    pass
"""
LISTENER = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("listener")
heard = []
def hear(message):
    heard.append(message)
    if len(heard) == 50:
        print("hears", flush=True)
node.create_subscription(String, "said", hear, 10)
try:
    rclpy.spin(node)
except (KeyboardInterrupt, rclpy.executors.ExternalShutdownException):
    pass
"""
ROUNDS = 6


def files() -> set[str]:
    return {path.name for path in SHM.iterdir() if "fastrtps_" in path.name}


def node(name: str) -> Process:
    return process(name, command=(*PUBLISHER, f"/{name},RELIABLE,VOLATILE,0"))


@contextlib.contextmanager
def stranger(domain: str, folder: Path) -> Iterator[set[str]]:
    """A node of somebody else; the value are the files that it uses."""
    caller = {**os.environ, "ROS_DOMAIN_ID": domain, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    environment = node_environment(
        caller, this_host(), {}, log_folder=str(folder), colour=False, marks=("no run", "")
    )
    with subprocess.Popen([*PUBLISHER, TOPIC], env=environment, stdout=subprocess.PIPE) as living:
        try:
            assert living.stdout
            assert living.stdout.readline() == b"up\n"
            yield used_by(living.pid)
            assert living.poll() is None
        finally:
            living.send_signal(signal.SIGINT)


def used_by(pid: int) -> set[str]:
    """Return what a participant needs to be found: what it maps, and what it locks."""
    maps = Path(f"/proc/{pid}/maps").read_text()
    mapped = {line.rpartition("/")[2] for line in maps.splitlines() if "/shm/fastrtps_" in line}
    links = (str(path.readlink()) for path in Path(f"/proc/{pid}/fd").iterdir() if path.is_symlink())
    return mapped | {link.rpartition("/")[2] for link in links if "/shm/fastrtps_" in link}


def owned_by(pid: int) -> dict[str, int]:
    """Return what only a participant itself removes, with the inode of each: the names of ports are given anew."""
    stems = {name.removesuffix("_el") for name in used_by(pid) if name.endswith("_el")}
    names = {name for stem in stems for name in (stem, f"{stem}_el")}
    return {name: inode for name in names if (inode := inode_of(name))}


def inode_of(name: str) -> int | None:
    try:
        return (SHM / name).stat().st_ino
    except FileNotFoundError:
        return None


@pytest.mark.parametrize("target", [None, "orc-supervisor", "orc-keeper"])
def test_what_killed_nodes_left_is_removed(tmp_path: Path, target: str | None) -> None:
    """By the supervisor, and by the keeper where the supervisor is killed as well."""
    with launched(tmp_path, plan(node("a"), node("b")), environment={"ROS_DOMAIN_ID": OURS}) as run:
        for name in ("a", "b"):
            run.await_line(name, "up")
        pids = [event.pid for event in run.of_kind("process_running") if event.pid]
        owned = {name: inode for pid in pids for name, inode in owned_by(pid).items()}
        assert sum(name.endswith("_el") for name in owned) >= 4
        ours = run.own(target) if target else None
        if ours:
            os.kill(ours, signal.SIGSTOP)  # it has no time to clear up
        for pid in pids:
            os.kill(pid, signal.SIGKILL)
        if ours:
            os.kill(ours, signal.SIGKILL)
        run.wait()
        run.assert_gone(8.0)
        assert not {name for name in left_of(owned) if not in_use(name)}


def test_nobody_hangs_for_a_dead_reader(tmp_path: Path) -> None:
    """Who sends to it would wait for itself, if it finds the lock of the dead one free (Fast DDS, issue 6485)."""
    with launched(tmp_path, plan(node("a"), node("b")), environment={"ROS_DOMAIN_ID": OURS}) as run:
        for name in ("a", "b"):
            run.await_line(name, "up")
        killed, living = (run.of_kind("process_running", name)[0].pid or 0 for name in ("a", "b"))
        ports = {
            name.removesuffix("_el") for name in owned_by(killed) if name.endswith("_el") and "port" in name
        }
        assert ports
        kept = owned_by(living)
        os.kill(killed, signal.SIGKILL)
        wait_for(lambda: all(is_closed(port) for port in ports), "the end of the ports of the dead one")
        assert left_of(kept) == set(kept)
        assert alive(living)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        # Others who run on this machine may have closed some of them.
        ours = {port for port in ports if not is_locked(f"{port}_el")}
        assert not ours & files()


def is_closed(port: str) -> bool:
    """Tell whether nobody can open or make a port, nor take its lock."""
    return (SHM / port).is_dir() and is_locked(f"{port}_el")


def is_locked(name: str) -> bool:
    try:
        with (SHM / name).open() as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except FileNotFoundError:
        return False
    except BlockingIOError:
        return True
    return False


def test_a_node_that_is_started_again_takes_other_ports(tmp_path: Path) -> None:
    """Who still sends to the dead one makes and removes what it finds under the name of the port."""
    again = process("a", command=node("a").command, restart=Restart("always", delay=0.0, max_delay=0.0))
    with launched(tmp_path, plan(again, node("b")), environment={"ROS_DOMAIN_ID": OURS}) as run:
        for name in ("a", "b"):
            run.await_line(name, "up")
        first = ports_of(run.of_kind("process_running", "a")[-1].pid or 0)
        os.kill(run.of_kind("process_running", "a")[-1].pid or 0, signal.SIGKILL)
        run.await_line("a", "up", 2)
        second = ports_of(run.of_kind("process_running", "a")[-1].pid or 0)
        assert first
        assert second
        assert not first & second
        run.send(signal.SIGINT)
        assert run.wait() == 130


def ports_of(pid: int) -> set[str]:
    return {name for name in used_by(pid) if name.endswith("_el") and "port" in name}


def test_who_was_killed_among_many_messages_hears_again(tmp_path: Path) -> None:
    """Whatever it was doing: its next start takes over nothing of what the dead one has left."""
    talker, listener = (
        process(name, command=(sys.executable, "-c", code), restart=restart)
        for name, code, restart in (
            ("talker", TALKER, None),
            ("listener", LISTENER, Restart("always", delay=0.0, max_delay=0.0, growth=1.0)),
        )
    )
    with launched(tmp_path, plan(talker, listener), environment={"ROS_DOMAIN_ID": OURS}) as run:
        for start in range(1, ROUNDS + 1):
            run.await_line("listener", "hears", start)
            if start < ROUNDS:
                os.kill(run.of_kind("process_running", "listener")[-1].pid or 0, signal.SIGKILL)
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_a_lock_that_is_fresh_or_held_stays(made: list[Path]) -> None:
    fresh = make(made, "fastrtps_port4000000001_el")
    held = make(made, "fastrtps_port4000000002_el", age=10.0)
    port = make(made, "fastrtps_port4000000003", age=10.0)
    free = make(made, f"{port.name}_el", age=10.0)
    with held.open() as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        dead = shared_memory.DeadReaders()
        closed = dead.close()
    assert not {fresh.name.removesuffix("_el"), held.name.removesuffix("_el")} & set(closed)
    # Runs of others on this machine may be quicker with what is free.
    assert is_closed(port.name) or not free.exists()
    dead.end()
    assert port.name not in closed or not (port.exists() or free.exists())


def test_the_folder_is_listed_again_only_where_something_has_come_or_gone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shared_memory, "_FOLDER", str(tmp_path))
    listed: list[str] = []
    listdir = os.listdir

    def counted(path: str) -> list[str]:
        listed.append(path)
        return listdir(path)

    monkeypatch.setattr(os, "listdir", counted)
    dead = shared_memory.DeadReaders()
    settled = time.time() - 10.0
    os.utime(tmp_path, (settled, settled))
    assert [dead.close() for _ in range(5)] == [[]] * 5
    assert len(listed) == 1

    def came(name: str) -> None:
        lock = tmp_path / f"{name}_el"
        lock.touch()
        os.utime(lock, (settled, settled))

    came("fastrtps_port1")
    assert dead.close() == ["fastrtps_port1"]
    # This one comes while the clock of the folder stands still.
    tick = tmp_path.stat().st_mtime
    came("fastrtps_port2")
    os.utime(tmp_path, (tick, tick))
    assert dead.close() == ["fastrtps_port2"]
    dead.end()
    assert not listdir(tmp_path)


def test_a_port_that_a_dead_supervisor_has_closed_goes(made: list[Path]) -> None:
    port = make(made, "fastrtps_port4000000004", age=10.0)
    free = make(made, f"{port.name}_el", age=10.0)
    dead = shared_memory.DeadReaders()
    closed = dead.close()
    os.close(dead._held[port.name][0]) if port.name in closed else None
    shared_memory.remove_leftovers(time.time() - 50.0)
    assert not port.exists() or is_locked(free.name)


def left_of(owned: dict[str, int]) -> set[str]:
    return {name for name, inode in owned.items() if inode_of(name) == inode}


def in_use(name: str) -> bool:
    """Tell whether a participant of another run, perhaps in another domain, has mapped it: then it has to stay."""
    stem = name.removesuffix("_el")
    for pid in proc.pids():
        with contextlib.suppress(OSError):
            if {stem, f"{stem}_el"} & used_by(pid):
                return True
    return False


@pytest.mark.parametrize("domain", [OURS, OTHER])
def test_a_living_participant_keeps_all_of_its_own(tmp_path: Path, domain: str) -> None:
    with (
        launched(tmp_path, plan(node("a")), environment={"ROS_DOMAIN_ID": OURS}) as run,
        stranger(domain, tmp_path) as used,
    ):
        run.await_line("a", "up")
        pid = run.of_kind("process_running", "a")[0].pid
        assert pid
        segments = {name: inode for name, inode in owned_by(pid).items() if "port" not in name}
        assert segments
        assert used <= files()
        # What the living one has mapped of the ports of the other, who is dead, goes with that.
        kept = used - owned_by(pid).keys()
        os.kill(pid, signal.SIGKILL)
        assert run.wait() == 0
        assert kept <= files()
        if domain == OTHER:  # in the same one the living one may have mapped them, and then they stay
            assert not {name for name, inode in segments.items() if inode_of(name) == inode}


@pytest.fixture
def made() -> Iterator[list[Path]]:
    """Files that a test makes in shared memory."""
    paths: list[Path] = []
    yield paths
    for path in paths:
        # A supervisor of another test may have closed it meanwhile, who opens it again when its own run is over.
        with contextlib.suppress(IsADirectoryError):
            path.unlink(missing_ok=True)


def make(made: list[Path], name: str, age: float = 0.0) -> Path:
    path = SHM / name
    path.touch()
    moment = time.time() - age
    os.utime(path, (moment, moment))
    made.append(path)
    return path


STEM = "fastrtps_00000000deadbeef"


def test_only_what_came_during_the_run_is_removed(made: list[Path]) -> None:
    old = make(made, STEM, age=100.0)
    old_lock = make(made, f"{STEM}_el", age=100.0)
    assert not {old.name, old_lock.name} & set(shared_memory.remove_leftovers(time.time() - 50.0))
    assert {old.name, old_lock.name} <= set(shared_memory.remove_leftovers(time.time() - 150.0))
    assert not old.exists()
    assert not old_lock.exists()


def test_what_has_no_lock_must_have_been_there_for_a_while(made: list[Path]) -> None:
    begun = make(made, STEM)
    assert begun.name not in shared_memory.remove_leftovers(time.time() - 50.0)
    assert begun.exists()
    make(made, STEM, age=5.0)
    assert begun.name in shared_memory.remove_leftovers(time.time() - 50.0)


def test_files_of_others_stay(made: list[Path]) -> None:
    strange = [make(made, name, age=5.0) for name in ("fastrtps_", f"{STEM}_what", f"x{STEM}", "sem.other")]
    shared_memory.remove_leftovers(time.time() - 50.0)
    assert all(path.exists() for path in strange)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can make files of others")
def test_another_users_files_stay(made: list[Path]) -> None:
    other = make(made, STEM, age=5.0)
    os.chown(other, 65534, 65534)
    assert other.name not in shared_memory.remove_leftovers(time.time() - 50.0)
    assert other.exists()


def test_a_run_that_ends_by_itself_looks_at_nothing(tmp_path: Path, made: list[Path]) -> None:
    """A run of somebody else may remove the file meanwhile; hardly in each of five cases."""
    for number in range(5):
        folder = tmp_path / str(number)
        folder.mkdir()
        with launched(folder, plan(process("a", "polite", "say=up", "linger"))) as run:
            run.await_line("a", "up")
            left = make(made, f"{STEM}_el")
            run.send(signal.SIGINT)
            assert run.wait() == 130
            if left.exists():
                return
    pytest.fail("it was removed each time")


def test_a_run_of_which_something_was_killed_looks(tmp_path: Path, made: list[Path]) -> None:
    with launched(tmp_path, plan(process("a", "daemon", "say=up", "polite", "linger"))) as run:
        run.await_line("a", "up")
        left = make(made, f"{STEM}_el")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        wait_for(lambda: not left.exists(), "the file to be removed", 1.0)


MAPPING = """
import mmap, sys
with open(sys.argv[1], "w+b") as file:
    file.truncate(mmap.PAGESIZE)
    held = mmap.mmap(file.fileno(), mmap.PAGESIZE)
print("up", flush=True)
sys.stdin.read()
"""
APART = ("sh", "-c", 'mount -t tmpfs shm /dev/shm && exec "$@"', "sh")


@pytest.mark.parametrize("apart", [False, True])
def test_what_another_container_has_under_the_same_name_is_not_ours(made: list[Path], apart: bool) -> None:
    """A segment, because another run on this machine closes ports that nobody locks."""
    words = unshare_words() if apart else ()
    if words is None:
        pytest.skip("no namespaces")
    left = make(made, "fastrtps_00000000deadbee5")
    make(made, f"{left.name}_el")
    command = (*(("unshare", *words, *APART) if words else ()), sys.executable, "-c", MAPPING, str(left))
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as other:
        assert other.stdout
        assert other.stdout.readline() == b"up\n"
        shared_memory.remove_leftovers(time.time() - 50.0)
        assert left.exists() is not apart
