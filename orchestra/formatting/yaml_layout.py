"""A YAML file laid out: two blanks per level, lists below their key indented, comments where they were."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.formatting.yaml_flow import filled, is_table, key_text, one_line, table
from orchestra.formatting.yaml_nodes import File, Mapping, Node, Scalar, Sequence
from orchestra.formatting.yaml_page import Page
from orchestra.formatting.yaml_scalars import STEP, scalar_lines
from orchestra.formatting.yaml_tree import parsed

if TYPE_CHECKING:
    from orchestra.formatting.yaml_nodes import Document


def yaml_formatted(text: str, width: int) -> str:
    """Return a YAML text in its one form. Raises `yaml.YAMLError`, and `NotFormatted` for what has none."""
    file = parsed(text)
    layout = _Layout(file, width, Page(file))
    for document in file.documents:
        layout.document(document)
    laid_out = layout.page.finished()
    return laid_out.removesuffix("\n") if file.ends_in_text else laid_out


@dataclass(slots=True)
class _Layout:
    """Lays out one file. `indent` is always that of the entry at hand, `head` what stands before its value."""

    file: File
    width: int
    page: Page

    def document(self, document: Document) -> None:
        if document.directive is not None:
            self.marker("%YAML " + self.file.text[document.directive :].split(None, 2)[1], document.directive)
        if document.begun is not None:
            self.marker("---", document.begun)
        if not (isinstance(document.root, Scalar) and document.root.empty):
            self.page.entry(document.root.start, 1)
            self.value(document.root, 0, -STEP)
        if document.ended is not None:
            self.marker("...", document.ended)

    def marker(self, text: str, offset: int) -> None:
        self.page.entry(offset, 1)
        self.page.put(text, 0)
        self.page.tail(offset + len(text))

    def value(self, node: Node, indent: int, parent: int) -> None:
        """Add a node that begins on a line of its own, or behind dashes; what it belongs to has the parent's indent."""
        if isinstance(node, Scalar):
            self.scalar(node, "", indent, parent)
        elif node.flow:
            self.flow(node, "", indent)
        else:
            self.block(node, indent)

    def block(self, node: Sequence | Mapping, indent: int) -> None:
        """Add the entries of a list or mapping, each on lines of its own."""
        entries = self.entries(node)
        self.page.begin(entries[0][0], indent)
        depth = len(self.page.levels)
        for offset, key, value in entries:
            self.page.entry(offset, depth)
            if key is None:
                self.item(offset, value, indent)
            else:
                self.pair(key, value, indent)

    def entries(self, node: Sequence | Mapping) -> list[tuple[int, Scalar | None, Node]]:
        """Return where each entry begins, its key if it has one, and its value."""
        if isinstance(node, Mapping):
            return [(key.start, key, value) for key, value in node.pairs]
        if node.flow:
            return [(item.start, None, item) for item in node.items]
        ends = (node.start, *(item.end for item in node.items))
        return [
            (self.file.dash(end, max(item.start, end + 1)), None, item)
            for end, item in zip(ends, node.items, strict=False)
        ]

    def item(self, dash: int, node: Node, indent: int) -> None:
        """Add an item of a list."""
        if isinstance(node, Scalar) and node.empty:
            self.page.put("-", indent)
            self.page.tail(dash + 1)
            self.page.hollow(dash, indent + STEP)
        elif self.page.interrupted(self.content(node)) or _properties(node):
            self.page.put(f"- {_properties(node)}".rstrip(), indent)
            self.below(node, dash + 1, indent)
        else:
            self.page.lead = f"{self.page.margin(indent)}- "
            self.value(node, indent + STEP, indent)

    def pair(self, key: Scalar, value: Node, indent: int) -> None:
        """Add a key and its value."""
        head = f"{key_text(key, self.file.text)}:"
        if isinstance(value, Scalar) and value.empty:
            self.page.put(head, indent)
            self.page.tail(key.end)
            self.page.hollow(key.start, indent + STEP)
        elif _is_block(value) or self.page.interrupted(value.start):
            self.page.put(f"{head} {_properties(value)}".rstrip(), indent)
            self.below(value, key.end, indent)
        elif isinstance(value, Scalar):
            self.scalar(value, head, indent, indent)
        else:
            assert not isinstance(value, Scalar)  # noqa: S101 - told apart above
            self.flow(value, head, indent)

    def below(self, node: Node, offset: int, indent: int) -> None:
        """Add the comments behind a head that ends at an offset, and the value below it."""
        self.page.tail(offset)
        self.page.fresh = True
        if not _is_block(node):
            self.page.begin(node.start, indent + STEP)
            self.page.entry(node.start, len(self.page.levels))
        self.value(node, indent + STEP, indent)

    def scalar(self, node: Scalar, head: str, indent: int, parent: int) -> None:
        """Add a scalar, behind its head where it stands there or fits."""
        first, *rest = scalar_lines(node, self.file.text, parent)
        if head and self.is_below(node) and (rest or not self.fits(f"{head} {first}", indent)):
            self.page.put(head, indent)
            head, indent = "", indent + STEP
        self.page.put_lines(f"{head} {first}" if head else first, rest, indent)
        self.page.tail(node.end)

    def flow(self, node: Sequence | Mapping, head: str, indent: int) -> None:
        """Add a list or mapping in brackets: on one line, as a table, in rows, or else without brackets."""
        at = len(self.page.lines)
        column = len(self.page.margin(indent)) + (len(head) + 1 if head else 0)
        below = bool(head) and self.is_below(node)
        lines = None if below and is_table(node, self.file) else self.bracketed(node, indent, column)
        if lines is None and below:
            lines = self.bracketed(node, indent + STEP, indent + STEP)
            if lines is not None:
                self.page.put(head, indent)
                head, indent = "", indent + STEP
        if lines is None:
            self.unbracketed(node, head, indent)
            self.page.tail(node.end, at)
            return
        self.page.put_lines(f"{head} {lines[0]}" if head else lines[0], lines[1:], indent)
        self.page.skip(node.end)
        self.page.tail(node.end)

    def bracketed(self, node: Sequence | Mapping, indent: int, column: int) -> list[str] | None:
        """Return the lines of a node whose bracket comes to stand in a column, None where it does not fit."""
        text = self.file.text
        if is_table(node, self.file):
            return table(node, text, indent, column)
        written = one_line(node, text)
        if written is not None and (column + len(written) <= self.width or not self.entries(node)):
            return [written]
        return filled(node, text, column, self.width)

    def unbracketed(self, node: Sequence | Mapping, head: str, indent: int) -> None:
        """Add a list or mapping that does not fit in brackets."""
        if head or node.properties:
            self.page.put(f"{head} {node.properties}".strip(), indent)
            self.page.fresh = True
        self.block(node, indent + STEP if head else indent)

    def fits(self, text: str, indent: int) -> bool:
        return len(self.page.margin(indent)) + len(text) <= self.width

    def is_below(self, node: Node) -> bool:
        """Tell whether nothing stands before a node on its line."""
        before = self.file.text[self.file.text.rfind("\n", 0, node.start) + 1 : node.start]
        return not before.strip()

    def content(self, node: Node) -> int:
        """Return where the first line of a node begins, behind tag and anchor of what has no brackets."""
        if isinstance(node, Scalar) or node.flow:
            return node.start
        return self.entries(node)[0][0]


def _is_block(node: Node) -> bool:
    return not isinstance(node, Scalar) and not node.flow


def _properties(node: Node) -> str:
    return "" if isinstance(node, Scalar) or node.flow else node.properties
