"""What a YAML text says, told so that two texts can be compared: how it is laid out does not count, all else does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.description.source import Keyed, Listed, Written
from orchestra.errors import Problems
from orchestra.formatting.yaml_comments import comments_between
from orchestra.formatting.yaml_tree import LOADER
from orchestra.load import yaml_file
from orchestra.load.reader import Reader
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.files import read_parameter_file

if TYPE_CHECKING:
    from collections.abc import Iterator


def yaml_sense(text: str, *, parameters: bool) -> list[Any]:
    """Return what a parser, the reader of such files, and whoever reads its comments find in a text."""
    problems = Problems()
    if parameters:
        sections = read_parameter_file(text, "", problems)
        read: Any = [
            (
                section.pattern,
                [(item.name, repr(item.value), item.slot, item.opens) for item in section.entries],
            )
            for section in sections
        ]
    else:
        read = _plain(yaml_file.read(text, "", Reader(problems)))
    told = [(problem.code, problem.severity, problem.suggestion) for problem in problems]
    return [list(_events(text)), read, told, list(_comments(text))]


def _plain(tree: Any) -> Any:  # noqa: ANN401 - a tree
    if isinstance(tree, Written):
        return tree.text, tree.quoted, tree.null
    if isinstance(tree, Keyed):
        return {key: _plain(value) for key, value in tree.items()}, list(tree)
    return [_plain(item) for item in tree] if isinstance(tree, Listed) else tree


def _events(text: str) -> Iterator[tuple[Any, ...]]:
    """Yield the parser's events without their places, and without whether lists and mappings have brackets."""
    for event in yaml.parse(text, Loader=LOADER):
        named = [getattr(event, name, None) for name in ("anchor", "tag", "implicit", "value", "explicit")]
        yield type(event), *named, getattr(event, "style", None)


def _comments(text: str) -> Iterator[str]:
    """Yield the comments that stand between the tokens of a text, and those in the first lines of block scalars."""
    taken = []
    for token in yaml.scan(text, Loader=LOADER):
        start, end = token.start_mark.index, token.end_mark.index
        if isinstance(token, yaml.ScalarToken) and token.style in ("|", ">"):
            taken.append((start, start + 1))
            start = max(text.find("\n", start, end), start)
        if end > start:
            taken.append((start, end))
    yield from (comment.text for comment in comments_between(text, taken)[0])
