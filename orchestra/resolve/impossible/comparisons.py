"""Comparisons with a value that a launch argument cannot have, or with something that no text can equal.

What a side of a comparison can come to is known where it is made of constant text and one argument with `choices`.
A comparison of constants is meant: that is how people switch something off.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass
from orchestra.description.text import Call, MatchedTemplate, Opaque, Pieces, Words, new_words
from orchestra.errors import Code
from orchestra.location import Span
from orchestra.nearest import nearest
from orchestra.patterns import pattern
from orchestra.resolve.substitutions.equality import equal

if TYPE_CHECKING:
    import ast
    from collections.abc import Iterator, Sequence

    from orchestra.description.text import Part, Template
    from orchestra.resolve.resolution import Resolution

_EQUALITIES: Final = {"equals": True, "not-equals": False}
_BY_CONFIGURATION: Final = {"LaunchConfigurationEquals": True, "LaunchConfigurationNotEquals": False}
_PLACE: Final = pattern("\ue000([0-9]+)\ue001")
_TEXT: Final = r"""(?:'[^'\\\n]*+'|"[^"\\\n]*+")"""
_TEXTS: Final = pattern(rf"{_TEXT} *+[=!]= *+{_TEXT}")


@dataclass(frozen=True, slots=True)
class _Side:
    """A side of a comparison: the texts it can come to, None where that is not known; the argument that it reads.

    `place` works out where it stands, which is seldom asked for.
    """

    texts: tuple[str, ...] | None
    argument: str | None
    place: Callable[[], Span]


def check_comparisons(template: Template, run: Resolution) -> None:
    """Report the comparisons in a condition that are always true or always false."""
    if type(template) is MatchedTemplate:
        pieces = template.pieces
        if pieces is None or pieces.variables is not None or pieces.beside is not None:
            return  # of words, variables and paths
        if type(pieces) is not Pieces and not _may_be_told(pieces, run):
            return
    for part in _parts(template):
        if isinstance(part, Call) and part.name in _EQUALITIES and len(part.arguments) > 1:
            one, other = (_side(argument, run) for argument in part.arguments[:2])
            _check(one, other, run, holds=_EQUALITIES[part.name])
        elif isinstance(part, Call) and part.name == "eval" and part.arguments:
            _check_expression(part.arguments[0], run)
        elif isinstance(part, Opaque) and len(part.inside) > 1:
            holds = _BY_CONFIGURATION.get(_condition(part))
            if holds is not None:
                _check(_side(part.inside[0], run), _side(part.inside[1], run), run, holds=holds)


def _may_be_told(
    pieces: Any,  # noqa: ANN401 - a `Calculated`, of which many files have none
    run: Resolution,
) -> bool:
    from orchestra.resolve.impossible.conditions_alike import may_be_told  # noqa: PLC0415 - as above

    return may_be_told(pieces, run)


def _condition(part: Opaque) -> str:
    """Return the name of the class of a condition that is performed as a text."""
    return type(getattr(part.target, "_condition", part.target)).__name__


def _parts(template: Template) -> Iterator[Part]:
    for part in template.parts:
        yield part
        if isinstance(part, Call) and part.name != "eval":
            for argument in part.arguments:
                yield from _parts(argument)


def _side(template: Template, run: Resolution) -> _Side:
    return _made_of(template.parts, lambda: template.span, run)


def _made_of(parts: Sequence[Part], place: Callable[[], Span], run: Resolution) -> _Side:
    """Return what constant text around at most one argument can come to."""
    texts: tuple[str, ...] = ("",)
    argument: str | None = None
    for part in parts:
        if isinstance(part, Words):
            texts = tuple(text + part.text for text in texts)
            continue
        name = _argument(part)
        choices = run.found.choices_of(name) if name is not None and argument is None else None
        if choices is None:
            return _Side(None, name, place)
        argument = name
        texts = tuple(text + choice for text in texts for choice in choices)
    return _Side(texts, argument, place)


def _argument(part: Part) -> str | None:
    if isinstance(part, Call) and part.name == "var" and part.arguments:
        return part.arguments[0].constant
    return None


def _check(one: _Side, other: _Side, run: Resolution, *, holds: bool) -> None:
    """Report two sides that are never equal, where one of them depends on an argument."""
    if one.argument is None:
        one, other = other, one
    if one.argument is None or one.texts is None or other.texts is None or other.argument is not None:
        return
    if not any(equal(mine, its) for mine in one.texts for its in other.texts):
        _report(one.argument, other.texts[0], other.place(), run, holds=holds)


def _report(argument: str, text: str, span: Span, run: Resolution, *, holds: bool) -> None:
    choices = run.found.choices_of(argument) or ()
    always = "never" if holds else "always"
    message = f"'{argument}' is {', '.join(choices)}, not '{text}': this is {always} true"
    run.problems.warning(Code.IMPOSSIBLE_CONDITION, message, run.at(span), suggestion=nearest(text, choices))


def _check_expression(template: Template, run: Resolution) -> None:
    """Report the comparisons in a Python expression whose result is always the same."""
    text = "".join(
        part.text if isinstance(part, Words) else f"\ue000{index}\ue001"
        for index, part in enumerate(template.parts)
    )
    if "\ue000" not in text:
        return  # nothing in it is anything but constant, and that is meant
    lead, text = len(text) - len(text.lstrip()), text.strip()
    every = range(len(template.parts))
    if _TEXTS.fullmatch(text) and not any(_is_choice(number, template.parts, run) for number in every):
        return  # two texts, as most of them are, of which it is not known what they can come to
    for node, numbers in _compared(text):
        if numbers is None or any(_is_choice(number, template.parts, run) for number in numbers):
            _check_compared(node, template, lead, run)


def _is_choice(number: int, parts: Sequence[Part], run: Resolution) -> bool:
    name = _argument(parts[number]) if number < len(parts) else None
    return name is not None and run.found.choices_of(name) is not None


@lru_cache(maxsize=64)  # as many conditions say the same
def _compared(text: str) -> tuple[tuple[ast.Compare, tuple[int, ...] | None], ...]:
    """Return the comparisons of two values in an expression; none where it is no expression.

    Beside each are the numbers of the substitutions in its texts, where it compares nothing else: at least one has to
    be an argument with choices for it to come always to the same.

    A substitution outside of quotes stands for code. What is wrong is told where it is evaluated.
    """
    import ast  # noqa: PLC0415 - slow, and few conditions are expressions

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text, mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ()
    found = [node for node in ast.walk(tree) if isinstance(node, ast.Compare) and len(node.ops) == 1]
    return tuple((node, _numbers(node)) for node in found)


def _numbers(node: ast.Compare) -> tuple[int, ...] | None:
    """Return the numbers of the substitutions in the texts that are compared; None where anything else is."""
    import ast  # noqa: PLC0415 - as above

    numbers: list[int] = []
    for inner in (node.left, *node.comparators):
        for side in inner.elts if isinstance(inner, ast.Tuple | ast.List | ast.Set) else (inner,):
            if not isinstance(side, ast.Constant) or not isinstance(side.value, str):
                return None
            numbers += map(int, _PLACE.findall(side.value))
    return tuple(numbers)


def _check_compared(node: ast.Compare, template: Template, lead: int, run: Resolution) -> None:
    import ast  # noqa: PLC0415 - as above

    (operator,), (right,) = node.ops, node.comparators
    sides = [node.left, right]
    if isinstance(operator, ast.In | ast.NotIn) and isinstance(right, ast.Tuple | ast.List | ast.Set):
        sides = [node.left, *right.elts]
    elif not isinstance(operator, ast.Eq | ast.NotEq):
        return
    if not all(isinstance(side, ast.Constant) for side in sides):
        return
    holds = isinstance(operator, ast.Eq | ast.In)
    one, *others = (_constant(side, template, lead, run) for side in sides if isinstance(side, ast.Constant))
    if isinstance(one, _Side) and len(others) == 1 and not isinstance(others[0], _Side):
        one, others = others[0], [one]
    if not isinstance(one, _Side):
        if len(others) == 1 and isinstance(others[0], _Side) and others[0].argument is not None:
            _report_kind(others[0].argument, one, node, template, lead, run, holds=holds)
        return
    _check_texts(one, others, run, holds=holds)


def _check_texts(one: _Side, others: Sequence[object], run: Resolution, *, holds: bool) -> None:
    sides = [side for side in others if isinstance(side, _Side)]
    if len(sides) < len(others) or not sides:
        return
    if one.argument is None and len(sides) == 1:
        one, sides = sides[0], [one]
    if one.argument is None or one.texts is None:
        return
    values: set[str] = set()
    for side in sides:
        if side.texts is None or side.argument is not None:
            return
        values.update(side.texts)
    if values.isdisjoint(one.texts):
        _report(one.argument, (sides[0].texts or ("",))[0], sides[0].place(), run, holds=holds)


def _constant(node: ast.Constant, template: Template, lead: int, run: Resolution) -> _Side | object:
    """Return a text of an expression as a side of a comparison, any other constant as it is."""
    if not isinstance(node.value, str):
        return node.value
    pieces = _PLACE.split(node.value)
    parts: list[Part] = []
    for index, piece in enumerate(pieces):
        if index % 2:
            parts.append(template.parts[int(piece)])
        elif piece:
            parts.append(new_words(piece, template.span))
    return _made_of(parts, lambda: _place(node, template, lead), run)


def _report_kind(
    argument: str,
    value: object,
    node: ast.Compare,
    template: Template,
    lead: int,
    run: Resolution,
    *,
    holds: bool,
) -> None:
    """Report a comparison of a text, which the value of an argument in quotes is, with what is no text."""
    constant = next(
        side for side in (node.left, node.comparators[0]) if getattr(side, "value", None) is value
    )
    always = "never" if holds else "always"
    message = f"'{argument}' in quotes is a text, and {value!r} is none: this is {always} true"
    place = run.at(_place(constant, template, lead, quotes=0))
    run.problems.warning(
        Code.IMPOSSIBLE_CONDITION, message, place, notes=(f"in quotes too: '{_written(value)}'",)
    )


def _written(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _place(node: ast.expr, template: Template, lead: int, *, quotes: int = 1) -> Span:
    """Return where a constant of an expression stands in the file, without its quotes; the whole where unclear."""
    begin, end = node.col_offset + lead + quotes, (node.end_col_offset or 0) + lead - quotes
    position = 0
    for index, part in enumerate(template.parts):
        text = part.text if isinstance(part, Words) else f"\ue000{index}\ue001"
        # Offsets of `ast` count bytes of UTF-8.
        length = len(text.encode())
        if isinstance(part, Words) and position <= begin and end <= position + length:
            return _within(part, begin - position, end - position) or template.span
        position += length
    return template.span


def _within(words: Words, begin: int, end: int) -> Span | None:
    span = words.span
    if (
        span.line != span.end_line
        or span.end_column - span.column != len(words.text)
        or not words.text.isascii()
    ):
        return None
    return Span(span.file, span.line, span.column + begin, span.line, span.column + end)
