"""Facts about processes from /proc (proc(5)). A process that has gone is None or missing, never an error."""

from __future__ import annotations

import os

# Field 22 of /proc/PID/stat, counted behind the state, which is field 3.
_BIRTH = 18
# Fields 5 and 8, counted from the state itself: the process group, and the one that its terminal listens to.
_GROUP, _FOREGROUND = 2, 5
_LOCKS = b"Max file locks"


class Stat:
    """What matters here of /proc/PID/stat."""

    __slots__ = ("group", "parent", "pid", "session", "state")

    def __init__(self, pid: int, state: str, parent: int, group: int, session: int) -> None:
        self.pid = pid
        self.state = state
        self.parent = parent
        self.group = group
        self.session = session


def stat(pid: int) -> Stat | None:
    """Return the facts of a process; None where it has been reaped."""
    content = _read(f"/proc/{pid}/stat")
    if content is None:
        return None
    # The name is in parentheses and may itself contain spaces and parentheses.
    state, parent, group, session = content.rpartition(b")")[2].split()[:4]
    return Stat(pid, state.decode(), int(parent), int(group), int(session))


def foreground(pid: int) -> bool | None:
    """Tell whether the group of a process is in the foreground of its terminal; None where it has none or has ended."""
    content = _read(f"/proc/{pid}/stat")
    if content is None:
        return None
    group, _session, terminal, reading = map(int, content.rpartition(b")")[2].split()[2:6])
    return reading == group if terminal and reading > 0 else None


def birth(pid: int) -> int | None:
    """Return when a process began, in clock ticks since the machine did; None where it has ended.

    Together with its number this is a process for good: numbers are given anew, not at the same time.
    """
    content = _read(f"/proc/{pid}/stat")
    if content is None:
        return None
    state, *facts = content.rpartition(b")")[2].split()
    return None if state in (b"Z", b"X") else int(facts[_BIRTH])


def is_runnable(pid: int) -> bool:
    """Tell whether a process runs, waits for nothing but a processor, or has ended and is to be reaped."""
    facts = stat(pid)
    return facts is not None and facts.state in "RZX"


def run_time(pid: int) -> float | None:
    """Return for how long the first thread of a process has had a processor, in seconds; None where that is not told.

    In nanoseconds in the file, where `stat` counts ticks (sched-stats, CONFIG_SCHED_INFO).
    """
    words = (_read(f"/proc/{pid}/schedstat") or b"").split()
    return int(words[0]) / 1e9 if words else None


def pids() -> list[int]:
    """Return every process on the machine."""
    return [
        int(name)
        for name in os.listdir("/proc")  # noqa: PTH208 - as above
        if name.isdigit()
    ]


def children(pid: int) -> list[int]:
    """Return the children of all threads of a process, ended ones that nobody has reaped included."""
    found: list[int] = []
    try:
        threads = os.listdir(f"/proc/{pid}/task")  # noqa: PTH208 - pathlib is slow to import and this runs in the keeper
    except OSError:
        return found
    for thread in threads:
        content = _read(f"/proc/{pid}/task/{thread}/children")
        if content is None and _read(f"/proc/self/task/{os.getpid()}/children") is None:
            return _children_by_scan(pid)
        found.extend(int(word) for word in (content or b"").split())
    return found


def descendants(root: int) -> list[int]:
    """Return every living descendant of a process, nearest first; ended ones count only for what is below them."""
    below: dict[int, list[Stat]] = {}
    for pid in pids():
        facts = stat(pid)
        if facts:
            below.setdefault(facts.parent, []).append(facts)
    found: list[int] = []
    layer = [root]
    while layer:
        facts_of_layer = [facts for parent in layer for facts in below.get(parent, ())]
        found.extend(facts.pid for facts in facts_of_layer if facts.state not in "ZX")
        layer = [facts.pid for facts in facts_of_layer]
    return found


def childless() -> bool:
    """Tell whether this process has no child, not even one that has ended and is to be reaped.

    Of a subreaper this says that nothing at all is below it, which no look at /proc can: what forks and ends all the
    time has another number at each look (waitid(2), ECHILD).
    """
    try:
        os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT)
    except ChildProcessError:
        return True
    return False


def branch(root: int) -> list[int]:
    """Return what is below a process, by the `children` files: only its own branch is read, not the whole machine."""
    found: list[int] = []
    todo = [root]
    while todo:
        below = children(todo.pop())
        found.extend(below)
        todo.extend(below)
    return found


def lock_limit(pid: int) -> int | None:
    """Return the soft limit on file locks of a process; None where it is unlimited or cannot be known."""
    for line in (_read(f"/proc/{pid}/limits") or b"").splitlines():
        if line.startswith(_LOCKS):
            value = line[len(_LOCKS) :].split()[0]
            return int(value) if value.isdigit() else None
    return None


def in_foreground(pid: int) -> bool:
    """Tell whether a process is in the group that reads its terminal; a process without a terminal is not."""
    content = _read(f"/proc/{pid}/stat")
    if content is None:
        return False
    group, foreground = (int(content.rpartition(b")")[2].split()[index]) for index in (_GROUP, _FOREGROUND))
    return group == foreground


def marks(pid: int, names: tuple[str, ...]) -> tuple[str | None, ...]:
    """Return the values of environment variables with which a process was started; None where one is missing."""
    content = _read(f"/proc/{pid}/environ") or b""
    entries = dict(entry.partition(b"=")[::2] for entry in content.split(b"\0"))
    return tuple(_text(entries.get(name.encode())) for name in names)


def name(pid: int) -> str | None:
    """Return the name that `ps -o comm` shows, of a process that has ended and is not reaped too; None else."""
    content = _read(f"/proc/{pid}/comm")
    return None if content is None else content.decode("utf-8", "replace").rstrip("\n")


def command(pid: int) -> str:
    """Return the command line for people, the name where there is none."""
    content = _read(f"/proc/{pid}/cmdline") or b""
    words = content.rstrip(b"\0").replace(b"\0", b" ") or _read(f"/proc/{pid}/comm") or b"?"
    return words.decode("utf-8", "replace").strip()


def _children_by_scan(parent: int) -> list[int]:
    """Do without the `children` files: not every kernel has them (CONFIG_PROC_CHILDREN)."""
    everything = (stat(pid) for pid in pids())
    return [facts.pid for facts in everything if facts and facts.parent == parent]


def _read(path: str) -> bytes | None:
    try:
        with open(path, "rb") as file:  # noqa: PTH123 - pathlib is slow to import and this runs in the keeper
            return file.read()
    except OSError:
        return None


def _text(value: bytes | None) -> str | None:
    return None if value is None else os.fsdecode(value)
