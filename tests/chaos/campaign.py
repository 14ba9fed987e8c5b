"""Plays many cases, each in an interpreter of its own, and tells what went wrong and how long it took."""

from __future__ import annotations

import contextlib
import json
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra import events
from tests.chaos import cases, inventing
from tests.chaos.cases import Case
from tests.chaos.judging import judge
from tests.chaos.playing import HANG, play
from tests.chaos.smaller import smallest
from tests.chaos.stage import here
from tests.heeding import heed_signals

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator


_ROOT = Path(__file__).parents[2]
# One that does not come back within this time hangs itself, with what it plays; in seconds.
_PATIENCE = 3 * HANG
_LAST_EVENTS = 30
_BURN = (
    "import os, sys, threading\n"
    "threading.Thread(target=lambda: (sys.stdin.read(), os._exit(0))).start()\n"
    "while True: pass"
)


@dataclass(frozen=True, slots=True)
class Verdict:
    """What became of a case: the broken promises, its exit status, and the seconds until all was gone."""

    case: Case
    broken: tuple[str, ...]
    status: int | None
    lasted: float


def verdicts(chosen: Iterable[Case], jobs: int) -> Iterator[Verdict]:
    """Play cases, some at once, and yield what became of each as soon as it is known."""
    waiting = list(chosen)
    playing: dict[subprocess.Popen[bytes], tuple[Case, float]] = {}
    try:
        while waiting or playing:
            while waiting and len(playing) < jobs:
                case = waiting.pop(0)
                playing[_player(case)] = (case, time.monotonic() + _PATIENCE)
            for popen, (case, deadline) in list(playing.items()):
                if popen.poll() is not None or time.monotonic() > deadline:
                    del playing[popen]
                    yield _verdict(case, popen)
            time.sleep(0.02)
    finally:
        for popen in playing:
            _end(popen)


def _player(case: Case) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "tests.chaos", "--play", cases.dumps(case)]
    return subprocess.Popen(command, cwd=_ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE)


def _end(popen: subprocess.Popen[bytes]) -> None:
    """End who plays; he clears the stage first, if he still can."""
    popen.terminate()
    with contextlib.suppress(subprocess.TimeoutExpired):
        popen.communicate(timeout=HANG)
    popen.kill()
    popen.communicate()


def _verdict(case: Case, popen: subprocess.Popen[bytes]) -> Verdict:
    if popen.poll() is None:
        _end(popen)
        return Verdict(case, ("it hangs, and whoever plays it too",), None, _PATIENCE)
    output = popen.communicate()[0]
    if popen.returncode:
        return Verdict(case, (f"it cannot be played: status {popen.returncode}",), None, 0.0)
    told = json.loads(output)
    return Verdict(case, tuple(told["broken"]), told["status"], told["lasted"])


def _play(case: Case) -> int:
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # with everything that is to be done at the end
    folder = Path(tempfile.mkdtemp(prefix="chaos-"))
    try:
        seen = play(case, folder / "stage")
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    broken = judge(case, seen)
    if broken:
        happened = "\n".join(events.dumps(event) for event in seen.events[-_LAST_EVENTS:])
        sys.stderr.write(f"---- {case.seed}: what was told\n{_of_interest(seen.screen)}\n{happened}\n")
    sys.stdout.write(json.dumps({"broken": broken, "status": seen.status, "lasted": seen.lasted}))
    return 0


def _of_interest(screen: str) -> str:
    """Return the last of what was shown, without the numbered lines of processes."""
    lines = [line for line in screen.splitlines() if "xxxx" not in line and line != "full"]
    return "\n".join(lines[-40:])


def main(words: list[str], about: str) -> int:
    """Carry out the command line."""
    heed_signals()
    options = _options(words, about)
    if options.play:
        return _play(cases.loads(options.play))
    with burning(options.busy):
        return _campaign(options)


def _campaign(options: Namespace) -> int:
    seed = options.seed or f"{time.time_ns():x}"
    chosen = [cases.loads(options.replay)] if options.replay else list(_cases(seed, options))
    sys.stdout.write(f"seed {seed}, {len(chosen)} runs, {options.jobs} at once\n")
    begin, longest, failed = time.monotonic(), 0.0, list[Verdict]([])
    for verdict in verdicts(chosen, options.jobs):
        longest = max(longest, verdict.lasted)
        if verdict.broken:
            failed.append(verdict)
            _tell(verdict)
    took = time.monotonic() - begin
    sys.stdout.write(
        f"{len(chosen)} runs in {took:.0f} s, {len(failed)} broke a promise; longest end {longest:.1f} s; seed {seed}\n"
    )
    if failed and options.shrink:
        sys.stdout.write(f"smallest: {cases.dumps(smallest(failed[0].case, _fails))}\n")
    return 1 if failed else 0


def _cases(seed: str, options: Namespace) -> Iterator[Case]:
    numbers = range(options.runs) if options.only is None else [options.only]
    for number in numbers:
        yield inventing.case(f"{seed}:{number}", here())


def _fails(case: Case) -> bool:
    """Play a case up to three times: what goes wrong depends on moments too."""
    return any(verdict.broken for verdict in verdicts([case] * 3, 3))


def _tell(verdict: Verdict) -> None:
    broken = "".join(f"    {text}\n" for text in verdict.broken)
    sys.stdout.write(
        f"{verdict.case.seed} (status {verdict.status}):\n{broken}    {cases.dumps(verdict.case)}\n"
    )
    sys.stdout.flush()


@contextmanager
def burning(count: int) -> Iterator[None]:
    """Keep cores busy meanwhile; what does so ends with its standard input, whatever becomes of us."""
    command = [sys.executable, "-S", "-E", "-c", _BURN]
    started = [subprocess.Popen(command, stdin=subprocess.PIPE) for _ in range(count)]
    try:
        yield
    finally:
        for popen in started:
            popen.kill()
            popen.communicate()


def _options(words: list[str], about: str) -> Namespace:
    parser = ArgumentParser(
        "python -m tests.chaos", description=about, formatter_class=RawDescriptionHelpFormatter
    )
    parser.add_argument("--seed")
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--jobs", type=int, default=4)
    parser.add_argument("--busy", type=int, default=0)
    parser.add_argument("--only", type=int)
    parser.add_argument("--replay")
    parser.add_argument("--shrink", action="store_true")
    parser.add_argument("--play")
    return parser.parse_args(words)
