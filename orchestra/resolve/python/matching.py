"""Which processes a predicate on actions means.

Those of ours say what they look for, and each of a thousand nodes may have some: the processes are looked up by that,
and gone through for predicates of users alone, which may look for anything.
"""

from __future__ import annotations

from bisect import bisect_left, insort
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.events.matchers import ActionMatcher
from orchestra.resolve.python.calling import user_code
from orchestra.resolve.running import name_in_launch

if TYPE_CHECKING:
    from orchestra.resolve.found import Found
    from orchestra.resolve.model import ResolvedProcess
    from orchestra.resolve.resolution import Resolution


class Lookup:
    """The processes that have been found by their full names and their programs, as far as somebody has asked."""

    def __init__(self) -> None:
        self._nodes: dict[str, list[int]] = {}
        self._programs: dict[str, list[int]] = {}
        self._backwards: list[str] = []  # the programs from their last letter to the first, in order
        self._seen = 0
        self._renewals = 0

    def accepted(self, predicate: Any, run: Resolution) -> tuple[int, ...]:
        """Return the processes that a predicate means: one of ours by what it looks for, another by calling it."""
        if not isinstance(predicate, ActionMatcher):
            processes = enumerate(tuple(run.found.processes))
            return tuple(index for index, process in processes if _accepts(predicate, process, run))
        match predicate.by:
            case "action":
                return run.found.made_by(predicate.target)
            case "name":
                return _called(predicate.target, run.found.processes)
            case "executable":
                self._catch_up(run.found)
                return self._run_by(predicate.target)
            case "node_name" if isinstance(predicate.target, str):
                self._catch_up(run.found)
                return tuple(self._nodes.get(predicate.target, ()))
            case _:  # no process has a number yet
                return ()

    def _run_by(self, end: Any) -> tuple[int, ...]:
        """Return the processes whose programs end so, or with one of several texts: none ends with anything else."""
        if isinstance(end, tuple):
            return tuple(sorted({index for one in end for index in self._run_by(one)}))
        if not isinstance(end, str):
            return ()
        begin, programs = end[::-1], self._backwards
        first = last = bisect_left(programs, begin)
        while last < len(programs) and programs[last].startswith(begin):
            last += 1
        return tuple(sorted(index for name in programs[first:last] for index in self._programs[name]))

    def _catch_up(self, found: Found) -> None:
        """Take note of the processes that have come since."""
        if self._renewals != found.renewals:
            self._nodes, self._programs, self._backwards, self._seen = {}, {}, [], 0
            self._renewals = found.renewals
        for index in range(self._seen, len(found.processes)):
            process = found.processes[index]
            name = _full_name(process)
            if name is not None:
                self._nodes.setdefault(name, []).append(index)
            if process.program:
                program = process.program[0][::-1]
                if program not in self._programs:
                    insort(self._backwards, program)
                self._programs.setdefault(program, []).append(index)
        self._seen = len(found.processes)


def _accepts(predicate: Any, process: ResolvedProcess, run: Resolution) -> bool:
    if process.origin is None:
        return False
    answers: list[Any] = []
    with user_code(run, process.location.span):
        answers.append(predicate(process.origin))
    return any(answers)


def _called(name: Any, processes: list[ResolvedProcess]) -> tuple[int, ...]:
    """Return the process that upstream gives a name, which ends with its number."""
    number = name.rpartition("-")[2] if isinstance(name, str) else ""
    may_be = number.isdecimal() and len(number) <= len(str(len(processes)))
    index = int(number) - 1 if may_be else -1
    is_there = 0 <= index < len(processes) and name_in_launch(processes[index], index) == name
    return (index,) if is_there else ()


def _full_name(process: ResolvedProcess) -> str | None:
    if process.name is None:
        return None
    namespace = process.namespace.text if process.namespace is not None else ""
    return f"{namespace.rstrip('/')}/{process.name.text}"
