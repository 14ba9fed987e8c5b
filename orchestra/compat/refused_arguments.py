"""Makes an object without the arguments that are wrong, which are reported: all of them, not only the first.

A keyword that is a slip is taken for the one that was meant. An object that cannot be made without what was wrong is
lost: code that uses it stops in silence, as its fault has been told.
"""

from __future__ import annotations

import sysconfig
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.faulty_call import FaultyCall
from orchestra.compat.place import Place, here, is_own
from orchestra.compat.syntax_trees import Tree, is_dealt_with
from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from types import FrameType

    from orchestra.errors import Problems
    from orchestra.location import Span

_PYTHON: Final = sysconfig.get_path("stdlib")
_MOST: Final = 20  # wrong values of one call that are told
_MOST_CALLS: Final = 8
_SETTING: Final = (
    "AppendEnvironmentVariable",
    "DeclareLaunchArgument",
    "Set",
)  # what sets something by its name
_DEPTH: Final = 4


def settled(
    made: Any,
    constructor: Callable[..., None],
    given: tuple[tuple[Any, ...], Mapping[str, Any]],
    error: Exception,
    caller: FrameType,
    problems: Problems,
    chain: tuple[Span, ...],
) -> bool:
    """Report what is wrong with a call, and make the object without it; return whether the error is dealt with so."""
    if is_dealt_with(caller, Tree.catches) or _is_of_users(error):
        return False
    places = list(_calls(caller))
    call = FaultyCall(made, constructor, given, places, here(made))
    is_made, fault = False, error
    for _ in range(_MOST):
        if not call.explain(fault) or call.is_lost:
            break
        try:
            constructor(made, *call.words, **call.named)
        except Exception as again:  # noqa: BLE001 - the next thing that is wrong with it
            _part(again, error)
            fault = again
        else:
            is_made = True
            break
    if not call.told and not call.found and not call.is_lost:
        return False
    if is_made:
        made._refused = True
    else:
        vars(made)["_lost"] = tuple(_entities(call.content))
        vars(made)["_lost_name"] = (
            call.named.get("name") if type(made).__name__.startswith(_SETTING) else None
        )
        made._give_up()
    way = dict.fromkeys(f"called at {place.span}" for place in places)
    notes = tuple(way)[1 : _MOST_CALLS + 1]
    for problem in call.found:
        problems.report(replace(problem, included_from=chain, notes=(*problem.notes, *notes)))
    return True


def _part(error: BaseException, first: BaseException) -> None:
    """Take the first error out of what led to another one: it is being handled meanwhile, and no reason for it."""
    reason: BaseException | None = error
    while reason is not None:
        if reason.__context__ is first:
            reason.__context__ = None
        reason = reason.__context__


def _entities(given: Any, depth: int = 0) -> Iterator[Any]:
    """Yield the entities among what a call was given: what is wrong with them is told without it."""
    if callable(getattr(type(given), "visit", None)):
        yield given
    elif "_lost" in getattr(given, "__dict__", {}):
        yield from given._lost
    elif isinstance(given, list | tuple) and depth < _DEPTH:
        for item in given:
            yield from _entities(item, depth + 1)


def _calls(frame: FrameType) -> Iterator[Place]:
    """Yield the user's lines on the way to a call, innermost first, as far as the code of ours that has called it."""
    around: FrameType | None = frame
    while around is not None and not is_own(around.f_code.co_filename):
        if not around.f_code.co_filename.startswith(("<", _PYTHON)):
            yield Place(around.f_code, around.f_lasti)
        around = around.f_back


def _is_of_users(error: Exception) -> bool:
    """Return whether code of users has raised this, that ours has called."""
    traceback = error.__traceback__
    while traceback is not None:
        file = traceback.tb_frame.f_code.co_filename
        if not is_own(file) and not file.startswith(("<", _PYTHON)):
            return True
        traceback = traceback.tb_next
    return False
