from __future__ import annotations

import signal

import pytest

from orchestra.supervise.outcome import Facts, judge
from orchestra.supervise.process.ending import Ending

CRASH = ("camera", Ending(signal=11))
CODE = ("driver", Ending(code=7))


@pytest.mark.parametrize(
    ("facts", "status", "reason"),
    [
        (Facts(), 0, "every process has ended"),
        (Facts(ended_by="required process a has ended"), 0, "required process a has ended"),
        (Facts(failed=(CRASH,)), 0, "every process has ended; failed: camera (SIGSEGV)"),
        (Facts(mishaps=("a did not activate: x",)), 0, "every process has ended; a did not activate: x"),
        (
            Facts(mishaps=("a did not activate: x",), fail_on_any=True),
            1,
            "every process has ended, and something went wrong; a did not activate: x",
        ),
        (
            Facts(failed=(CRASH,), fail_on_any=True),
            1,
            "every process has ended, and one failed; failed: camera (SIGSEGV)",
        ),
        (
            Facts(failed=(CRASH, CODE), fail_on_any=True),
            1,
            "every process has ended, and some failed; failed: camera (SIGSEGV), driver (exit code 7)",
        ),
        (Facts(failure="a was not ready"), 1, "a was not ready"),
        (Facts(signal=signal.SIGINT), 130, "stopped by SIGINT"),
        (Facts(signal=signal.SIGTERM), 143, "stopped by SIGTERM"),
        (Facts(signal=signal.SIGHUP), 129, "stopped by SIGHUP"),
        (Facts(required=CODE), 7, "required process driver failed (exit code 7)"),
        (Facts(required=CRASH, failed=(CRASH,)), 139, "required process camera failed (SIGSEGV)"),
        (Facts(unstoppable=("a (pid 1)",)), 4, "could not be stopped: a (pid 1)"),
        # Precedence: 4, required code, signal, 1, 0.
        (Facts(unstoppable=("a",), required=CODE), 4, "could not be stopped: a"),
        (Facts(required=CODE, signal=2, failure="x"), 7, "required process driver failed (exit code 7)"),
        (
            Facts(signal=2, failure="x", failed=(CRASH,), fail_on_any=True),
            130,
            "stopped by SIGINT; failed: camera (SIGSEGV)",
        ),
    ],
)
def test_status_and_sentence(facts: Facts, status: int, reason: str) -> None:
    outcome = judge(facts)
    assert (outcome.status, outcome.reason) == (status, reason)


@pytest.mark.parametrize(
    ("ending", "status", "words"),
    [
        (Ending(code=0), 0, "exit code 0"),
        (Ending(code=200), 200, "exit code 200"),
        (Ending(signal=9), 137, "SIGKILL"),
        (Ending(signal=35), 163, "signal 35"),
        (Ending(code=127, reason="no such file: x"), 127, "could not be started: no such file: x"),
    ],
)
def test_an_ending_in_data_and_words(ending: Ending, status: int, words: str) -> None:
    assert (ending.status, str(ending)) == (status, words)
