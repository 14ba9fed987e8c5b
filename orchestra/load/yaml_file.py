"""YAML launch files as trees of scalars, mappings and lists that know their place.

The structure is YAML 1.2 core: every scalar stays text until its meaning is known, only an empty value is null.
PyYAML's C parser reads the file; nothing is constructed, so nothing can be executed. Duplicate keys are errors. Most
files are read by `yaml_plain`, in one pass; what it leaves alone is read here, step by step.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass
from orchestra.description.actions import model_of
from orchestra.description.source import Keyed, Listed, Written, kind_of
from orchestra.errors import Code
from orchestra.load import yaml_plain
from orchestra.load.faults import Fault, RefusedError
from orchestra.load.keys import spelled
from orchestra.load.offsets import Source, source, spans_of
from orchestra.load.reader import Reader
from orchestra.load.yaml_plain import DASH, DEEPEST, NULL, PARSER
from orchestra.patterns import pattern
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    import re

    from orchestra.location import Span

_PLAIN_TAG = "tag:yaml.org,2002:str"
_KNOWN_TAGS = frozenset({_PLAIN_TAG, "tag:yaml.org,2002:map", "tag:yaml.org,2002:seq"})
_TAG = pattern(r"![^\s,\[\]{}]*")
EXPANDED: Final = "the aliases of the file expand to too much"  # behind which nothing is read
# How many values aliases may expand to beyond what is written.
_MOST_VALUES = 100_000
_VALUES_PER_CHARACTER = 4
_DOUBLED = pattern(r"\{\{\s*([A-Za-z_]\w*)\s*\}\}")
_LEAST = 2  # keys of an item that stand twice
_SCALAR_TYPES = ("bool", "int", "float", "null")


def read(text: str, file: str, reader: Reader) -> Any | None:  # noqa: ANN401 - a tree
    """Return the tree of a YAML text, None where it is no YAML (which has been reported)."""
    whole = source(file, text)
    reader.text = text
    tree = yaml_plain.read(whole)
    return read_closely(whole, reader) if tree is None else tree


def read_closely(whole: Source, reader: Reader) -> Any | None:  # noqa: ANN401 - a tree
    """Return the tree of a YAML text, whatever is in it; None where it is no YAML (which has been reported)."""
    try:
        return tree_of(whole, reader)
    except RefusedError as error:
        fault = error.fault
        reader.error(fault.code, fault.message, fault.span, suggestion=fault.suggestion)
        return None


def tree_of(whole: Source, reader: Reader) -> Any:  # noqa: ANN401 - a tree
    """Return the tree of a YAML text, whatever is in it. Raises `RefusedError` where it is no YAML."""
    try:
        _check_depth(whole)
        node = yaml.compose(whole.text, Loader=PARSER)
    except yaml.YAMLError as error:
        # Most files are YAML, and what explains why one is none takes time to import.
        from orchestra.load.yaml_faults import explained, failed_at  # noqa: PLC0415

        raise RefusedError(explained(error, whole), failed_at(error, whole)) from None
    if node is None:
        raise _refused("the file is empty: a launch file has a 'launch' key", whole.span(0, 0))
    return _Tree(whole, reader).of(node, None, ())


def _refused(reason: str, span: Span, suggestion: str | None = None) -> RefusedError:
    """Return what tells that something keeps all of the file from being read."""
    return RefusedError(Fault(reason, span, suggestion=suggestion))


def _check_depth(whole: Source) -> None:
    """Refuse what nests too deep, event by event: the C parser itself would run out of stack and end the process."""
    depth = 0
    for event in yaml.parse(whole.text, Loader=PARSER):
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
            if depth > DEEPEST:
                raise _refused(f"the file nests more than {DEEPEST} deep", _mark(whole, event.start_mark))
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
            raise _refused("the alias refers to what it stands in", span)
        if len(above) > DEEPEST:
            raise _refused(f"the file nests more than {DEEPEST} deep", span)
        if self.built > _MOST_VALUES + _VALUES_PER_CHARACTER * len(self.whole.text):
            raise _refused(EXPANDED, span)
        if isinstance(node, yaml.ScalarNode):
            return self._scalar(node, span)
        if node.tag not in _KNOWN_TAGS:
            self._refuse_tag(node)
        if isinstance(node, yaml.SequenceNode):
            items = Listed(span)
            items.extend(self.of(item, None, (*above, node)) for item in node.value)
            return items
        assert isinstance(node, yaml.MappingNode)  # noqa: S101 - the third and last kind of node
        if (doubled := _DOUBLED.match(self.whole.text, node.start_mark.index)) is not None:
            return self._variable(doubled, span)
        return self._mapping(node, span, head, above)

    def _scalar(self, node: yaml.ScalarNode, span: Span) -> Written:
        kind = node.tag.removeprefix("tag:yaml.org,2002:")
        if node.tag != _PLAIN_TAG and kind not in _SCALAR_TYPES:
            self._refuse_tag(node)
        plain = not node.style and (node.tag == _PLAIN_TAG or kind in _SCALAR_TYPES)
        tagged = plain and self.whole.text[node.start_mark.index : node.start_mark.index + 1] == "!"
        quoted = not plain or (tagged and kind == "str")
        spans = spans_of(self.whole, node.start_mark.index, node.end_mark.index, node.value, node.style)
        return Written(node.value, span, spans, quoted=quoted, null=not quoted and node.value in NULL)

    def _variable(self, doubled: re.Match[str], span: Span) -> Written:
        """Tell of a name in two braces, which is a mapping in YAML, and return the variable that it is meant to be."""
        message, meant = f"{doubled[0]} is a mapping in YAML, and no substitution", f"$(var {doubled[1]})"
        self.reader.error(Code.SUBSTITUTION_SYNTAX, message, span, suggestion=meant)
        return Written(meant, span, lambda _first, _last: span)

    def _mapping(
        self, node: yaml.MappingNode, span: Span, head: Span | None, above: tuple[yaml.Node, ...]
    ) -> Keyed:
        mapping = Keyed(span, head or self._beginning(node))
        merged: list[Keyed] = []
        for key, value in self._pairs(node, above):
            at = self.whole.span(key.start_mark.index, key.end_mark.index)
            if not isinstance(key, yaml.ScalarNode):
                self.reader.error(Code.WRONG_TYPE, "a key is a word, not a mapping or a list", at)
                continue
            if DASH.match(key.value) and not key.style:
                message = f"a blank is missing behind the '-' of '{key.value}'"
                raise _refused(message, at, f"- {key.value[1:]}")
            tree = self.of(value, at, (*above, node))
            if key.value == "<<" and not key.style:
                merged.extend(self._merged(tree, at))
            elif key.value in mapping:
                self._twice(key.value, tree, at, mapping)
            else:
                mapping.put(key.value, tree, at)
        for other in merged:
            for name, tree in other.items():
                if name not in mapping:
                    mapping.put(name, tree, other.keys_at[name])
        return mapping

    def _pairs(
        self, node: yaml.MappingNode, above: tuple[yaml.Node, ...]
    ) -> list[tuple[yaml.Node, yaml.Node]]:
        """Return the keys of a mapping with their values; where they begin anew, which is told, those before that."""
        pairs: list[tuple[yaml.Node, yaml.Node]] = node.value
        if node.flow_style and "$(" in self.whole.text[node.start_mark.index : node.end_mark.index]:
            from orchestra.load.yaml_flow import joined_pairs  # noqa: PLC0415 - what is plain does not come here

            return joined_pairs(pairs, self.whole, self.reader)
        again = _second_item(node)
        if again is None:
            return pairs
        key = pairs[again][0]
        at = self.whole.span(key.start_mark.index, key.end_mark.index)
        message, instead = f"the key '{key.value}' stands twice", None
        if above and isinstance(above[-1], yaml.SequenceNode):
            message += ": a '- ' is missing where the next item begins"
            instead = f"- {key.value}"
        self.reader.error(Code.DUPLICATE_KEY, message, at, suggestion=instead)
        return pairs[:again]

    def _twice(self, key: str, tree: Any, at: Span, mapping: Keyed) -> None:  # noqa: ANN401 - a tree
        """Report a key that stands twice; of an action it is rather one that lacks its dash."""
        first = mapping.keys_at[key]
        if all(model_of(spelled(name)) is not None for name in mapping) and isinstance(tree, Keyed):
            message = f"'{key}' is an action: a '- ' is missing before it"
            self.reader.error(Code.WRONG_TYPE, message, at, suggestion=f"- {key}")
            mapping.again = (*mapping.again, (key, tree, at))
            return
        message = f"the key '{key}' stands twice"
        self.reader.error(Code.DUPLICATE_KEY, message, at, notes=(f"first at {first}",))
        if isinstance(mapping[key], Written) and mapping[key].null:
            mapping[key] = tree  # the first is an empty beginning of the other

    def _beginning(self, node: yaml.MappingNode) -> Span:
        """Return the place of what a mapping without a key begins with: its brace, or its first key."""
        if node.flow_style or not node.value:
            return self.whole.span(node.start_mark.index, node.start_mark.index + 1)
        key = node.value[0][0]
        return self.whole.span(key.start_mark.index, key.end_mark.index)

    def _merged(self, tree: Any, at: Span) -> list[Keyed]:  # noqa: ANN401 - a tree
        """Return the mappings behind `<<`; anything else there is reported."""
        items = tree if isinstance(tree, list) else [tree]
        stray = next((item for item in items if not isinstance(item, Keyed)), None)
        if stray is not None:
            message = f"'<<' takes a mapping, or a list of them, not {kind_of(stray)}"
            self.reader.error(Code.WRONG_TYPE, message, at)
        return [item for item in items if isinstance(item, Keyed)]

    def _refuse_tag(self, node: yaml.Node) -> None:
        """Report a tag that no value can have."""
        begin = self.whole.text.find("!", node.start_mark.index, node.end_mark.index)
        found = _TAG.match(self.whole.text, begin)
        span = self.whole.span(*found.span()) if found else self.whole.span(node.start_mark.index, begin)
        self.reader.error(Code.SYNTAX, f"the tag {found[0] if found else node.tag} means nothing here", span)


def _second_item(node: yaml.MappingNode) -> int | None:
    """Return where the keys of a block mapping begin anew, in their order and at least two; None where they do not."""
    if node.flow_style or len(node.value) < 2 * _LEAST:
        return None
    names = [key.value if isinstance(key, yaml.ScalarNode) else None for key, _ in node.value]
    again = next((at for at, name in enumerate(names) if at and name == names[0]), None)
    if again is None or again < _LEAST or names[again : 2 * again] != names[:again] or len(names) % again:
        return None
    return again


def _mark(whole: Source, mark: Any) -> Span:  # noqa: ANN401 - a mark of either parser, or None
    offset = min(mark.index, len(whole.text)) if mark else 0
    return whole.span(offset, offset)
