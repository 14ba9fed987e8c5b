"""Which of the values that a call was given is the one that was refused: found by what our code held when it raised."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.place import Key, is_own
from orchestra.compat.wrong import WrongValue

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from types import FrameType

    from orchestra.compat.place import Step

_DEPTH: Final = 8
# Arguments of which each item stands for itself: others are texts that are joined.
_SEVERAL: Final = (
    *("actions", "additional_env", "arguments", "choices", "composable_node_descriptions", "env"),
    *("extra_arguments", "initial_entities", "launch_arguments", "launch_configurations", "parameters"),
    *("remappings", "ros_arguments"),
)
_View: Final[type[Any]] = type({}.items())
_VIEWS: Final = (_View, list, tuple)
_NOTHING: Final = object()
_CONTAINERS: Final = (list, tuple, dict)


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
            inside = next(_places(value, given, around), None) if isinstance(value, _CONTAINERS) else None
            if inside is not None:
                around, held = inside, [value]
            else:
                held.append(value)
    if isinstance(error, WrongValue):
        held.append(error.value)
    for value in reversed(held):
        for path in _places(value, given, around):
            if path and path not in told:
                return path
    return None


def without(given: Mapping[str, Any], paths: Iterable[tuple[Step, ...]]) -> dict[str, Any]:
    """Return what was given without the values at some places.

    An entry of a dictionary goes with all that is in it, and so does a tuple; what is empty then goes too.
    """
    cuts = {_cut(path, given) for path in paths if path}
    kept = {name: _left(value, (name,), cuts) for name, value in given.items()}
    return {name: value for name, value in kept.items() if value is not _NOTHING}


def value_at(path: tuple[Step, ...], given: Mapping[str, Any]) -> Any:
    """Return the value that stands at a place, None where that is a key or nothing stands there."""
    value: Any = given.get(str(path[0]))
    try:
        for step in path[1:]:
            value = None if isinstance(step, Key) else _at(value, step)
    except (IndexError, TypeError, ValueError):
        return None
    return value


def _cut(path: tuple[Step, ...], given: Mapping[str, Any]) -> tuple[Step, ...]:
    """Return the place of the smallest thing that can be left out to have a value left out."""
    value: Any = given[str(path[0])]
    if path[0] not in _SEVERAL:
        return path[:1]
    found = path[:2]
    for index, step in enumerate(path[1:], start=2):
        if isinstance(value, Mapping | _View):
            found = (*path[: index - 1], int(step))
        value = _at(value, step)
    return found


def _at(value: Any, step: Step) -> Any:
    if isinstance(value, Mapping):
        return list(value.values())[int(step)]
    return list(value)[int(step)] if isinstance(value, list | tuple | _View) else None


def _left(value: Any, path: tuple[Step, ...], cuts: set[tuple[Step, ...]]) -> Any:
    """Return what is left of a value at a place."""
    if path in cuts:
        return _NOTHING
    if not any(cut[: len(path)] == path for cut in cuts):
        return value
    if isinstance(value, Mapping | _View):
        pairs = list(value.items() if isinstance(value, Mapping) else value)
        kept = [(name, _left(item, (*path, index), cuts)) for index, (name, item) in enumerate(pairs)]
        return {name: item for name, item in kept if item is not _NOTHING} or _NOTHING
    items = [_left(item, (*path, index), cuts) for index, item in enumerate(value)]
    if isinstance(value, tuple) and _NOTHING in items:
        return _NOTHING
    return [item for item in items if item is not _NOTHING] or _NOTHING


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
