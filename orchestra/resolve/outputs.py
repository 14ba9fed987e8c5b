"""Where the output of a process goes: a word, or places by stream where no word says the same."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.description.outputs import OUTPUTS, PLACES, STREAMS
from orchestra.description.text import MatchedTemplate, Template
from orchestra.errors import Code
from orchestra.resolve.context import POISON, Poison

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution

    Places: TypeAlias = dict[str, tuple[str, ...]]

_OVERRIDE: Final = "OVERRIDE_LAUNCH_PROCESS_OUTPUT"
# What each word stands for (launch, `get_output_loggers`): screen and log by stream, the files of its own apart.
_WORDS: Final[Mapping[str, Places]] = {
    "screen": {"both": ("screen",)},
    "log": {"stdout": ("log",), "stderr": ("screen", "log")},
    "both": {"both": ("screen", "log")},
    "own_log": {"stdout": ("own_log",), "stderr": ("own_log",), "both": ("own_log",)},
    "full": {"stdout": ("own_log",), "stderr": ("own_log",), "both": ("screen", "log", "own_log")},
}


def output(
    written: Template | Mapping[str, tuple[Template, ...]] | None, run: Resolution, at: Location
) -> str | Places | Poison | None:
    """Return where the output goes, None where nothing is said; `at` is the place of the process.

    As upstream, a variable of the caller's environment can say it for all processes.
    """
    everywhere = run.inputs.environment.get(_OVERRIDE)
    if everywhere:
        return _overridden(everywhere, run, at)
    if written is None:
        return None
    if type(written) is MatchedTemplate and written.constant in OUTPUTS:
        return written.constant
    if isinstance(written, Template):
        return run.word(written, OUTPUTS)
    places: Places = {}
    for stream in STREAMS:
        words = [run.word(item, PLACES) for item in written.get(stream, ())]
        if any(isinstance(word, Poison) for word in words):
            return POISON
        if words:
            places[stream] = tuple(place for place in PLACES if place in words)
    return next((word for word, meaning in _WORDS.items() if _routes(meaning) == _routes(places)), places)


def _overridden(word: str, run: Resolution, at: Location) -> str | Poison:
    if word in OUTPUTS:
        return word
    message = f"{_OVERRIDE} is one of {', '.join(OUTPUTS)}, not '{word}'"
    run.problems.error(Code.BAD_VALUE, message, at)
    return POISON


def _routes(places: Places) -> set[tuple[str, str]]:
    """Return what goes where: `both` is another word for two streams, but for the file that holds both."""
    routes = set()
    for stream, targets in places.items():
        for place in targets:
            apart = place == "own_log" or stream != "both"
            routes |= {(stream, place)} if apart else {("stdout", place), ("stderr", place)}
    return routes
