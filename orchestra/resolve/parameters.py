"""Parameters as written: values get their types, files are read as rcl reads them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.description.parts import VALUE_TYPES
from orchestra.errors import Code
from orchestra.load.grammar import parse_template
from orchestra.load.offsets import source
from orchestra.location import displayed
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.evaluate import evaluate
from orchestra.resolve.model import FileParameters, InlineParameter, ParameterSource
from orchestra.resolve.paths import existing_file
from orchestra.resolve.rcl.files import read_parameter_file
from orchestra.resolve.scalars import coerced, differs, unified, upstream_value

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.parts import Param
    from orchestra.description.text import Template
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
    value: Template | tuple[Template, ...], type_word: str | None, run: Resolution
) -> ParameterValue | Poison:
    """Return a value with the type that upstream gives it; one that can have none is reported."""
    if isinstance(value, tuple):
        return _list(value, type_word, run)
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


def read_file(path: str, location: Location, run: Resolution) -> FileParameters | None:
    """Return the sections of a parameter file, None where it cannot be read (which has been reported)."""
    text = _text(path, location, run)
    if text is None:
        return None
    before = len(run.problems.errors)
    chain = (location.span, *location.included_from)
    sections = read_parameter_file(text, displayed(path), run.problems, chain)
    return None if len(run.problems.errors) > before else FileParameters(path, sections, location)


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
    first = param.value[0] if isinstance(param.value, tuple) else param.value
    return [InlineParameter(above + name, value, run.at(first.span))]


def _list(items: tuple[Template, ...], type_word: str | None, run: Resolution) -> ParameterValue | Poison:
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
        return _substituted(path, value.location, run)
    if path not in run.parameter_files:
        run.parameter_files[path] = read_file(path, value.location, run)
    return run.parameter_files[path]


def _substituted(path: str, location: Location, run: Resolution) -> FileParameters | None:
    """Read a file in which `$(...)` is evaluated; places in it are those of the text that this gives."""
    text = _text(path, location, run)
    if text is None:
        return None
    file = displayed(path)
    before = len(run.problems.errors)
    template = parse_template(text, source(file, text).span, run.problems)
    value = evaluate(template, run.context)
    if not isinstance(value, Value):
        return None
    chain = (location.span, *location.included_from)
    sections = read_parameter_file(value.text, file, run.problems, chain)
    return None if len(run.problems.errors) > before else FileParameters(path, sections, location)


def _text(path: str, location: Location, run: Resolution) -> str | None:
    try:
        return Path(path).read_bytes().decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        message = f"cannot read the parameter file {displayed(path)}: {error}"
        run.problems.error(Code.UNREADABLE_FILE, message, location)
        return None
