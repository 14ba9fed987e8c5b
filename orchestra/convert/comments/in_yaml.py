"""Comments in YAML: what begins with `#` between two scalars."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.convert.comments.found import Comment, Scan, text_of
from orchestra.formatting.yaml_comments import comments_between
from orchestra.load.offsets import source
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    from collections.abc import Iterator

_LOADER: type[Any] = getattr(yaml, "CBaseLoader", yaml.BaseLoader)


def scan(text: str) -> Scan:
    """Return the comments of a text that is known to be YAML."""
    whole = source("", text)
    found = []
    taken = list(_scalars(text))
    for comment in comments_between(text, taken)[0]:
        line, column = whole.place(comment.start)
        words = text_of(comment.text)
        behind = text[whole.lines[line - 1] : comment.start].strip()
        if words is not None:
            found.append(Comment((words,), line, column, line, behind))
    first = min((start for start, _ in taken), default=0)
    return Scan(tuple(found), whole.place(first)[0])


def _scalars(text: str) -> Iterator[tuple[int, int]]:
    """Yield where scalars stand; of a block only its lines, for a comment may stand behind its sign."""
    for token in yaml.scan(text, Loader=_LOADER):
        if isinstance(token, yaml.ScalarToken):
            start, end = token.start_mark.index, token.end_mark.index
            if token.style in ("|", ">"):
                line_end = text.find("\n", start)
                start = end if line_end < 0 else min(line_end, end)
            yield start, end
