"""Lists among the words of a command: what is in them becomes one word, without anything between."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Final

from orchestra.compat.rewritten import Rewritten
from orchestra.compat.syntax_trees import called_by, node_span
from orchestra.errors import Code
from orchestra.location import Location

if TYPE_CHECKING:
    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problems
    from orchestra.location import Span

_TAKING: Final = frozenset(
    {"ComposableNodeContainer", "Executable", "ExecuteLocal", "ExecuteProcess", "LifecycleNode", "Node"}
)
_WORDS: Final = frozenset({"arguments", "cmd", "ros_arguments"})
_SEVERAL: Final = 2
# Texts that end so, or go on so, are parts of one word.
_ENDING: Final = ("=", ":", "/", "_", "-", ".")
_GOING_ON: Final = ("=", ":", "_")


def tell_nested_words(path: str, tree: Tree, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of lists of plain texts there: what is put together of such could be one text."""
    for call in tree.nodes:
        for word in call.keywords if isinstance(call, ast.Call) and _takes_words(call) else ():
            listed = tree.meaning(word.value) if word.arg in _WORDS else None
            for item in listed.elts if isinstance(listed, ast.List | ast.Tuple) else ():
                texts = _texts(item, tree)
                if texts is None:
                    continue
                inner = ast.unparse(item)
                meant = f"*{inner}" if isinstance(item, ast.Name) else inner[1:-1]
                message = f"a list among the words is one word: {''.join(texts)!r}; each is one of its own"
                span = node_span(path, item)
                problems.warning(Code.WRONG_TYPE, message, Location(span, chain), suggestion=Rewritten(meant))


def _takes_words(call: ast.Call) -> bool:
    """Return whether a call takes words, which no shell takes apart."""
    return called_by(call) in _TAKING and not any(word.arg == "shell" for word in call.keywords)


def _texts(item: ast.expr, tree: Tree) -> list[str] | None:
    """Return the texts of a list that has nothing but several of them."""
    known = tree.meaning(item)
    held = known.elts if isinstance(known, ast.List | ast.Tuple) else []
    texts = [part.value for part in held if isinstance(part, ast.Constant) and isinstance(part.value, str)]
    is_joined = any(" " in text or text.endswith(_ENDING) for text in texts)
    is_joined = is_joined or any(text.startswith(_GOING_ON) for text in texts[1:])
    return texts if len(texts) == len(held) >= _SEVERAL and not is_joined else None
