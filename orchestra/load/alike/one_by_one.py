"""The actions of a file, each by itself: by a form that is known, else in the ordinary way, which teaches it."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Any, Protocol

from orchestra.description.actions import model_of
from orchestra.description.source import Keyed
from orchestra.errors import Problems
from orchestra.load.alike.learned import LONG, Forms, UnlikeError, action_of
from orchestra.load.entities import action_in
from orchestra.load.keys import spelled
from orchestra.load.reader import Reader

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.description.entity import Action
    from orchestra.load.alike.learned import Item, Manner
    from orchestra.load.offsets import Source


class Format(Protocol):
    """What is asked of a format."""

    MANNER: Manner
    FORMS: Forms

    @staticmethod
    def items(whole: Source) -> Iterable[Item]:
        """Return the stretches, in order and with nothing but blanks and comments between them.

        Raises `UnlikeError` for any other file.
        """

    @staticmethod
    def tree(whole: Source, item: Item, reader: Reader) -> Any | None:  # noqa: ANN401 - a tree
        """Return the tree of the one action of a stretch; None where there is something else."""

    @staticmethod
    def straight(whole: Source, item: Item, reader: Reader) -> tuple[Action, tuple[Any, ...]] | None:
        """Return the action of a stretch, where it is plain to see, and what tells its form, as `words`."""

    @staticmethod
    def words(text: str) -> list[str]:
        """Return what the form of an action shows in: the same for those that are alike."""


def actions(written: Format, whole: Source, around: Reader) -> tuple[Action, ...] | None:
    """Return the actions of a file in which nothing is wrong; None for any other, and where it takes a closer look.

    Nothing is reported to the reader `around`: whoever reads the file in the ordinary way finds it again.
    """
    reader = Reader(Problems(), around.included_from, whole.text)
    known, found = written.FORMS.known, []
    try:
        for item in written.items(whole):
            action = action_of(known.get(item.beginning), whole, item, reader)
            action = action or _read(written, whole, item, reader)
            if action is None:
                return None
            found.append(action)
    except UnlikeError:
        return None
    return None if len(reader.problems) else tuple(found)


def _read(written: Format, whole: Source, item: Item, reader: Reader) -> Action | None:
    """Return an action of a form that is not known, straight or in the ordinary way; that teaches it in time."""
    straight = written.straight(whole, item, reader)
    words = written.words(whole.text[item.begin : item.end]) if straight is None else straight[1]
    worth = written.FORMS.worth((item.beginning, *words), LONG if straight is None else 1)
    if straight is not None and not worth:
        return straight[0]
    tree = written.tree(whole, item, reader)
    if not isinstance(tree, Keyed) or any(model_of(spelled(name)) is None for name in tree):
        return None
    # Models would make the same of it, but what validates their values would have to be made first.
    action = action_in(tree, reader) if straight is None else straight[0]
    if action is None or action.faulty or len(reader.problems):
        return None
    if worth:
        _learn(written, whole, item, tree, action)
    return action


def _learn(written: Format, whole: Source, item: Item, tree: Keyed, action: Action) -> None:
    # Here, because few files have so many of one form that it pays.
    from orchestra.load.alike.casting import learned  # noqa: PLC0415

    with suppress(UnlikeError):
        form = learned(tree, action, whole, item.begin, item.end, written.MANNER)
        written.FORMS.keep(item.beginning, form)
