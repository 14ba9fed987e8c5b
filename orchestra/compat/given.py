"""Which of the values that a call was given is the one that was refused: found by what our code held when it raised."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.place import Key, is_own
from orchestra.compat.wrong import WrongValue

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

    from orchestra.compat.place import Step

_DEPTH: Final = 8
_VIEWS: Final = (type({}.items()), list, tuple)
_ATOMS: Final = (str, bytes, int, float, type(None))


def path_of(
    error: BaseException, given: Mapping[str, Any], told: set[tuple[Step, ...]]
) -> tuple[Step, ...] | None:
    """Return where the value that an error is about stands among those that were given by name.

    Those at places that are `told` already are left out. None where it is none of them.
    """
    if isinstance(error, WrongValue) and error.path:
        return error.path
    around: tuple[Step, ...] = ()
    held: list[Any] = []
    for frame in _frames(error):
        for value in _arguments(frame):
            if isinstance(value, _ATOMS):
                held.append(value)
                continue
            inside = next(_places(value, given, around), None)
            if inside is not None:
                around, held = inside, [value]
    if isinstance(error, WrongValue):
        held.append(error.value)
    for value in reversed(held):
        for path in _places(value, given, around):
            if path and path not in told:
                return path
    return None


def without(given: Mapping[str, Any], path: tuple[Step, ...]) -> dict[str, Any]:
    """Return what was given without the value at a place; of a tuple nothing can be left out but all of it."""
    changed = dict(given)
    rest = _left(changed[str(path[0])], path[1:])
    if rest is None:
        del changed[str(path[0])]
    else:
        changed[str(path[0])] = rest
    return changed


def _left(value: Any, path: tuple[Step, ...]) -> Any:
    """Return a value without what stands at a path in it; None where nothing of it can be left."""
    if not path or not isinstance(value, list | Mapping | type({}.items())):
        return None
    step, items = int(path[0]), list(value.items() if isinstance(value, Mapping) else value)
    if isinstance(value, list):
        inner = _left(items[step], path[1:])
    else:
        name, item = items[step]
        inner = None if isinstance(path[0], Key) else _left(item, path[1:])
        inner = None if inner is None else (name, inner)
    items[step : step + 1] = [] if inner is None else [inner]
    return items if isinstance(value, list) else dict(items)


def _frames(error: BaseException) -> Iterator[FrameType]:
    """Yield the frames of our code on the way to where something was first found wrong, outermost first."""
    first = error
    while first.__context__ is not None and first.__context__.__traceback__ is not None:
        first = first.__context__
    for raised in (error,) if first is error else (error, first):
        traceback = raised.__traceback__
        while traceback is not None:
            if (
                is_own(traceback.tb_frame.f_code.co_filename)
                and traceback.tb_frame.f_code.co_name != "__init__"
            ):
                yield traceback.tb_frame
            traceback = traceback.tb_next


def _arguments(frame: FrameType) -> Iterator[Any]:
    """Yield the values of a function's arguments, the last one first."""
    code = frame.f_code
    names = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
    yield from (frame.f_locals[name] for name in reversed(names) if name in frame.f_locals)


def _places(value: Any, given: Mapping[str, Any], below: tuple[Step, ...] = ()) -> Iterator[tuple[Step, ...]]:
    """Yield the places of this very object, those that are below another one."""
    for name, item in given.items():
        if not below or name == below[0]:
            for path in _inside(value, item, (name,)):
                if path[: len(below)] == below:
                    yield path


def _inside(value: Any, item: Any, path: tuple[Step, ...]) -> Iterator[tuple[Step, ...]]:
    if item is value:
        yield path
    if len(path) > _DEPTH:
        return
    if isinstance(item, Mapping):
        for index, (key, inner) in enumerate(item.items()):
            if key is value:
                yield (*path, Key(index))
            yield from _inside(value, inner, (*path, index))
    elif isinstance(item, _VIEWS):
        for index, inner in enumerate(item):
            yield from _inside(value, inner, (*path, index))
