"""The command `orchestra`. It imports almost nothing before the first fork, so that the keeper of a run stays small."""

from __future__ import annotations

import sys

from orchestra.compiled import install
from orchestra.stack import roomy

TYPE_CHECKING = False  # `typing` itself costs more than this module
if TYPE_CHECKING:
    from typing import BinaryIO

    from orchestra.supervise.resolver.serving import Answer, Settled

_ONLY_SHOWING = {"--help", "--show-args", "--show-arguments", "--print", "--print-description"}
# Commands that tell of runs that died and left something behind. `clean` does it in its own way.
_ABOUT_RUNS = {
    *("launch", "run", "ps", "logs", "events", "start", "stop", "restart", "signal", "down", "attach"),
}
_WITH_A_VALUE = {"--prefix", "--name"}  # of `run`
_READING = {"check", "plan", "convert", "format", "explain"}  # commands that read files, and nothing else
_MANY = 100_000  # objects that may become garbage before somebody looks for it


def command() -> None:
    """Be the command: this process ends with it."""
    status = main()
    if sys.argv[1:] and sys.argv[1] in _READING:
        from orchestra.cli.leaving import end_untidied

        end_untidied(status)
    sys.exit(status)


@roomy  # whatever forks below has it, too
def main() -> int:
    """Carry out the command line and return the exit status."""
    install()
    words = sys.argv[1:]
    if _concerns_runs(words) and (status := _look_after_the_dead()):
        return status
    if starts_processes(words):
        from orchestra.cli.starting import started

        flags = _flags(words)
        return started(
            lambda stream: _prepare(words, stream),
            detach="--detach" in flags,
            wait_ready="--wait-ready" in flags,
            foresee=lambda: _foresee(words),
        )
    if words and words[0] in _READING:
        return _read(words)
    from orchestra.cli.main import main as command_line

    return command_line(words)


def _read(words: list[str]) -> int:
    """Carry out a command that reads files and ends: hardly anything that it makes is garbage before its end."""
    import gc

    # To look for some takes a tenth of the time that it takes to import what such a command needs ...
    gc.set_threshold(_MANY)
    from orchestra.cli.main import main as command_line

    status = command_line(words, heeding=True)
    gc.freeze()  # ... and at the end as long as to look at ten files.
    return status


def _foresee(words: list[str]) -> bool:
    """Tell whether the run is likely to have nodes in Python. The supervisor asks while the plan is being made."""
    from orchestra.cli.foresight import nodes_ahead

    return nodes_ahead(words)


def _concerns_runs(words: list[str]) -> bool:
    return bool(words) and words[0] in _ABOUT_RUNS and not {"-h", "--help"}.intersection(words)


def _look_after_the_dead() -> int:
    """Tell of runs that died and left something; there are none most of the time, and this costs next to nothing then.

    Returns another status than 0 where the user wants to go on no more.
    """
    from orchestra.supervise.runs.running import abandoned, state_path

    if not abandoned(f"{state_path()}/runs"):
        return 0
    from orchestra.cli.remains import look_after

    return look_after()


def starts_processes(words: list[str]) -> bool:
    """Tell whether the command line asks for a run.

    It only decides how early the keeper is forked: whatever it answers, the command does what its options say.
    """
    if not words or words[0] not in ("launch", "run"):
        return False
    return not any(map(_only_shows, _flags(words)))


def _flags(words: list[str]) -> list[str]:
    return words[1:] if words[0] == "launch" else _flags_of_run(words[1:])


def _only_shows(word: str) -> bool:
    """Recognise the flags after which nothing runs, short ones also among others: `-sn`."""
    if word.startswith("--"):
        return word in _ONLY_SHOWING
    return word.startswith("-") and not {"h", "s", "p"}.isdisjoint(word)


def _flags_of_run(words: list[str]) -> list[str]:
    """Return the words before the package: all that follows the executable is the node's."""
    flags: list[str] = []
    for word in words:
        if not word.startswith("-") and (not flags or flags[-1] not in _WITH_A_VALUE):
            break
        flags.append(word)
    return flags


def _prepare(words: list[str], stream: BinaryIO) -> int | Answer | Settled:
    """Write the plan to the stream: what the same command line came to before, where that is still so, else a new one.

    This is the resolver process.
    """
    if words[0] == "launch":
        from orchestra.cli.remembered import remembered

        found = remembered(words)
        if found is not None:
            sys.stderr.write(found.told)
            stream.write(found.document)
            return 0
    return _resolve(words, stream)


def _resolve(words: list[str], stream: BinaryIO) -> int | Answer | Settled:
    """Make the plan and write it to the stream. Only here heavy imports belong."""
    from orchestra.cli.main import prepare

    return prepare(words, stream)


if __name__ == "__main__":
    if vars(sys.modules["__main__"]) is globals():
        command()
    sys.exit(main())  # in the process of somebody else, who goes on: `runpy`
