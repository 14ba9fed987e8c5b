"""Which streams of a process reach the screen, by the words of the launch language.

The files always get everything: a run that went wrong must be readable afterwards. So the words, or the places given
for each stream, decide about the screen alone (upstream's `log`, its default, hides standard output there; ours is
`both`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Mapping

STDOUT: Final = "stdout"
STDERR: Final = "stderr"

_ON_SCREEN: dict[str | None, frozenset[str]] = {
    None: frozenset({STDOUT, STDERR}),
    "screen": frozenset({STDOUT, STDERR}),
    "both": frozenset({STDOUT, STDERR}),
    "full": frozenset({STDOUT, STDERR}),
    "log": frozenset({STDERR}),
    "own_log": frozenset(),
}


# Upstream's variable: replaces the output of every process, by a word.
OVERRIDE: Final = "OVERRIDE_LAUNCH_PROCESS_OUTPUT"

Output: TypeAlias = str | dict[str, tuple[str, ...]] | None


def on_screen(output: Output) -> frozenset[str]:
    """Return the streams that are shown: a stream without places is shown nowhere.

    Raises `ValueError` for a word that the launch language does not have.
    """
    if isinstance(output, dict):
        for_both = output.get("both", ())
        return frozenset(
            stream for stream in (STDOUT, STDERR) if "screen" in (*output.get(stream, ()), *for_both)
        )
    try:
        return _ON_SCREEN[output]
    except KeyError:
        raise ValueError(f"unknown output {output!r}") from None


def forced_output(environment: Mapping[str, str], *, show_all: bool) -> str | None:
    """Return the word that counts for every process, whatever its description says; None where none does.

    Raises `ValueError` for a word that the launch language does not have.
    """
    if show_all:
        return "both"
    word = environment.get(OVERRIDE) or None
    on_screen(word)
    return word
