"""Parameters as written: values get their types."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from orchestra.description.parts import VALUE_TYPES, LateParam, Override
from orchestra.description.text import (
    Constant,
    Items,
    Template,
    span_of,
)
from orchestra.errors import Code
from orchestra.location import Span, is_python, point
from orchestra.nearest import nearest
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.model import (
    InlineParameter,
    ParameterSource,
    new_parameter,
    place_of,
)
from orchestra.resolve.paths import beside
from orchestra.resolve.plain_parameters import given_again, plainly, read_at_once
from orchestra.resolve.rcl.odd_names import may_be_odd, odd_name
from orchestra.resolve.rcl.surprises import of_commas
from orchestra.resolve.rcl.surprises import plainly as said_plainly
from orchestra.resolve.refusals import refuse_value
from orchestra.resolve.scalars import (
    checked,
    coerced,
    differs,
    upstream_value,
)
from orchestra.resolve.worded import look_at_paths
from orchestra.resolve.wrong_lists import meant_as_text, odd_in_text, odd_place, united, wrong_as_a_whole
from orchestra.resolve.yaml_scalars import QUOTE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.actions.set_parameter import SetParameter
    from orchestra.description.fields import Value as Typed
    from orchestra.description.parts import Param
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import ParameterValue

_BOOLEANS = ("true", "false")
_XML = (".xml", ".launch")
_AS_TEXT = "ParameterValue(..., value_type=str) keeps it a text"


def parameters(
    written: Sequence[Param], run: Resolution, *, component: bool = False, quotes: bool = True
) -> tuple[tuple[ParameterSource, ...], bool]:
    """Return the parameters of a node in order, and whether all of them are sound.

    A `component` takes files without sections too. Without `quotes`, a text in quotes is typed as any other.
    """
    if not written:
        return (), True
    found: list[ParameterSource] = []
    whole = True
    for param in written:
        kind = type(param)
        if kind is LateParam or param.from_ is None:
            everywhere = kind is Override
            plain = plainly(param, run, everywhere, quotes)
            if plain is not None:
                found.append(plain)
                continue
            items = _inline(param, (), run, everywhere=everywhere, quotes=quotes)
            found += [item for item in items if item is not None]
            whole = whole and None not in items
        elif param.faulty and beside(run.context.file, param.from_.raw) is None:
            whole = False  # it may be no parameter at all: a remap stands where one belongs
        elif (
            param.allow_substs is None
            and (known := given_again(param.from_, run, plain=component)) is not None
        ):
            found.append(known)
            whole = whole and known.sound
        else:
            substitute = param.allow_substs is not None and run.flag(param.allow_substs, default=False)
            # Here, because many plans have none.
            from orchestra.resolve.parameter_files import file_parameters  # noqa: PLC0415

            file = file_parameters(param.from_, run, substitute=substitute is True, plain=component)
            if file is not None and isinstance(substitute, bool):
                found.append(file)
            whole = whole and file is not None and file.sound and isinstance(substitute, bool)
    return tuple(found), whole


def everywhere(action: SetParameter, run: Resolution) -> list[InlineParameter | None]:
    """Return the parameters that an action sets for every node, None for each that is faulty."""
    return _inline(action, (), run, everywhere=True, quotes=False)


def typed(name: str, value: Typed | tuple[Typed, ...], run: Resolution) -> ParameterValue | Poison:
    """Return a value of a parameter with the type that it gets by its looks; one that can have none is reported."""
    return _typed(name, value, None, run, run.at(span_of(value) or point("")), quotes=True)


def _typed(
    name: str,
    value: Typed | tuple[Typed, ...],
    type_word: str | None,
    run: Resolution,
    at: Location,
    *,
    quotes: bool,
) -> ParameterValue | Poison:
    """Return a value with the type that upstream gives it; one that can have none is reported.

    Without `quotes`, a text in quotes is typed as any other.
    """
    if isinstance(value, tuple):
        return _list(name, value, type_word, run, at)
    if isinstance(value, Constant):
        return _constant(name, value, type_word, run)
    evaluated = run.evaluate(value)
    if not isinstance(evaluated, Value):
        return POISON
    return _text(name, value, evaluated, type_word, run, quotes=quotes)


def _text(
    name: str, value: Template, evaluated: Value, type_word: str | None, run: Resolution, *, quotes: bool
) -> ParameterValue | Poison:
    constant = value.constant
    if constant is None and evaluated.text[:1] == "/":
        look_at_paths((evaluated,), run)
    try:
        if type_word not in (None, "yaml"):
            return coerced(evaluated.text, str(type_word))
        if constant is not None and value.quoted and quotes:
            return evaluated.text
        kept = constant is not None and quotes and value.span.file.endswith(_XML)
        result = _attribute_value(evaluated.text) if kept else upstream_value(evaluated.text)
    except ValueError as error:
        meant = nearest(evaluated.text, _BOOLEANS) if type_word == "bool" else None
        if meant is not None and not is_python(evaluated.location):
            return refuse_value(evaluated, run.problems, Code.PARAMETER_TYPE, str(error), meant=meant)
        odd = odd_in_text(value, type_word) if constant is not None else None
        if odd is not None and not is_python(evaluated.location):
            return _refuse(name, error, run.at(odd[0]), run, odd[1])
        plain = constant is not None and evaluated.verbatim and type_word in (None, "yaml")
        instead = meant_as_text(evaluated.text) if plain else None
        return _refuse(name, error, evaluated.location, run, instead)
    if constant is not None:
        _warn_of_surprise(constant, result, evaluated.location, run, quotes=quotes)
    return result


def _attribute_value(text: str) -> ParameterValue:
    # Here, because nearly all attributes are read alike by everybody.
    from orchestra.resolve.attribute_values import attribute_value  # noqa: PLC0415

    return attribute_value(text)


def _inline(
    param: Param | SetParameter,
    above: tuple[tuple[str, Location], ...],
    run: Resolution,
    *,
    everywhere: bool,
    quotes: bool,
) -> list[InlineParameter | None]:
    assert param.name is not None  # noqa: S101 - the model demands it where there is no file
    own = run.text(param.name)
    if not isinstance(own, str):
        return [None]
    if not own:
        message = "the name of a parameter must not be empty"
        run.problems.error(Code.BAD_NAME, message, run.at(param.name.span))
        return [None]
    if may_be_odd(own) and not above and not is_python(param.span):
        _warn_of_name(own, param.name, run)
    name = f"{above[-1][0]}.{own}" if above else own
    keys = (*above, (name, run.place(param.name)))
    if param.param is not None:
        below = partial(_inline, above=keys, run=run, everywhere=everywhere, quotes=quotes)
        return [item for nested in param.param for item in below(nested)]
    if param.value is None:
        return [None]
    type_word = None if param.type is None else run.word(param.type, VALUE_TYPES)
    if isinstance(type_word, Poison):
        return [None]
    written = param.value
    at = place_of(written, param, run.context.included_from)
    plain = read_at_once(param, quotes)
    if plain is not None:
        at_items = tuple(map(run.place, written)) if isinstance(written, Items) else ()
        return [new_parameter(name, plain, at, everywhere, keys, at_items, ())]
    with run.scope.tracing() as reads:
        value = _typed(name, written, type_word, run, at, quotes=quotes)
    if isinstance(value, Poison):
        return [None]
    if everywhere and not quotes and type_word is None and isinstance(written, Constant):
        from orchestra.resolve.attribute_values import retyped  # noqa: PLC0415 - few Python files say anything for all

        value = retyped(value, at, run.problems)
    places = tuple(run.at(item.span) for item in written) if isinstance(written, tuple) else ()
    return [new_parameter(name, value, at, everywhere, keys, places, tuple(reads))]


def _warn_of_name(name: str, written: Template, run: Resolution) -> None:
    """Tell of a name that no node declares."""
    found = odd_name(name) if written.constant is not None else None
    if found is not None:
        message = f"no node declares '{name}': {found[0]}"
        run.problems.warning(Code.SURPRISING_SCALAR, message, run.place(written), suggestion=found[1])


def _constant(name: str, value: Constant, type_word: str | None, run: Resolution) -> ParameterValue | Poison:
    try:
        return checked(value.value, type_word)
    except ValueError as error:
        return _refuse(name, error, run.at(value.span), run)


def _whole_span_of(value: tuple[Typed, ...]) -> Span | None:
    """Return the place to point at for a list: all of one on one line, else what it begins with."""
    if not isinstance(value, Items):
        return span_of(value)
    span = value.span
    if span.line == span.end_line:
        return span
    return Span(span.file, span.line, span.column, span.line, span.column + 1)


def _list(
    name: str, items: tuple[Typed, ...], type_word: str | None, run: Resolution, at: Location
) -> ParameterValue | Poison:
    element = type_word.removeprefix("list_of_") if type_word is not None else None
    if element == type_word and element not in (None, "yaml"):
        return _refuse(name, f"a list is no {element}", at, run)
    whole = None if element is None or len(items) <= 1 else wrong_as_a_whole(items, element)
    if whole is not None:
        return _refuse(name, whole, run.at(_whole_span_of(items) or at.span), run)
    texts: list[str] = []
    values: list[ParameterValue] = []
    for item in items:
        evaluated = item.value if isinstance(item, Constant) else run.evaluate(item)
        if isinstance(item, Constant):
            value = _constant(name, item, element, run)
        elif isinstance(evaluated, Value):
            value = _text(name, item, evaluated, element, run, quotes=True)
            texts.append(evaluated.text)
        else:
            value = POISON
        if not isinstance(value, Poison):
            values.append(value)
    if len(values) < len(items):
        return POISON
    try:
        return united(items, values, texts, run)
    except ValueError as error:
        odd = odd_place(items, values)
        place, instead = (at, None) if odd is None else (run.at(odd[0]), odd[1])
        return _refuse(name, error, place, run, instead)


def _refuse(
    name: str, reason: object, location: Location, run: Resolution, suggestion: str | None = None
) -> Poison:
    """Report a value that no parameter can have. In Python its place is often that of the whole node: it is named."""
    told = str(reason)
    if is_python(location):
        told = told.removesuffix(QUOTE).removesuffix(": ")
        notes = (_AS_TEXT,) if len(told) < len(str(reason)) else ()
        run.problems.error(Code.PARAMETER_TYPE, f"parameter '{name}': {told}", location, notes=notes)
    else:
        run.problems.error(Code.PARAMETER_TYPE, told, location, suggestion=suggestion)
    return POISON


def _warn_of_surprise(
    text: str, value: ParameterValue, location: Location, run: Resolution, *, quotes: bool
) -> None:
    surprise = differs(text)
    if surprise is not None:
        quote = "'" if location.span.file.endswith(_XML) else '"'  # an attribute stands in quotes itself
        instead = None if is_python(location) else said_plainly(text, value, quote if quotes else None)
        run.problems.warning(Code.SURPRISING_SCALAR, surprise, location, suggestion=instead)
    elif isinstance(value, str) and not is_python(location) and (found := of_commas(text)) is not None:
        run.problems.warning(Code.SURPRISING_SCALAR, found.message, location, suggestion=found.instead)
