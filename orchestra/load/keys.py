"""The keys of a mapping as its entity knows them: `-` and `_` are alike, other spellings are reported.

What is clearly a slip of the keys is read as what was meant, so that a value behind it is checked too and nothing that
depends on it is reported missing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, Protocol

from orchestra.description.actions import ACTIONS
from orchestra.description.source import Keyed, Listed
from orchestra.errors import Code
from orchestra.load.elements import Tagged, emptied, noun
from orchestra.load.pairs import whole_item, written_item
from orchestra.load.words import ELSEWHERE, HINTS, KEYS_ELSEWHERE, REMARKS, snake
from orchestra.nearest import is_slip, nearest
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.description.source import Written
    from orchestra.location import Span


_JOINED: Final = pattern(r"([\w-]+)\s*(:=|=|:)\s*(.+)")  # `exec:talker`, `exec=talker`
_SHORTEST: Final = 3  # letters that another word may be the beginning of


class Report(Protocol):
    """Takes an error in the file that is being read."""

    def __call__(
        self,
        code: Code,
        message: str,
        span: Span,
        *,
        suggestion: str | None = ...,
        notes: Iterable[str] = ...,
    ) -> None:
        """Report it."""


def spelled(key: str) -> str:
    """Return how a word of the launch language is spelled in the models."""
    return key.replace("-", "_") if "-" in key else key


def meant(word: str, known: Iterable[str], elsewhere: Mapping[str, str]) -> tuple[str | None, bool]:
    """Return the known word that another one probably means, and whether it is only a slip."""
    known = frozenset(known)
    for spelling in (spelled(word), snake(word)):
        if (other := elsewhere.get(spelling)) in known:
            return other, is_slip(word, other)
    near = nearest(word, known)
    if near is not None:
        return near, is_slip(word, near)
    alias = nearest(snake(word), (name for name, other in elsewhere.items() if other in known))
    return (elsewhere[alias], False) if alias is not None and is_slip(snake(word), alias) else (None, False)


def key_meant(word: str, known: Iterable[str]) -> tuple[str | None, bool]:
    """Return the known key that another word probably means, and whether it is only a slip."""
    known = frozenset(known)
    others = {name: next((key for key in keys if key in known), "") for name, keys in KEYS_ELSEWHERE.items()}
    near, slip = meant(word, known, others)
    return (near, slip) if near is not None else (_begun(word, known), False)


def _begun(word: str, known: frozenset[str]) -> str | None:
    """Return the one key that a word is the beginning of: `desc` of `description`."""
    found = [key for key in known if key.startswith(snake(word))] if len(word) >= _SHORTEST else []
    return found[0] if len(found) == 1 else None


def action_meant(word: str) -> tuple[str | None, bool]:
    """Return the action that an unknown one probably means, and whether it is only a slip."""
    return meant(word, ACTIONS, ELSEWHERE)


def known_keys(
    known: frozenset[str], mapping: Keyed, report: Report, required: frozenset[str] = frozenset()
) -> Keyed:
    """Return the mapping with no keys but known ones; every other key is reported, and so is one that stands twice.

    Where one of the `required` ones lacks, a key that is like no other probably means that one.
    """
    if mapping.keys() <= known:
        return mapping
    read = emptied(mapping)
    read.lossy, read.meant = mapping.lossy, mapping.meant
    free = known - {spelled(key) for key in mapping}
    strangers = _Strangers(known, required & free, mapping)
    for key, value in mapping.items():
        at, name = mapping.keys_at[key], spelled(key)
        if name not in known:
            near, slip = _near(key, free, known, mapping)
            if near is None or not slip:
                stands_for = strangers.told(key, at, near, report)
                read.lossy = True
                read.meant |= stands_for
                free -= stands_for
                continue
            report(Code.UNKNOWN_KEY, f"unknown {noun(mapping, key)}", at, suggestion=as_written(near, key))
            name, free = near, free - {near}
        if isinstance(mapping, Tagged) and isinstance(read.get(name), Listed) and isinstance(value, Listed):
            read[name].extend(value)
        elif name in read:
            first = f"first at {read.keys_at[name]}"
            report(Code.DUPLICATE_KEY, f"the {noun(mapping, key)} stands twice", at, notes=(first,))
        else:
            read.put(name, value, at)
    read.update(strangers.meant)
    return read


def _near(key: str, free: frozenset[str], known: frozenset[str], mapping: Keyed) -> tuple[str | None, bool]:
    """Return the key that another one probably means, and whether it is only a slip.

    In XML it is rather one of the same form, and an element may be one more of those that there are.
    """
    if isinstance(mapping, Tagged):
        alike = free & mapping.elements if key in mapping.elements else free - mapping.elements
        again = {name for name in mapping.elements if isinstance(mapping.get(name), Listed)} - {key}
        near, slip = key_meant(key, alike | (again & known if key in mapping.elements else frozenset()))
        if slip or (near is not None and key in mapping.elements):
            return near, slip
    return key_meant(key, free)


class _Strangers:
    """Tells the keys of a mapping that are no slips of known ones; `lacking` are those that it cannot be without."""

    def __init__(self, known: frozenset[str], lacking: frozenset[str], mapping: Keyed) -> None:
        self.known = known
        self.lacking = lacking
        self.mapping = mapping
        self.pair = written_item(known, mapping)
        self.meant = dict[str, Any]()  # what other keys are worth with a stranger
        self.pairs_with_value = known >= {"name", "value"} and "value" not in mapping
        self.present = known & {spelled(key) for key in mapping}

    def hint(self, key: str) -> str | None:
        """Return what does what an unknown key is meant to do: another action, or a key that stands here already."""
        known, hint = HINTS.get(snake(key), (frozenset(), None))
        if not self.known.isdisjoint(known):
            return hint
        taken = next((other for other in KEYS_ELSEWHERE.get(snake(key), ()) if other in self.present), None)
        return None if taken is None else f"'{taken}' stands here already"

    def remark(self, key: str, near: str) -> str | None:
        """Return what else than the key that is suggested may have been meant."""
        beside, remark = REMARKS.get((snake(key), near), ("", None))
        return remark if beside in self.known else None

    def told(self, key: str, at: Span, near: str | None, report: Report) -> frozenset[str]:
        """Report a key; return the known ones that it stands for, which are not missing then."""
        message, instead, notes = f"unknown {noun(self.mapping, key)}", near, list[str]()
        hint = self.hint(key) if near is None else self.remark(key, near)
        if hint is not None:
            message += f": {hint}"
        stands_for = frozenset() if near is None else frozenset({near})
        joined = _JOINED.fullmatch(key)
        if joined is not None and spelled(joined[1]) in self.known:
            message, instead = _parted(*joined.groups())
            stands_for = frozenset({spelled(joined[1])})
        elif self.pairs_with_value and (made := _made(key, self.mapping)) is not None:
            at, instead = made
            stands_for = frozenset({"value"})
        elif near is None and "file" in self.known and (joint := _packaged(key, self.mapping)) is not None:
            at, instead, self.meant["file"] = joint
        elif near is None and (above := _of_item_above(key, self.mapping)) is not None:
            message = f"'{key}' belongs to the last item of '{above}': indent it as that"
            stands_for = frozenset({key})
        elif near is None and self.pair is not None:
            whole = whole_item(self.mapping)
            if whole is not None:
                at, instead = whole, self.pair[1]
            else:
                notes.append(f"it is written {self.pair[1]}")
            stands_for = frozenset(self.pair[0])
        elif near is None and self.lacking:
            alone = isinstance(self.mapping, Tagged) and len(self.lacking) == len(self.mapping) == 1
            instead = next(iter(self.lacking)) if alone else _abbreviated(key, self.lacking)
            notes += [
                f"the {noun(self.mapping, name)} is missing" for name in sorted(self.lacking) if not instead
            ]
            stands_for = frozenset({instead}) if instead is not None else self.lacking
        self.lacking -= stands_for
        suggestion = instead if instead is None or " " in instead else as_written(instead, key)
        report(Code.UNKNOWN_KEY, message, at, suggestion=suggestion, notes=notes)
        return stands_for


def _parted(key: str, sign: str, value: str) -> tuple[str, str]:
    """Return what is wrong with a key and a value that a sign joins to one text, and how they are written."""
    if sign == ":":
        return f"a blank is missing behind '{key}:'", f"{key}: {value}"
    return f"a colon and a blank stand between '{key}' and its value, not '{sign}'", f"{key}: {value}"


def _abbreviated(word: str, known: frozenset[str]) -> str | None:
    """Return the one known word of which another one has the first letter and others in order: `msg` of `message`."""
    found = [name for name in known if name[:1] == word[:1].lower() and _is_within(snake(word), name)]
    return found[0] if len(found) == 1 else None


def _is_within(word: str, name: str) -> bool:
    letters = iter(name)
    return all(letter in letters for letter in word)


def as_written(key: str, word: str) -> str:
    """Return a key with the joint of the word that stands for it."""
    return key.replace("_", "-") if "-" in word and "_" not in word else key


def _made(key: str, mapping: Keyed) -> tuple[Span, str] | None:
    """See `made_value`, which only an unknown key needs."""
    from orchestra.load.made_values import made_value  # noqa: PLC0415

    return made_value(key, mapping)


def _packaged(key: str, mapping: Keyed) -> tuple[Span, str, Written] | None:
    """See `packaged`, which only an unknown key needs."""
    from orchestra.load.made_values import packaged  # noqa: PLC0415

    return packaged(key, mapping)


def _of_item_above(key: str, mapping: Keyed) -> str | None:
    """See `of_item_above`, which only an unknown key needs."""
    from orchestra.load.made_values import of_item_above  # noqa: PLC0415

    return of_item_above(key, mapping)
