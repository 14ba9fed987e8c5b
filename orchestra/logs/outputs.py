"""Which streams of a process reach the screen, by the words of the launch language.

The files always get everything: a run that went wrong must be readable afterwards. So the words decide about the screen
alone (upstream's `log`, its default, hides standard output there; ours is `both`).
"""

from __future__ import annotations

from typing import Final

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


def on_screen(output: str | None) -> frozenset[str]:
    """Return the streams that are shown. Raises `ValueError` for a word that the launch language does not have."""
    try:
        return _ON_SCREEN[output]
    except KeyError:
        raise ValueError(f"unknown output {output!r}") from None
