"""Texts with substitutions as they are written in YAML and XML, and their normal form, in which they are compared."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from orchestra.convert.remarks import UnsayableError
from orchestra.description.substitutions import SIGNATURES
from orchestra.description.text import Call, Opaque, Template, Words
from orchestra.description.written import called, escaped
from orchestra.errors import Problems
from orchestra.load.grammar import parse_template
from orchestra.location import is_python, point

if TYPE_CHECKING:
    from collections.abc import Iterable

# Calls that give an absolute path without a slash at its end: what is joined to it may as well follow it.
_FOLDERS = frozenset({"dirname", "find-pkg-prefix", "find-pkg-share"})
# What comes to nothing, and is written without quotes.
_NOTHING = (("if", ("false",), ("x",), ()),)
_PIECE = re.compile(r"\\.|\$\(|.", re.DOTALL)
_ALIASES = {"log_dir": "launch_log_dir"}
_OPTIONAL_ARGUMENTS = {"if": 3}
_DEFAULTS = {"command": "fail", "eval": "math"}


class _Alias(str):
    """The name of a substitution, which has another one that its author has written."""

    __slots__ = ("written",)

    written: str


def written(template: Template) -> str:
    """Return how a text is written, as its author did where that says the same. Raises `UnsayableError`."""
    wanted = normal(template)
    if not is_python(template.span) and _reads_as(template.raw, wanted):
        return template.raw
    _refuse_opaque(template.parts)
    texts = ("".join(map(_written, parts)) for parts in (wanted, tuple(map(_filled, wanted))))
    text = next((text for text in texts if _reads_as(text, wanted)), None)
    if text is None:
        raise UnsayableError(
            "a substitution in quotes cannot have arguments in quotes itself: the launch language has no way to"
            " write that",
            template.span,
        )
    return text


def normal(template: Template) -> tuple[Any, ...]:
    """Return the parts of a text without their places: texts, calls as tuples, what is opaque as its object."""
    found: list[Any] = []
    for part in _joined(template.parts):
        if isinstance(part, str) and found and isinstance(found[-1], str):
            found[-1] += part
        elif part != "":
            found.append(part)
    return tuple(found)


def _joined(parts: Iterable[Any]) -> Iterable[Any]:
    for part in parts:
        if isinstance(part, Words):
            yield part.text
        elif isinstance(part, Call):
            yield from _call(part)
        else:
            yield id(part.target)


def _call(call: Call) -> Iterable[Any]:
    arguments = [() if found == _NOTHING else found for found in map(normal, call.arguments)]
    if call.name == "path-join" and _is_plain_path(arguments):
        for index, argument in enumerate(arguments):
            yield from ("/", *argument) if index else argument
        return
    if call.name == "string-join" and not arguments[0]:
        yield from (part for argument in arguments[1:] for part in argument)
        return
    default = _DEFAULTS.get(call.name)
    if default is not None and len(arguments) > 1 and arguments[-1] == (default,):
        arguments.pop()
    if call.name == "eval" and len(arguments) > 1 and len(arguments[1]) == 1:
        arguments[1] = (re.sub(r"\s*,\s*", ",", str(arguments[1][0]).strip()),)
    while len(arguments) < _OPTIONAL_ARGUMENTS.get(call.name, 0):
        arguments.append(())
    yield (_named(call.name), *arguments)


def _named(name: str) -> str:
    """Return what is equal for names of one substitution, and knows which of them was written."""
    if name not in _ALIASES:
        return name
    alias = _Alias(_ALIASES[name])
    alias.written = name
    return alias


def _is_plain_path(arguments: list[tuple[Any, ...]]) -> bool:
    """Return whether joining is the same as writing a slash between: a folder first, relative texts behind."""
    first, *others = arguments
    if len(first) != 1 or not isinstance(first[0], tuple) or first[0][0] not in _FOLDERS:
        return False
    inner = others[:-1]
    relative = all(len(item) == 1 and isinstance(item[0], str) and item[0][0] != "/" for item in others)
    return relative and not any(item[0].endswith("/") for item in inner)


def _written(part: Any) -> str:  # noqa: ANN401 - a part of a description, whatever it is
    if isinstance(part, str):
        return escaped(part)
    name, *arguments = part
    name = name.written if isinstance(name, _Alias) else name
    while len(arguments) > SIGNATURES[name].minimum and name in _OPTIONAL_ARGUMENTS and not arguments[-1]:
        arguments.pop()
    texts = ["".join(map(_written, argument)) for argument in arguments]
    text = f"$({' '.join((name, *map(_argument, texts)))})"
    return text if _reads_as(text, (part,)) else called(name, texts)


def _filled(part: Any, *, within: bool = False) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
    """Return a part without empty arguments in inner calls: these need quotes, which cannot stand in quotes."""
    if isinstance(part, str):
        return part
    name, *arguments = part
    last = len(arguments) if name in _OPTIONAL_ARGUMENTS else len(arguments) + 1
    return (
        name,
        *(
            _NOTHING
            if within and not argument and index < last
            else tuple(_filled(inner, within=True) for inner in argument)
            for index, argument in enumerate(arguments, 1)
        ),
    )


def _argument(text: str) -> str:
    """Return how a text is best written as an argument: in the quotes that it does not have itself."""
    outside = _outside_of_calls(text)
    if text and not set(outside) & set(" '\"()"):
        return text
    quote = '"' if "'" in outside else "'"
    return f"{quote}{text}{quote}"


def _outside_of_calls(text: str) -> str:
    """Return the characters of a text that stand in no substitution."""
    found, depth = [], 0
    for piece in _PIECE.findall(text):
        found.append("" if depth or piece == "$(" else piece)
        depth += (piece == "$(") - (piece == ")" and depth > 0)
    return "".join(found)


def _reads_as(text: str, wanted: tuple[Any, ...]) -> bool:
    problems = Problems()
    at = point("")
    return normal(parse_template(text, lambda *_: at, problems)) == wanted and not problems.errors


def _refuse_opaque(parts: Iterable[Any]) -> None:
    for part in parts:
        if isinstance(part, Opaque):
            name = type(part.target).__name__.strip("_")
            raise UnsayableError(f"only Python code knows what this {name} comes to", part.span)
        if isinstance(part, Call):
            for argument in part.arguments:
                _refuse_opaque(argument.parts)
