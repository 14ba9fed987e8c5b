"""Turns a text with substitutions into its value."""

from __future__ import annotations

import os
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.text import Call, MatchedTemplate, Opaque, Pieces, PlainPath, Words
from orchestra.location import new_location
from orchestra.resolve.context import POISON, Poison, new_value
from orchestra.resolve.late_values import matched_value
from orchestra.resolve.substitutions.table import performing

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.description.text import Part, Template
    from orchestra.resolve.context import Context, Evaluated, Read, Value

_VARIABLE: Final = "var"
_FOLDER: Final = "dirname"
_PREFIX: Final = "find-pkg-prefix"
_PLAIN: Final = (_VARIABLE, _FOLDER)
_folder_of: Final = lru_cache(maxsize=64)(os.path.dirname)  # as `$(dirname)` does; many nodes are of one file


def evaluate(template: Template, context: Context) -> Evaluated:
    """Return the concatenated parts; the value points at where the template is written.

    Every part is evaluated even where one is faulty, so that all faults are reported and all reads are seen.
    """
    if type(template) is MatchedTemplate:
        if template.constant is None:
            return performed(template, context)
        return matched_value(template.constant, template, context.included_from)
    if not template.faulty:
        parts = template.parts
        if len(parts) == 1 and type(parts[0]) is Words:
            at = new_location(template.span, context.included_from)
            return new_value(parts[0].text, at, verbatim=True)
        alone = parts[0] if len(parts) == 1 else None
        other = type(alone) is Call and alone.name not in _PLAIN
        value = None if other else _at_once(template, parts, context)
        if value is not None:
            return value
    return _concatenated(template, context)


def _at_once(template: Template, parts: Sequence[Part], context: Context) -> Value | None:
    """Return what a text comes to that calls nothing but `$(dirname)` and variables with nothing to tell; else None."""
    pieces: list[str | None] = []
    names = []
    verbatim = True
    for part in parts:
        if type(part) is Words:
            pieces.append(part.text)
            continue
        if type(part) is not Call:
            return None
        verbatim = False
        if part.name == _FOLDER and not part.arguments and context.file is not None:
            pieces.append(_folder_of(context.file))
            continue
        if part.name != _VARIABLE:
            return None
        name = part.arguments[0]
        if len(name.parts) != 1 or type(name.parts[0]) is not Words or name.faulty:
            return None
        names.append(name.parts[0].text)
        pieces.append(None)
    at = new_location(template.span, context.included_from)
    if not names:
        text = "".join(filter(None, pieces))
        return new_value(text, at, verbatim=True) if verbatim else new_value(text, at, raw=template.raw)
    known = context.variables.known(names)
    if known is None:
        return None
    following = iter(known)
    text = "".join([next(following).value if piece is None else piece for piece in pieces])
    return new_value(text, at, through=known, raw=template.raw)


def _concatenated(template: Template, context: Context) -> Evaluated:
    texts: list[str] = []
    poisoned = template.faulty
    with context.variables.tracing() as reads:
        for part in template.parts:
            if isinstance(part, Words):
                texts.append(part.text)
                continue
            value = perform(part, context)
            if isinstance(value, Poison):
                poisoned = True
            else:
                texts.append(value.text)
    if poisoned:
        return POISON
    return new_value("".join(texts), context.place(template), through=tuple(reads), raw=template.raw)


def performed(template: MatchedTemplate, context: Context) -> Evaluated:
    """Return what a text with calls comes to, without the places of these where they have nothing to tell."""
    known = plainly(template, context)
    if known is None:
        return _concatenated(template, context)
    return matched_value(known[0], template, context.included_from, known[1])


def plainly(template: MatchedTemplate, context: Context) -> tuple[str, tuple[Read, ...]] | None:
    """Return what variables and the folder make of a text, and what is noted of them; None for all other texts.

    Neither is anything noted where there is something to tell of a variable.
    """
    pieces, file = template.pieces, context.file
    if pieces is None:
        return None
    if pieces.variables is not None:
        reads = context.variables.known(pieces.variables)
        if reads is None:
            return None
        if len(pieces.pieces) == 1:
            return reads[0].value, reads
        return pieces.filled([read.value for read in reads]), reads
    if pieces.beside is None:
        return None if type(pieces) is Pieces else _worked_out(pieces, context)
    if type(pieces) is not Pieces:
        return _put_together(pieces, context)
    if file is None:
        return None
    reads = context.variables.known(pieces.beside)
    return None if reads is None else (_in_folder(pieces, file, reads), reads)


def _worked_out(
    pieces: Any,  # noqa: ANN401 - a `Calculated`, of which many files have none
    context: Context,
) -> tuple[str, tuple[Read, ...]] | None:
    """Return the same of calls in others, or with arguments in quotes, that do nothing but calculate."""
    formula = pieces.formula
    if formula is None:
        from orchestra.resolve.formulas.formula import formula_of  # noqa: PLC0415 - as above

        formula = formula_of(pieces)
    found: tuple[str, tuple[Read, ...]] | None = formula.text(pieces, context.variables)
    return found


def _put_together(
    pieces: Any,  # noqa: ANN401 - those of texts that code has put together
    context: Context,
) -> tuple[str, tuple[Read, ...]] | None:
    """Return the same of texts in which there are paths, or places of packages: these are known, or it is None."""
    file, folders = context.file, []
    for name, package in pieces.packages:
        folder = (context.packages.prefix if name == _PREFIX else context.packages.share)(package)
        if folder is None:
            return None
        folders.append(folder)
    reads = None if file is None else context.variables.known(pieces.beside)
    if file is None or reads is None:
        return None
    values = iter([read.value for read in reads])
    return _text(pieces.pieces, _folder_of(file), values, iter(folders)), reads


def _text(pieces: Sequence[Any], folder: str, values: Iterator[str], folders: Iterator[str]) -> str:
    """Return what pieces come to, with the values of variables and the places of packages that are in them."""
    found = []
    for piece in pieces:
        if type(piece) is str:
            found.append(piece)
        elif type(piece) is PlainPath:
            components = [_text(component, folder, values, folders) for component in piece.components]
            found.append(os.path.join(*components))  # noqa: PTH118 - as `$(path-join)` does
        elif piece.name == _VARIABLE:
            found.append(next(values))
        else:
            found.append(folder if piece.name == _FOLDER else next(folders))
    return "".join(found)


def _in_folder(pieces: Pieces, file: str, reads: Sequence[Read]) -> str:
    """Return a text of a launch file in which only variables and its folder are substituted."""
    folder, following = _folder_of(file), iter(reads)
    return "".join(
        [
            piece if isinstance(piece, str) else folder if piece.variable is None else next(following).value
            for piece in pieces.pieces
        ]
    )


def perform(part: Call | Opaque, context: Context) -> Evaluated:
    """Return the value of one substitution, which points at where the substitution is written."""
    if isinstance(part, Opaque):
        return context.perform_opaque(part)
    return performing(part.name)(part, context, evaluate)
