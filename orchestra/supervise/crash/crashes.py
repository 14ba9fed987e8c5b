"""Writes a dossier for every end of a process that nobody wanted, below `crash` in the run directory.

The first and the last ends of a process are kept, so that a crash loop fills no disk. Nothing here can stop a run: what
cannot be written is told once. What starts again is not kept waiting for it either: a dossier costs some 15 ms.
"""

from __future__ import annotations

import contextlib
import errno
import json
import os
import time
from functools import partial
from typing import TYPE_CHECKING

from orchestra.logs.names import log_stems, shown
from orchestra.supervise.process.life import LIVE, Phase
from orchestra.supervise.process.machine import succeeded
from orchestra.supervise.process.spec import argv

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping
    from pathlib import Path

    from orchestra.logs.tail import Tail
    from orchestra.plan.model import Process
    from orchestra.supervise.crash.dossier import Dossier, Run
    from orchestra.supervise.process.child import Child
    from orchestra.supervise.process.ending import Ending
    from orchestra.supervise.process.life import Rules, State
    from orchestra.supervise.surroundings import Surroundings

FOLDER, REPORT, TEXT = "crash", "report.json", "report.txt"
KEPT_FIRST, KEPT_LAST = 3, 5
_KEPT_RUNS = 50
_SIGNALLED = 128


class _Attempt:
    """One start of a process: `own` is what its environment has beyond that of the process."""

    __slots__ = ("began", "began_at", "number", "own", "signals", "threads")

    def __init__(self, number: int, own: Mapping[str, str], began_at: float) -> None:
        self.number = number
        self.own = own
        self.began, self.began_at = time.time(), began_at
        self.signals: set[int] = set()
        self.threads: tuple[str, ...] = ()


class Crashes:
    """The ends of one process, and what led to each."""

    def __init__(self, process: Process, rules: Rules, surroundings: Surroundings) -> None:
        self._process = process
        self._stem = log_stems([process.id])[process.id]
        self._rules = rules
        self._around = surroundings
        self._latest = _Attempt(0, {}, surroundings.loop.clock())
        self._runs: list[Run] = []
        self._folders: list[Path] = []
        self._told = False
        self._unwritten: Callable[[], Dossier] | None = None

    def begins(self, own: Mapping[str, str]) -> None:
        """It is about to be started; `own` is what this run's environment has beyond that of the process."""
        self._latest = _Attempt(self._latest.number + 1, own, self._around.loop.clock())

    def signalled(self, number: int) -> None:
        """Somebody had a signal sent to it: an end by it is no crash."""
        self._latest.signals.add(number)

    def hung(self, pids: Iterable[int]) -> None:
        """It hangs: keep where its threads are."""
        from orchestra.supervise.signs.threads import threads  # noqa: PLC0415 - few processes hang

        self._latest.threads = tuple(map(str, threads(pids)))

    def ended(self, state: State, ending: Ending, child: Child | None, tail: Tail) -> None:
        """One run of it is over, or did not come about: `child` None. `state` is the one before.

        Its dossier waits for `write`; not where what the kernel counts is that of the next run as soon as that begins.
        """
        self.write()
        from orchestra.supervise.crash.dossier import Run  # noqa: PLC0415 - nothing has ended when the first begins

        latest = self._latest
        uptime = 0.0 if child is None else self._around.loop.clock() - latest.began_at
        self._runs.append(Run(latest.number, latest.began, uptime, str(ending)))
        del self._runs[:-_KEPT_RUNS]
        if not self._is_abnormal(state, ending):
            return
        lines = tuple(tail.lines) if child else ()
        self._unwritten = partial(self._dossier, latest, ending, child, lines, tuple(self._runs), time.time())
        if self._around.confines.cap(self._process.id):
            self.write()

    def entered(self, phase: Phase) -> None:
        """Something has happened to it: write what waits, unless it is starting again and shall not wait for that."""
        if self._unwritten is None or phase in (Phase.RESTARTING, Phase.STARTING):
            return
        if phase in LIVE:
            self._around.loop.call_later(0.0, self.write)
        else:
            self.write()

    def write(self) -> None:
        """Write the dossier that waits, if one does."""
        dossier, self._unwritten = self._unwritten, None
        if dossier:
            self._keep(dossier())

    def _is_abnormal(self, state: State, ending: Ending) -> bool:
        """Tell whether nobody wanted it: neither the plan nor whoever stops, restarts or signals it."""
        if ending.hang is None and (state.asked or state.again):
            return False
        signals = self._latest.signals
        wanted = {*signals, *(_SIGNALLED + number for number in signals)}
        return not succeeded(self._rules, ending) and not wanted & {ending.signal, ending.code}

    def _dossier(
        self,
        attempt: _Attempt,
        ending: Ending,
        child: Child | None,
        lines: tuple[str, ...],
        runs: tuple[Run, ...],
        ended: float,
    ) -> Dossier:
        # All of it only here, because most processes never crash.
        from dataclasses import asdict  # noqa: PLC0415

        from orchestra.supervise.crash import evidence  # noqa: PLC0415
        from orchestra.supervise.crash.dossier import (  # noqa: PLC0415
            Dossier,
            difference,
            parameter_files,
            repetition,
        )

        process, confines = self._process, self._around.confines
        command, cwd = argv(process), os.path.abspath(process.cwd or ".")  # noqa: PTH100 - links stay as they are
        changes = difference(os.environ, {**self._around.environment(process), **attempt.own})
        core = evidence.core_file(process, ending, child, command[0], cwd)
        return Dossier(
            process=process.id,
            run=self._around.folder.name,
            location=str(process.location),
            ended=ended,
            uptime=runs[-1].uptime,
            start=attempt.number,
            pid=child.pid if child else None,
            cause=evidence.cause_of(process, ending, child, lines, attempt.began_at, confines),
            lines=lines,
            log=str(self._around.folder / "logs" / f"{self._stem}.log"),
            history=runs,
            runs_before=attempt.number - len(runs),
            command=command,
            cwd=cwd,
            repeat=repetition(command, cwd, changes),
            parameter_files=parameter_files(command),
            environment=changes,
            core=core.path if core else None,
            core_advice=core.advice if core else None,
            resources=evidence.resources_of(process, child, confines),
            limits=asdict(process.limits) if process.limits else None,
            rlimits=evidence.limits_in_force(process),
            threads=attempt.threads,
        )

    def _keep(self, dossier: Dossier) -> None:
        # As above.
        import shutil  # noqa: PLC0415

        from orchestra.supervise.crash.dossier import as_document  # noqa: PLC0415

        try:
            folder = self._write(as_document(dossier), dossier.start)
        except OSError as error:
            self._tell(f"has no crash report: {error.strerror}")
            return
        self._folders.append(folder)
        if len(self._folders) > KEPT_FIRST + KEPT_LAST:
            shutil.rmtree(self._folders.pop(KEPT_FIRST), ignore_errors=True)
        self._around.recorder.record("crash_recorded", dossier.process, pid=dossier.pid, folder=str(folder))
        self._tell(f"has a crash report: {folder} (orchestra crash {shown(dossier.process)})")

    def _write(self, document: dict[str, object], start: int) -> Path:
        """Write the files of a dossier, for the owner alone: an environment may hold secrets."""
        import shutil  # noqa: PLC0415 - as above

        from orchestra.supervise.crash.dossier_text import text_of  # noqa: PLC0415 - as above

        base = self._around.folder / FOLDER
        base.mkdir(mode=0o700, exist_ok=True)
        folder = _new_folder(base, f"{self._stem}-{start}")
        try:
            report = json.dumps(document, indent=2, ensure_ascii=False) + "\n"
            (folder / REPORT).write_text(report, "utf-8", "backslashreplace")
            (folder / TEXT).write_text(text_of(document), "utf-8", "backslashreplace")
        except OSError:
            shutil.rmtree(folder, ignore_errors=True)
            raise
        return folder

    def _tell(self, text: str) -> None:
        """Say it once: what follows in a crash loop would be the same again."""
        if not self._told:
            self._told = True
            self._around.journal.say(f"{shown(self._process.id)} {text}")


def _new_folder(base: Path, stem: str) -> Path:
    """Make a folder that is not there yet: two processes may have names that are one for files."""
    for name in (stem, *(f"{stem}~{number}" for number in range(2, 100))):
        with contextlib.suppress(FileExistsError):
            (base / name).mkdir(mode=0o700)
            return base / name
    raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), str(base / stem))
