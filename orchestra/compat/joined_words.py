"""Words of a command line without a comma between them, which Python makes one: `['-topic' '-z']`."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING, Final

from orchestra.compat.rewritten import Rewritten
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.errors import Code
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problems
    from orchestra.location import Span

_TWO: Final = re.compile(
    r"""((["'])([^"'\\\n]*[^\s"'\\\n=:])\2)\s+((["'])(--?[a-zA-Z][^"'\\\n]*|/[^"'\\\n]*@[^"'\\\n]*)\5)"""
)
_LISTS: Final = frozenset({"arguments", "cmd", "ros_arguments"})


def tell(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of options, and of topics of a bridge, that are part of the word before them for want of a comma."""
    tree = tree_of(path)
    for word in () if tree is None else _words(tree):
        span = node_span(path, word, quotes=True)
        found = _TWO.fullmatch(text_at(path, span))
        if found is not None and (not found[6].startswith("/") or "@" in found[3]):
            message = f"a comma is missing between '{found[3]}' and '{found[6]}': they are one word"
            meant = Rewritten(f"{found[1]}, {found[4]}")
            problems.warning(Code.BAD_VALUE, message, Location(span, chain), suggestion=meant)


def _words(tree: Tree) -> Iterator[ast.Constant]:
    """Yield the texts of the lists that are command lines."""
    for node in tree.nodes:
        for item in node.keywords if isinstance(node, ast.Call) else ():
            words = tree.meaning(item.value) if item.arg in _LISTS else None
            for word in words.elts if isinstance(words, ast.List) else ():
                if isinstance(word, ast.Constant) and isinstance(word.value, str):
                    yield word
