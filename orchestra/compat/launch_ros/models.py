"""Parameters and remappings as parts of models."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, get_args, get_origin

from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue
from orchestra.compat.launch_ros.utilities.exact import Exact
from orchestra.compat.place import Argument, within
from orchestra.compat.text import template
from orchestra.description.parts import Override, Param, Remap
from orchestra.description.text import Constant, Template, new_constant

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.description.fields import Value
    from orchestra.location import Span


def params(parameters: Iterable[Any], span: Span) -> tuple[Param, ...]:
    """Return the parts for normalised parameters; what has no place of its own is at `span`."""
    found: list[Param] = []
    for index, item in enumerate(parameters):
        if type(item) is dict or isinstance(item, Mapping):
            found += params_of(item, within(span, index))
        elif isinstance(item, Parameter):
            found.append(_override(item))
        elif isinstance(item, ParameterFile):
            found.append(_file(item, within(span, index)))
    return tuple(found)


def params_of(parameters: Mapping[Any, Any], span: Span) -> tuple[Param, ...]:
    """Return the parts for a normalised dictionary."""
    return tuple(_param(name, value, span) for name, value in parameters.items())


def _param(name: Any, value: Any, span: Span) -> Param:
    if isinstance(value, ParameterValue):  # which may say a type that there is not
        return Param.at(span, name=template(name, span), **typed_fields(value))
    return Param.made(
        span, {"name": template(name, span), "value": _value(value, within(span, *_step(name)))}
    )


def value_fields(value: Any, span: Span) -> dict[str, Any]:
    """Return `value` and, where it has one, `type` of a normalised value."""
    if isinstance(value, ParameterValue):
        return typed_fields(value)
    return {"value": _value(value, span)}


def remaps(rules: Iterable[tuple[Any, Any]], span: Span) -> tuple[Remap, ...]:
    """Return the parts for remapping rules."""
    return tuple(
        Remap.made(
            span,
            {
                "from_": template(source, within(span, index, 0)),
                "to": template(target, within(span, index, 1)),
            },
        )
        for index, (source, target) in enumerate(rules)
    )


def _step(name: Any) -> tuple[str, ...]:
    """Return where the value of a normalised name stands in the dictionary, as far as the name is a text."""
    if len(name) == 1 and isinstance(name[0], TextSubstitution):
        return (name[0].text,)
    texts = [item.text if isinstance(item, TextSubstitution) else None for item in name]
    known = [text for text in texts if text is not None]
    return ("".join(known),) if len(known) == len(texts) else ()


def _override(parameter: Parameter) -> Override:
    name, value = parameter._written
    place = parameter._place
    return Override.at(place.span, name=template(name, place.at("name")), **typed_fields(value))


def _file(file: ParameterFile, given: Span) -> Param:
    """Return the part for a file; one that was given as a path stands where that does."""
    place = file._place
    span = given if isinstance(given, Argument) and given.place.span == place.span else place.at("param_file")
    allowed: dict[str, Any] = {"allow_substs": template("true", span)} if file.allow_substs else {}
    return Param.at(span, from_=template(file._written, span), **allowed)


def typed_fields(value: ParameterValue) -> dict[str, Any]:
    """Return `value` and, where it has one, `type` of a value that says more than itself."""
    span = value._place.at("value")
    word = _word(value.value_type)
    written = value._written
    if isinstance(written, list) and not _is_text(written):
        read: Any = tuple(
            _text(item, span) if isinstance(item, list) else Constant(item, span) for item in written
        )
        if not any(isinstance(item, Template) for item in read):
            read = Constant(tuple(written), span)
    else:
        read = _text(written, span) if isinstance(written, list) else new_constant(written, span)
    return {"value": read, **({} if word is None else {"type": template(word, span)})}


def _value(value: Any, span: Span) -> Value | tuple[Value, ...]:
    if not isinstance(value, tuple):
        return new_constant(value, span)
    if _is_text(value):
        return _text(value, span)
    if not any(isinstance(item, tuple) for item in value):
        return _exact(value, span)
    read = tuple(_text(item, span) for item in value)
    exact = [item.value for item in read if isinstance(item, Constant)]
    return _exact(tuple(exact), span) if len(exact) == len(read) else read


def _exact(items: tuple[Any, ...], span: Span) -> Value | tuple[Value, ...]:
    """Return a list of exact values; one of several types item by item, for the visit to tell which is the odd one."""
    kinds = set(map(type, items))
    if len(kinds) <= 1 or kinds in ({int, float}, {bool, int}):
        return new_constant(items, span)
    return tuple(new_constant(item, within(span, index)) for index, item in enumerate(items))


def _is_text(items: Any) -> bool:
    """Return whether these are substitutions that are concatenated."""
    return bool(items) and all(isinstance(item, Substitution) for item in items)


def _text(items: Any, span: Span) -> Value:
    if len(items) == 1 and isinstance(items[0], Exact):
        return new_constant(items[0].value, span)
    return template(items, span)


def _word(kind: Any) -> str | None:
    """Return how the launch language spells a type."""
    if kind is None:
        return None
    items = get_args(kind) if get_origin(kind) is list else ()
    return f"list_of_{items[0].__name__}" if items else getattr(kind, "__name__", str(kind))
