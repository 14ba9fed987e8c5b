"""YAML launch files as trees of scalars, mappings and lists that know their place.

The structure is YAML 1.2 core: every scalar stays text until its meaning is known, only an empty value is null.
PyYAML's C parser reads the file; nothing is constructed, so nothing can be executed. Duplicate keys are errors.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import yaml

from orchestra.description.source import Keyed, Listed, Written, shortened
from orchestra.errors import Code
from orchestra.load.offsets import Source, source, spans_of
from orchestra.load.reader import Reader

if TYPE_CHECKING:
    from orchestra.location import Span

_NULL = frozenset({"", "~", "null", "Null", "NULL"})
_PLAIN_TAG = "tag:yaml.org,2002:str"
_KNOWN_TAGS = frozenset({_PLAIN_TAG, "tag:yaml.org,2002:map", "tag:yaml.org,2002:seq"})
_DEEPEST = 100
# How many values aliases may expand to beyond what is written.
_MOST_VALUES = 100_000
_VALUES_PER_CHARACTER = 4
_SCALAR_TYPES = ("bool", "int", "float", "null")

_PARSER: type[Any] = getattr(yaml, "CBaseLoader", yaml.BaseLoader)


def read(text: str, file: str, reader: Reader) -> Any | None:  # noqa: ANN401 - a tree
    """Return the tree of a YAML text, None where it is no YAML (which has been reported)."""
    whole = source(file, text)
    try:
        _check_depth(whole)
        node = yaml.compose(text, Loader=_PARSER)
    except _TooMuchError as error:
        reader.error(Code.SYNTAX, error.reason, error.span)
        return None
    except yaml.MarkedYAMLError as error:
        at = _mark(whole, error.problem_mark or error.context_mark)
        reader.error(Code.SYNTAX, _reason(error, whole, at), at)
        return None
    except (yaml.YAMLError, RecursionError) as error:
        offset = getattr(error, "position", 0)
        reader.error(
            Code.SYNTAX, f"this is not YAML: {shortened(str(error), 200)}", whole.span(offset, offset)
        )
        return None
    if node is None:
        reader.error(Code.SYNTAX, "the file is empty: a launch file has a 'launch' key", whole.span(0, 0))
        return None
    try:
        return _Tree(whole, reader).of(node, None, ())
    except _TooMuchError as error:
        reader.error(Code.SYNTAX, error.reason, error.span)
        return None


class _TooMuchError(Exception):
    """The file has more in it than anybody writes."""

    def __init__(self, reason: str, span: Span) -> None:
        super().__init__(reason)
        self.reason = reason
        self.span = span


def _check_depth(whole: Source) -> None:
    """Refuse what nests too deep, event by event: the C parser itself would run out of stack and end the process."""
    depth = 0
    for event in yaml.parse(whole.text, Loader=_PARSER):
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
            if depth > _DEEPEST:
                raise _TooMuchError(
                    f"the file nests more than {_DEEPEST} deep", _mark(whole, event.start_mark)
                )
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1


@dataclass(slots=True)
class _Tree:
    """Builds the tree of one file; counts what it builds, so that aliases cannot expand without bound."""

    whole: Source
    reader: Reader
    built: int = 0

    def of(self, node: yaml.Node, head: Span | None, above: tuple[yaml.Node, ...]) -> Any:  # noqa: ANN401 - a tree
        span = self.whole.span(node.start_mark.index, node.end_mark.index)
        self.built += 1
        if node in above:
            raise _TooMuchError("the alias refers to what it stands in", span)
        if len(above) > _DEEPEST:
            raise _TooMuchError(f"the file nests more than {_DEEPEST} deep", span)
        if self.built > _MOST_VALUES + _VALUES_PER_CHARACTER * len(self.whole.text):
            raise _TooMuchError("the aliases of the file expand to too much", span)
        if isinstance(node, yaml.ScalarNode):
            return self._scalar(node, span)
        if node.tag not in _KNOWN_TAGS:
            self.reader.error(Code.SYNTAX, f"the tag {node.tag} means nothing here", span)
        if isinstance(node, yaml.SequenceNode):
            items = Listed(span)
            items.extend(self.of(item, None, (*above, node)) for item in node.value)
            return items
        assert isinstance(node, yaml.MappingNode)  # noqa: S101 - the third and last kind of node
        return self._mapping(node, span, head, above)

    def _scalar(self, node: yaml.ScalarNode, span: Span) -> Written:
        kind = node.tag.removeprefix("tag:yaml.org,2002:")
        if node.tag != _PLAIN_TAG and kind not in _SCALAR_TYPES:
            self.reader.error(Code.SYNTAX, f"the tag {node.tag} means nothing here", span)
        plain = not node.style and (node.tag == _PLAIN_TAG or kind in _SCALAR_TYPES)
        tagged = plain and self.whole.text[node.start_mark.index : node.start_mark.index + 1] == "!"
        quoted = not plain or (tagged and kind == "str")
        spans = spans_of(self.whole, node.start_mark.index, node.end_mark.index, node.value, node.style)
        return Written(node.value, span, spans, quoted=quoted, null=not quoted and node.value in _NULL)

    def _mapping(
        self, node: yaml.MappingNode, span: Span, head: Span | None, above: tuple[yaml.Node, ...]
    ) -> Keyed:
        mapping = Keyed(span, head or self.whole.span(node.start_mark.index, node.start_mark.index))
        merged: list[Keyed] = []
        for key, value in node.value:
            at = self.whole.span(key.start_mark.index, key.end_mark.index)
            if not isinstance(key, yaml.ScalarNode):
                self.reader.error(Code.WRONG_TYPE, "a key is a word, not a mapping or a list", at)
                continue
            tree = self.of(value, at, (*above, node))
            if key.value == "<<" and not key.style:
                merged.extend(
                    item for item in (tree if isinstance(tree, list) else [tree]) if isinstance(item, Keyed)
                )
            elif key.value in mapping:
                first = mapping.keys_at[key.value]
                self.reader.error(
                    Code.DUPLICATE_KEY,
                    f"the key '{key.value}' stands twice",
                    at,
                    notes=(f"first at {first}",),
                )
            else:
                mapping.put(key.value, tree, at)
        for other in merged:
            for name, tree in other.items():
                if name not in mapping:
                    mapping.put(name, tree, other.keys_at[name])
        return mapping


def _reason(error: yaml.MarkedYAMLError, whole: Source, at: Span) -> str:
    if whole.text.startswith("\t", whole.lines[at.line - 1] + at.column - 1):
        return "this is not YAML: a tab cannot indent"
    parts = [part for part in (error.context, error.problem) if part]
    return "this is not YAML: " + ", ".join(parts)


def _mark(whole: Source, mark: Any) -> Span:  # noqa: ANN401 - a mark of either parser, or None
    offset = min(mark.index, len(whole.text)) if mark else 0
    return whole.span(offset, offset)
