"""Which comment stands with what: one with a line to itself with what follows, any other with what is before it."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from orchestra.convert.comments.anchors import anchors, anchors_in_code
from orchestra.convert.comments.kept import Comments, joined
from orchestra.convert.tree import NONE, Notes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.convert.comments.anchors import Anchor
    from orchestra.convert.comments.found import Comment, Scan
    from orchestra.convert.original import Original
    from orchestra.description.entity import Action

_OPENING = (":", "[", "(", "{", "-")
_CLOSING = ")]}, "


def attached(original: Original, actions: Sequence[Action]) -> Comments:
    """Return the comments of a file by what its actions have of it."""
    scan: Scan = import_module(f"orchestra.convert.comments.in_{original.language}").scan(original.text)
    found = (
        anchors_in_code(actions, original.file, original.text)
        if original.language == "python"
        else anchors(actions, original.file)
    )
    ordered = sorted(found, key=lambda anchor: (anchor.line, anchor.column))
    kept = Comments()
    header: list[str] = []
    at_end: list[str] = []
    end = 0
    for comment in scan.comments:
        anchor, beside = _anchor(comment, ordered, in_code=original.language == "python")
        if comment.line < scan.content:
            header += [*([""] if header and comment.line > end + 1 else []), *comment.lines]
        elif anchor is None:
            at_end += comment.lines
        else:
            _put(kept, anchor, comment, beside=beside)
        end = comment.end_line
    kept.header, kept.at_end = tuple(header), tuple(at_end)
    return kept


def _anchor(comment: Comment, ordered: Sequence[Anchor], *, in_code: bool) -> tuple[Anchor | None, bool]:
    """Return what a comment stands with, and whether it does so at the end of its line.

    Nothing of the description need begin on a line of code: a comment there is on what follows.
    """
    following = next((anchor for anchor in ordered if anchor.line > comment.end_line), None)
    if not comment.behind:
        return following, False
    on_line = next((anchor for anchor in ordered if anchor.line == comment.line), None)
    if on_line is not None:
        return on_line, True
    closes = not comment.behind.strip(_CLOSING)
    if (comment.behind.endswith(_OPENING) or (in_code and not closes)) and following is not None:
        return following, False
    if in_code and not closes:
        return None, False
    before = [anchor for anchor in ordered if anchor.line < comment.line]
    return (before[-1], True) if before else (following, False)


def _put(kept: Comments, anchor: Anchor, comment: Comment, *, beside: bool) -> None:
    key = (id(anchor.entity), anchor.name)
    single = beside and len(comment.lines) == 1
    notes = Notes((), comment.lines[0]) if single else Notes(comment.lines)
    kept.notes[key] = joined(kept.notes.get(key, NONE), notes)
