"""Parameters as written: values get their types, files are read as rcl reads them."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.description.parts import VALUE_TYPES, Override
from orchestra.description.text import Constant, span_of
from orchestra.errors import Code, Problems
from orchestra.location import displayed
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.model import FileParameters, InlineParameter, ParameterSource
from orchestra.resolve.paths import existing_file
from orchestra.resolve.rcl.files import read_parameter_file, read_plain_file
from orchestra.resolve.rcl.overrides import override_value
from orchestra.resolve.rcl.reader import SECTION_KEY
from orchestra.resolve.scalars import checked, coerced, described, differs, unified, upstream_value
from orchestra.resolve.substituted import Back, placed_back, substituted

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.actions.set_parameter import SetParameter
    from orchestra.description.fields import Value as Typed
    from orchestra.description.parts import Param
    from orchestra.description.text import Template
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import ParameterValue


def parameters(
    written: Sequence[Param], run: Resolution, *, component: bool = False
) -> tuple[tuple[ParameterSource, ...], bool]:
    """Return the parameters of a node in order, and whether all of them are sound.

    A `component` takes files without sections too.
    """
    found: list[ParameterSource | None] = []
    for param in written:
        if param.from_ is not None:
            substitute = run.flag(param.allow_substs, default=False)
            sound_flag = isinstance(substitute, bool)
            file = file_parameters(param.from_, run, substitute=substitute is True, plain=component)
            found.append(file if sound_flag else None)
        else:
            found += _inline(param, "", run, everywhere=isinstance(param, Override))
    sound = tuple(item for item in found if item is not None)
    return sound, len(sound) == len(found)


def everywhere(action: SetParameter, run: Resolution) -> list[InlineParameter | None]:
    """Return the parameters that an action sets for every node, None for each that is faulty."""
    return _inline(action, "", run, everywhere=True, bare=True)


def file_parameters(
    written: Template,
    run: Resolution,
    *,
    substitute: bool = False,
    everywhere: bool = False,
    plain: bool = False,
) -> FileParameters | None:
    """Return what a parameter file holds, None where it cannot be found or read (which has been reported).

    With `substitute`, `$(...)` in it is evaluated; with `plain`, it may be one without sections.
    """
    value = run.evaluate(written)
    if not isinstance(value, Value):
        return None
    path = existing_file(value, written, "parameter file", run)
    if path is None:
        return None
    if substitute or plain:
        file = read_file(path, value.location, run, substitute=substitute, plain=plain)
    else:
        if path not in run.parameter_files:
            run.parameter_files[path] = read_file(path, value.location, run)
        file = run.parameter_files[path]
    return None if file is None else replace(file, location=value.location, everywhere=everywhere)


def typed(
    value: Typed | tuple[Typed, ...], type_word: str | None, run: Resolution, *, bare: bool = False
) -> ParameterValue | Poison:
    """Return a value with the type that upstream gives it; one that can have none is reported.

    `bare`: upstream hands it over on the command line, where the quotes are gone.
    """
    if isinstance(value, tuple):
        return _list(value, type_word, run)
    if isinstance(value, Constant):
        return _constant(value, type_word, run, bare=bare)
    evaluated = run.evaluate(value)
    if not isinstance(evaluated, Value):
        return POISON
    constant = value.constant
    try:
        if type_word not in (None, "yaml"):
            return coerced(evaluated.text, str(type_word))
        if constant is not None and value.quoted and not bare:
            return evaluated.text
        result = upstream_value(evaluated.text)
    except ValueError as error:
        run.problems.error(Code.PARAMETER_TYPE, str(error), evaluated.location)
        return POISON
    if constant is not None:
        _warn_of_surprise(constant, evaluated.location, run)
    return result


def read_file(
    path: str, location: Location, run: Resolution, *, substitute: bool = False, plain: bool = False
) -> FileParameters | None:
    """Return the sections of a parameter file, None where it cannot be read (which has been reported).

    With `substitute`, `$(...)` in it is evaluated; with `plain`, it may be one without sections.
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
    bare = plain and SECTION_KEY not in text
    sections = (read_plain_file if bare else read_parameter_file)(text, file, found, chain)
    for problem in found:
        span = back(problem.span) if back is not None and problem.span is not None else problem.span
        run.problems.report(replace(problem, span=span))
    if found.errors:
        return None
    if back is not None:
        sections = tuple(placed_back(section, back) for section in sections)
    if bare:
        return FileParameters(
            path, (), location, plain=tuple(item for part in sections for item in part.entries)
        )
    return FileParameters(path, sections, location)


def _inline(
    param: Param | SetParameter, above: str, run: Resolution, *, everywhere: bool, bare: bool = False
) -> list[InlineParameter | None]:
    assert param.name is not None  # noqa: S101 - the model demands it where there is no file
    name = run.text(param.name)
    if not isinstance(name, str):
        return [None]
    if param.param is not None:
        below = partial(_inline, above=f"{above}{name}.", run=run, everywhere=everywhere, bare=bare)
        return [item for nested in param.param for item in below(nested)]
    if param.value is None:
        return [None]
    type_word = run.word(param.type, VALUE_TYPES)
    value = POISON if isinstance(type_word, Poison) else typed(param.value, type_word, run, bare=bare)
    if isinstance(value, Poison):
        return [None]
    at = run.at(span_of(param.value) or param.span)
    return [InlineParameter(above + name, value, at, everywhere)]


def _constant(
    value: Constant, type_word: str | None, run: Resolution, *, bare: bool
) -> ParameterValue | Poison:
    try:
        if bare and type_word is None and isinstance(value.value, str):
            return _retyped(value.value, run.at(value.span), run)
        return checked(value.value, type_word)
    except ValueError as error:
        run.problems.error(Code.PARAMETER_TYPE, str(error), run.at(value.span))
        return POISON


def _retyped(text: str, location: Location, run: Resolution) -> ParameterValue:
    """Return what rcl makes of a text behind `-p`; what it does not take there, as an empty one, stays a text."""
    try:
        value = override_value(text)
    except ValueError:
        return text
    if value is None or value == text:
        return text
    message = f"'{text}' is read as {described(value)}, as ROS 2 does with a text for all nodes"
    run.problems.warning(Code.SURPRISING_SCALAR, message, location)
    return value


def _list(items: tuple[Typed, ...], type_word: str | None, run: Resolution) -> ParameterValue | Poison:
    at = run.at(items[0].span) if items else None
    element = type_word.removeprefix("list_of_") if type_word is not None else None
    if element == type_word and element not in (None, "yaml"):
        run.problems.error(Code.PARAMETER_TYPE, f"a list is no {element}", at)
        return POISON
    values = [typed(item, element, run) for item in items]
    sound = [value for value in values if not isinstance(value, Poison)]
    if len(sound) < len(values):
        return POISON
    try:
        return unified(sound)
    except ValueError as error:
        run.problems.error(Code.PARAMETER_TYPE, str(error), at)
        return POISON


def _warn_of_surprise(text: str, location: Location, run: Resolution) -> None:
    surprise = differs(text)
    if surprise is not None:
        run.problems.warning(Code.SURPRISING_SCALAR, surprise, location)


def _text(path: str, location: Location, run: Resolution) -> str | None:
    try:
        return Path(path).read_bytes().decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        message = f"cannot read the parameter file {displayed(path)}: {error}"
        run.problems.error(Code.UNREADABLE_FILE, message, location)
        return None
