"""Writes a dossier for every end of a process that nobody wanted, below `crash` in the run directory.

The first and the last ends of a process are kept, so that a crash loop fills no disk. Nothing here can stop a run: what
cannot be written is told once.
"""

from __future__ import annotations

import contextlib
import errno
import json
import os
import time
from typing import TYPE_CHECKING

from orchestra.logs.names import log_stems, shown
from orchestra.supervise.process.machine import succeeded
from orchestra.supervise.process.spec import argv

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
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


class Crashes:
    """The ends of one process, and what led to each."""

    def __init__(self, process: Process, rules: Rules, surroundings: Surroundings) -> None:
        self._process = process
        self._stem = log_stems([process.id])[process.id]
        self._rules = rules
        self._around = surroundings
        self._own: Mapping[str, str] = {}
        self._began, self._began_at = time.time(), surroundings.loop.clock()
        self._starts = 0
        self._runs: list[Run] = []
        self._signals: set[int] = set()
        self._threads: tuple[str, ...] = ()
        self._folders: list[Path] = []
        self._told = False

    def begins(self, own: Mapping[str, str]) -> None:
        """It is about to be started; `own` is what this run's environment has beyond that of the process."""
        self._own = own
        self._began, self._began_at = time.time(), self._around.loop.clock()
        self._starts += 1
        self._signals = set()
        self._threads = ()

    def signalled(self, number: int) -> None:
        """Somebody had a signal sent to it: an end by it is no crash."""
        self._signals.add(number)

    def hung(self, pids: Iterable[int]) -> None:
        """It hangs: keep where its threads are."""
        from orchestra.supervise.signs.threads import threads  # noqa: PLC0415 - few processes hang

        self._threads = tuple(map(str, threads(pids)))

    def ended(self, state: State, ending: Ending, child: Child | None, tail: Tail) -> None:
        """One run of it is over, or did not come about: `child` None. `state` is the one before."""
        from orchestra.supervise.crash.dossier import Run  # noqa: PLC0415 - nothing has ended when the first begins

        uptime = 0.0 if child is None else self._around.loop.clock() - self._began_at
        self._runs.append(Run(self._starts, self._began, uptime, str(ending)))
        del self._runs[:-_KEPT_RUNS]
        if self._is_abnormal(state, ending):
            self._keep(self._dossier(ending, child, uptime, tail.lines if child else ()))

    def _is_abnormal(self, state: State, ending: Ending) -> bool:
        """Tell whether nobody wanted it: neither the plan nor whoever stops, restarts or signals it."""
        if ending.hang is None and (state.asked or state.again):
            return False
        wanted = {*self._signals, *(_SIGNALLED + number for number in self._signals)}
        return not succeeded(self._rules, ending) and not wanted & {ending.signal, ending.code}

    def _dossier(self, ending: Ending, child: Child | None, uptime: float, lines: Sequence[str]) -> Dossier:
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
        changes = difference(os.environ, {**self._around.environment(process), **self._own})
        core = evidence.core_file(process, ending, child, command[0], cwd)
        return Dossier(
            process=process.id,
            run=self._around.folder.name,
            location=str(process.location),
            ended=time.time(),
            uptime=uptime,
            start=self._starts,
            pid=child.pid if child else None,
            cause=evidence.cause_of(process, ending, child, lines, self._began_at, confines),
            lines=tuple(lines),
            log=str(self._around.folder / "logs" / f"{self._stem}.log"),
            history=tuple(self._runs),
            runs_before=self._starts - len(self._runs),
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
            threads=self._threads,
        )

    def _keep(self, dossier: Dossier) -> None:
        # As above.
        import shutil  # noqa: PLC0415

        from orchestra.supervise.crash.dossier import as_document  # noqa: PLC0415

        try:
            folder = self._write(as_document(dossier))
        except OSError as error:
            self._tell(f"has no crash report: {error.strerror}")
            return
        self._folders.append(folder)
        if len(self._folders) > KEPT_FIRST + KEPT_LAST:
            shutil.rmtree(self._folders.pop(KEPT_FIRST), ignore_errors=True)
        self._around.recorder.record("crash_recorded", dossier.process, pid=dossier.pid, folder=str(folder))
        self._tell(f"has a crash report: {folder} (orchestra crash {shown(dossier.process)})")

    def _write(self, document: dict[str, object]) -> Path:
        """Write the files of a dossier, for the owner alone: an environment may hold secrets."""
        import shutil  # noqa: PLC0415 - as above

        from orchestra.supervise.crash.dossier_text import text_of  # noqa: PLC0415 - as above

        base = self._around.folder / FOLDER
        base.mkdir(mode=0o700, exist_ok=True)
        folder = _new_folder(base, f"{self._stem}-{self._starts}")
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
