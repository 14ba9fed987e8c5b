"""The command `orchestra`. It imports almost nothing before the first fork, so that the keeper of a run stays small."""

from __future__ import annotations

import sys

TYPE_CHECKING = False  # `typing` itself costs more than this module
if TYPE_CHECKING:
    from typing import BinaryIO

    from orchestra.supervise.serving import Answer

_ONLY_SHOWING = {"--help", "--show-args", "--show-arguments", "--print", "--print-description"}
_WITH_A_VALUE = {"--prefix", "--name"}  # of `run`


def main() -> int:
    """Carry out the command line and return the exit status."""
    words = sys.argv[1:]
    if starts_processes(words):
        from orchestra.control.entrance import afterwards, attend
        from orchestra.supervise.run import run

        return run(lambda stream: _prepare(words, stream), attend, afterwards)
    from orchestra.cli.main import main as command_line

    return command_line(words)


def starts_processes(words: list[str]) -> bool:
    """Tell whether the command line asks for a run.

    It only decides how early the keeper is forked: whatever it answers, the command does what its options say.
    """
    if not words or words[0] not in ("launch", "run"):
        return False
    flags = words[1:] if words[0] == "launch" else _flags_of_run(words[1:])
    return not any(map(_only_shows, flags))


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


def _prepare(words: list[str], stream: BinaryIO) -> int | Answer:
    """Make the plan and write it to the stream. This is the resolver process, where heavy imports belong."""
    from orchestra.cli.main import prepare

    return prepare(words, stream)


if __name__ == "__main__":
    sys.exit(main())
