"""Where values stand in lists of the user's code: each may be asked for, of thousands."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from orchestra.compat.literals import Literal
from orchestra.compat.syntax_trees import Tree
from orchestra.location import Span

if TYPE_CHECKING:
    from collections.abc import Iterator


class _Counted(list[ast.expr]):
    """Counts how often it is gone through."""

    walks = 0

    def __iter__(self) -> Iterator[ast.expr]:
        self.walks += 1
        return super().__iter__()


def _list(source: str) -> tuple[Literal, _Counted]:
    tree = Tree(ast.parse(source))
    (listed,) = (node for node in tree.nodes if isinstance(node, ast.List))
    listed.elts = items = _Counted(listed.elts)
    return Literal("x.launch.py", listed, Span("x.launch.py", 1, 1, 1, 1), tree), items


def test_a_list_is_gone_through_once_for_all_its_items() -> None:
    literal, items = _list(f"[{', '.join(map(str, range(100, 150)))}]")
    columns = [literal.item(index, 50).span.column for index in range(50)]
    assert columns == [2 + 5 * index for index in range(50)]
    assert items.walks == 1


def test_where_another_list_is_spread_no_item_can_be_told() -> None:
    literal, _ = _list("[1, *others, 2]")
    assert literal.item(0, None).node is None
