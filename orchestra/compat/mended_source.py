"""The source of a file with what was meant in place of what was written, as code whose places are those of the file.

So a file goes on behind a mistake, and what is told of it then stands where people see it.
"""

from __future__ import annotations

import ast
import linecache
import re
import warnings
from bisect import bisect_right
from importlib import import_module
from itertools import accumulate
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.syntax_trees import read_as
from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from types import CodeType

    from orchestra.location import Span

IMPORT: Final = re.compile(r"(?:from ([\w.]+) )?import (\w+)")
_ALIAS: Final = re.compile(r"\s+as\s")


@dataclass(frozen=True, slots=True)
class _Edit:
    """What stands in place of a range of bytes."""

    begin: int
    end: int
    meant: bytes


@dataclass(frozen=True, slots=True)
class _Import:
    """A name that is imported, where it was used; a module of its own has none that it is imported from."""

    line: int
    column: int  # in bytes
    module: str | None
    name: str


class MendedSource:
    """The source of one file, and what was meant in it."""

    def __init__(self, file: str) -> None:
        self.file = file
        self._text = "".join(linecache.getlines(file))
        self._lines = [line.encode("utf-8", "surrogatepass") for line in self._text.split("\n")]
        self._begins = [0, *accumulate(len(line) + 1 for line in self._lines)]
        self._edits: list[_Edit] = []
        self._imports: list[_Import] = []

    def mend(self, span: Span, meant: str) -> bool:
        """Put what was meant in place of a range; false where that has been done or makes no sense."""
        if span.end_line > len(self._lines):  # the file has changed since
            return False
        begin, end = self._offset(span.line, span.column), self._offset(span.end_line, span.end_column)
        imported = IMPORT.fullmatch(meant)
        if imported is None:
            if any(edit.begin <= end and begin <= edit.end for edit in self._edits):
                return False
            self._edits.append(_Edit(begin, end, self._kept_name(begin, end, meant).encode()))
            return True
        found = _Import(span.line, begin - self._begins[span.line - 1], imported[1], imported[2])
        if found in self._imports:
            return False
        self._imports.append(found)
        return True

    def code(self) -> CodeType | None:
        """Return the code, None where it is none of Python."""
        source = b"\n".join(self._lines)
        for edit in sorted(self._edits, key=lambda edit: edit.begin, reverse=True):
            source = source[: edit.begin] + edit.meant + source[edit.end :]
        try:
            with warnings.catch_warnings(action="ignore"):  # told when the file was run
                tree = ast.parse(source.decode())
                self._put_back(tree, source)
                read_as(self._text, tree)
                for item in self._imports:
                    tree = _Importing(item).imported(tree)
                return compile(tree, self.file, "exec", dont_inherit=True)
        except (SyntaxError, ValueError, RecursionError):
            return None

    def import_into(self, known: dict[str, Any]) -> None:
        """Import what was meant to be imported into a module that has been run."""
        for item in self._imports:
            module = import_module(item.module or item.name)
            known.setdefault(item.name, getattr(module, item.name) if item.module else module)

    def _kept_name(self, begin: int, end: int, meant: str) -> str:
        """Return what is meant by a name that is imported, by both names: one of them is what the file uses."""
        source = b"\n".join(self._lines)
        line = source.rfind(b"\n", 0, begin) + 1
        written, before, after = (
            source[begin:end].decode(),
            source[line:begin],
            source[end : end + 8].decode(),
        )
        is_imported = re.match(rb"\s*(?:from\s+[\w.]+\s+)?import\s[\s\w,(]*$", before) is not None
        if not is_imported or not written.isidentifier() or not meant.isidentifier() or _ALIAS.match(after):
            return meant
        return f"{meant}, {meant} as {written}"

    def _offset(self, line: int, column: int) -> int:
        text = self._lines[line - 1].decode("utf-8", "surrogatepass")[: column - 1]
        return self._begins[line - 1] + len(text.encode("utf-8", "surrogatepass"))

    def _put_back(self, tree: ast.Module, source: bytes) -> None:
        """Give the nodes of a tree of the mended source the places that they have in the file."""
        begins = [0, *accumulate(len(line) + 1 for line in source.split(b"\n"))]
        for node in ast.walk(tree):
            if isinstance(node, ast.expr | ast.stmt | ast.keyword | ast.alias | ast.arg | ast.excepthandler):
                first = self._written(begins[node.lineno - 1] + node.col_offset, is_end=False)
                last = self._written(
                    begins[(node.end_lineno or 1) - 1] + (node.end_col_offset or 0), is_end=True
                )
                node.lineno, node.col_offset = first
                node.end_lineno, node.end_col_offset = max(first, last)

    def _written(self, offset: int, *, is_end: bool) -> tuple[int, int]:
        """Return line and column in the file for an offset in the mended source."""
        moved = 0
        for edit in sorted(self._edits, key=lambda edit: edit.begin):
            begin = edit.begin + moved
            if offset <= begin:
                break
            if offset < begin + len(edit.meant) or (is_end and offset == begin + len(edit.meant)):
                return self._place(edit.end if is_end else edit.begin)
            moved += len(edit.meant) - (edit.end - edit.begin)
        return self._place(offset - moved)

    def _place(self, offset: int) -> tuple[int, int]:
        line = bisect_right(self._begins, offset, 1)
        return line, offset - self._begins[line - 1]


class _Importing(ast.NodeTransformer):
    """Imports a name from where it is: in place of where it is not, else at the top of the file."""

    def __init__(self, wanted: _Import) -> None:
        self._wanted = wanted
        self._is_done = False

    def imported(self, tree: ast.Module) -> ast.Module:
        """Return a tree with the import."""
        self.visit(tree)
        if not self._is_done:
            wanted = self._wanted
            name = ast.alias(wanted.name)
            made = ast.Import([name]) if wanted.module is None else ast.ImportFrom(wanted.module, [name], 0)
            tree.body.insert(_after_head(tree), made)
        return ast.fix_missing_locations(tree)

    def visit_ImportFrom(self, node: ast.ImportFrom) -> ast.stmt | list[ast.stmt]:
        """Divide an import."""
        wanted = self._wanted
        found = [
            item for item in node.names if (item.lineno, item.col_offset) == (wanted.line, wanted.column)
        ]
        if not found:
            return node
        self._is_done = True
        node.names = [item for item in node.names if item not in found]
        other = ast.copy_location(ast.ImportFrom(wanted.module, found, 0), node)
        return [node, other] if node.names else other

    def visit_Attribute(self, node: ast.Attribute) -> ast.expr:
        """Put a name in place of that of a module which lacks it."""
        wanted, width = self._wanted, len(self._wanted.name)
        at = (node.end_lineno, (node.end_col_offset or 0) - width)
        if at == (wanted.line, wanted.column) and node.attr == wanted.name:
            return ast.copy_location(ast.Name(wanted.name, node.ctx), node)
        self.generic_visit(node)
        return node


def _after_head(tree: ast.Module) -> int:
    """Return where the first statement stands that is neither a docstring nor an import from the future."""
    for index, node in enumerate(tree.body):
        is_text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        if not is_text and not (isinstance(node, ast.ImportFrom) and node.module == "__future__"):
            return index
    return len(tree.body)
