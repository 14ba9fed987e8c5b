"""Code that joins texts, as the list that a launch file joins texts and substitutions by."""

from __future__ import annotations

import ast
import string
from itertools import groupby
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.compat.rewritten import Rewritten
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.syntax_trees import Tree

_Piece: TypeAlias = str | ast.expr
_MOST: Final = 100  # characters: what is longer is read better in the message alone
# What makes texts, beside literals of them.
_TEXTS: Final = frozenset({"abspath", "dirname", "get_package_share_directory", "join", "realpath", "str"})
# What makes folders, below which there are files.
_FOLDERS: Final = frozenset(
    {"FindPackageShare", "abspath", "dirname", "get_package_share_directory", "join", "realpath"}
)


def joined(node: ast.AST, tree: Tree, file: str) -> Rewritten | None:
    """Return the list of what an expression joins, or the path; None where a list cannot stand there."""
    if not _may_be_list(node, tree):
        return None
    match node:
        case ast.Call(func=ast.Attribute(attr="join", value=ast.Attribute(attr="path")), args=parts):
            written = ", ".join(_source(part, file) for part in parts)
            return _short(f"PathJoinSubstitution([{written}])")
        case ast.expr():
            pieces = _pieces(node)
            if pieces is None or pieces == [node]:
                return None
            return _short(_path(pieces, tree, file) or _listed(pieces, tree, file))
    return None


def _path(pieces: list[_Piece], tree: Tree, file: str) -> str | None:
    """Return the path that pieces are below a folder, of which slashes are between any two."""
    first, *others = pieces
    if isinstance(first, str) or called_by(tree.meaning(first)) not in _FOLDERS:
        return None
    parts, is_begun = [_source(first, file)], True
    for piece in others:
        if isinstance(piece, str):
            if is_begun and not piece.startswith("/"):
                return None
            parts += [repr(part) for part in piece.split("/") if part]
            is_begun = not piece.endswith("/")
        elif is_begun:
            return None
        else:
            parts.append(_source(piece, file))
            is_begun = True
    return f"PathJoinSubstitution([{', '.join(parts)}])"


def _pieces(node: ast.expr) -> list[_Piece] | None:
    """Return what an expression joins, None where it does something else with it, too."""
    match node:
        case ast.Constant(value=str(text)):
            return [text]
        case ast.JoinedStr(values=values):
            return _together([_formatted(value) for value in values])
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            return _together([_pieces(left), _pieces(right)])
        case ast.BinOp(left=ast.Constant(value=str(text)), op=ast.Mod(), right=right):
            return _filled(text.split("%s"), right.elts if isinstance(right, ast.Tuple) else [right])
        case ast.Call(func=ast.Attribute(value=ast.Constant(value=str(text)), attr="format"), args=given):
            gaps = [gap for _, gap, *_ in string.Formatter().parse(text) if gap is not None]
            return _filled(text.split("{}"), given) if not any(gaps) else None
        case ast.Call(
            func=ast.Attribute(value=ast.Constant(value=""), attr="join"), args=[ast.List(elts=given)]
        ):
            return _together([_pieces(each) for each in given])
        case ast.Call(func=ast.Name(id="str"), args=[one], keywords=[]):
            return [one]
    return [node]


def _formatted(value: ast.expr) -> list[_Piece] | None:
    match value:
        case ast.FormattedValue(value=inner, conversion=-1, format_spec=None):
            return [inner]
        case ast.Constant(value=str(text)):
            return [text]
    return None


def _filled(texts: Sequence[str], given: Sequence[ast.expr]) -> list[_Piece] | None:
    """Return texts with what stands between them, None where there are more or fewer gaps than that."""
    if len(texts) != len(given) + 1 or any("%" in text or "{" in text for text in texts):
        return None
    between: list[_Piece] = [texts[0]]
    for value, text in zip(given, texts[1:], strict=True):
        between += [value, text]
    return [piece for piece in between if piece != ""]


def _together(parts: list[list[_Piece] | None]) -> list[_Piece] | None:
    found: list[_Piece] = []
    for part in parts:
        if part is None:
            return None
        found += part
    return found


def _listed(pieces: list[_Piece], tree: Tree, file: str) -> str:
    """Return a list of pieces, of which those that are plain texts side by side are one."""

    def is_plain(piece: _Piece) -> bool:
        return isinstance(piece, str) or not _is_substitution(piece, tree)

    items: list[str] = []
    for plain, group in groupby(pieces, is_plain):
        found = list(group)
        items += [_text(found, tree, file)] if plain else [_source(each, file) for each in found]
    return items[0] if len(items) == 1 else f"[{', '.join(items)}]"


def _text(pieces: list[_Piece], tree: Tree, file: str) -> str:
    """Return code for some texts side by side."""
    if all(isinstance(piece, str) for piece in pieces):
        return repr("".join(map(str, pieces)))
    if len(pieces) == 1:
        source = _source(pieces[0], file)
        is_text = isinstance(pieces[0], ast.expr) and _is_text(tree.meaning(pieces[0]))
        return source if is_text else f"str({source})"
    held = "".join(piece if isinstance(piece, str) else f"{{{_source(piece, file)}}}" for piece in pieces)
    return f'f"{held}"' if "'" in held else f"f'{held}'"


def _is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.JoinedStr | ast.Constant) or called_by(node) in _TEXTS


def _is_substitution(node: ast.expr, tree: Tree) -> bool:
    """Return whether an expression is an object of a class, as far as its name tells."""
    name = called_by(tree.meaning(node))
    return name is not None and name[:1].isupper() and name != "Path"


def _source(piece: _Piece, file: str) -> str:
    return repr(piece) if isinstance(piece, str) else text_at(file, node_span(file, piece, quotes=True))


def _short(code: str) -> Rewritten | None:
    return Rewritten(code) if len(code) <= _MOST and "\n" not in code else None


def _may_be_list(node: ast.AST, tree: Tree) -> bool:
    """Return whether a list can stand in place of an expression, as far as what is around it tells."""
    for around in tree.nodes:
        match around:
            case ast.Assign(value=value) | ast.Return(value=value) if value is node:
                return True
            case ast.List(elts=held) | ast.Tuple(elts=held) | ast.Dict(values=held) if node in held:
                return True
            case ast.Call(args=given, keywords=words):
                if any(word.value is node for word in words):
                    return True
                if node in given:
                    return (called_by(around) or "")[:1].isupper()
    return False
