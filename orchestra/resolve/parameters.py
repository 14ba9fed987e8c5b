"""Parameters as written: values get their types, files are read as rcl reads them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.description.parts import VALUE_TYPES
from orchestra.description.text import Constant, span_of
from orchestra.errors import Code, Problems
from orchestra.location import displayed
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.model import FileParameters, InlineParameter, ParameterSource
from orchestra.resolve.paths import existing_file
from orchestra.resolve.rcl.files import read_parameter_file
from orchestra.resolve.scalars import checked, coerced, differs, unified, upstream_value
from orchestra.resolve.substituted import Back, placed_back, substituted

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.fields import Value as Typed
    from orchestra.description.parts import Param
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import ParameterValue


def parameters(written: Sequence[Param], run: Resolution) -> tuple[tuple[ParameterSource, ...], bool]:
    """Return the parameters of a node in order, and whether all of them are sound."""
    found: list[ParameterSource | None] = []
    for param in written:
        if param.from_ is not None:
            found.append(_file(param, run))
        else:
            found += _inline(param, "", run)
    sound = tuple(item for item in found if item is not None)
    return sound, len(sound) == len(found)


def typed(
    value: Typed | tuple[Typed, ...], type_word: str | None, run: Resolution
) -> ParameterValue | Poison:
    """Return a value with the type that upstream gives it; one that can have none is reported."""
    if isinstance(value, tuple):
        return _list(value, type_word, run)
    if isinstance(value, Constant):
        return _constant(value, type_word, run)
    evaluated = run.evaluate(value)
    if not isinstance(evaluated, Value):
        return POISON
    constant = value.constant
    try:
        if type_word not in (None, "yaml"):
            return coerced(evaluated.text, str(type_word))
        if constant is not None and value.quoted:
            return evaluated.text
        result = upstream_value(evaluated.text)
    except ValueError as error:
        run.problems.error(Code.PARAMETER_TYPE, str(error), evaluated.location)
        return POISON
    if constant is not None:
        _warn_of_surprise(constant, evaluated.location, run)
    return result


def read_file(
    path: str, location: Location, run: Resolution, *, substitute: bool = False
) -> FileParameters | None:
    """Return the sections of a parameter file, None where it cannot be read (which has been reported).

    With `substitute`, `$(...)` in it is evaluated.
    """
    text = _text(path, location, run)
    if text is None:
        return None
    file, chain = displayed(path), (location.span, *location.included_from)
    back: Back | None = None
    if substitute:
        evaluated = substituted(text, file, replace(run.context, included_from=chain))
        if evaluated is None:
            return None
        text, back = evaluated
    found = Problems()
    sections = read_parameter_file(text, file, found, chain)
    for problem in found:
        span = back(problem.span) if back is not None and problem.span is not None else problem.span
        run.problems.report(replace(problem, span=span))
    if found.errors:
        return None
    if back is not None:
        sections = tuple(placed_back(section, back) for section in sections)
    return FileParameters(path, sections, location)


def _inline(param: Param, above: str, run: Resolution) -> list[InlineParameter | None]:
    assert param.name is not None  # noqa: S101 - the model demands it where there is no file
    name = run.text(param.name)
    if not isinstance(name, str):
        return [None]
    if param.param is not None:
        return [item for nested in param.param for item in _inline(nested, f"{above}{name}.", run)]
    if param.value is None:
        return [None]
    type_word = run.word(param.type, VALUE_TYPES)
    value = POISON if isinstance(type_word, Poison) else typed(param.value, type_word, run)
    if isinstance(value, Poison):
        return [None]
    return [InlineParameter(above + name, value, run.at(span_of(param.value) or param.span))]


def _constant(value: Constant, type_word: str | None, run: Resolution) -> ParameterValue | Poison:
    try:
        return checked(value.value, type_word)
    except ValueError as error:
        run.problems.error(Code.PARAMETER_TYPE, str(error), run.at(value.span))
        return POISON


def _list(items: tuple[Typed, ...], type_word: str | None, run: Resolution) -> ParameterValue | Poison:
    element = type_word.removeprefix("list_of_") if type_word is not None else None
    values = [typed(item, element, run) for item in items]
    sound = [value for value in values if not isinstance(value, Poison)]
    if len(sound) < len(values):
        return POISON
    try:
        return unified(sound)
    except ValueError as error:
        at = run.at(items[0].span) if items else None
        run.problems.error(Code.PARAMETER_TYPE, str(error), at)
        return POISON


def _warn_of_surprise(text: str, location: Location, run: Resolution) -> None:
    surprise = differs(text)
    if surprise is not None:
        run.problems.warning(Code.SURPRISING_SCALAR, surprise, location)


def _file(param: Param, run: Resolution) -> FileParameters | None:
    value, substitute = run.evaluate(param.from_), run.flag(param.allow_substs, default=False)
    if not isinstance(value, Value) or param.from_ is None or isinstance(substitute, Poison):
        return None
    path = existing_file(value, param.from_, "parameter file", run)
    if path is None:
        return None
    if substitute:
        return read_file(path, value.location, run, substitute=True)
    if path not in run.parameter_files:
        run.parameter_files[path] = read_file(path, value.location, run)
    known = run.parameter_files[path]
    return None if known is None else replace(known, location=value.location)


def _text(path: str, location: Location, run: Resolution) -> str | None:
    try:
        return Path(path).read_bytes().decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        message = f"cannot read the parameter file {displayed(path)}: {error}"
        run.problems.error(Code.UNREADABLE_FILE, message, location)
        return None
