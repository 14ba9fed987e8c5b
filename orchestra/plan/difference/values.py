"""Value by value: what differs between two states of one process or component, and where each value is written."""

from __future__ import annotations

import json
from difflib import SequenceMatcher
from itertools import zip_longest
from typing import TYPE_CHECKING, Any, Final

from orchestra.plan.codec import encode
from orchestra.plan.difference.model import Change
from orchestra.plan.model import Candidate

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

    from orchestra.location import Location
    from orchestra.plan.conditions import Dependency
    from orchestra.plan.difference.model import Side
    from orchestra.plan.model import Component, Process, Via

    Writers = Mapping[str, Candidate]

# Fields of a process that say nothing of their own: the command line, the names and the file say it.
_SAID_ELSEWHERE: Final = frozenset({"prefix", "arguments", "package", "executable", "warm", "machine"})
# Fields that are compared piece by piece, and those that make no difference.
_PIECEWISE: Final = frozenset(
    {"command", "environment", "parameters", "remappings", "parameter_files", "depends_on"}
)
_OF_NO_EFFECT: Final = frozenset({"id", "digest", "location", "provenance"})


def _absent(*, before: bool, after: bool) -> Side | None:
    """Return on which side there is no value, given on which there is one."""
    if before and after:
        return None
    return "after" if before else "before"


def same(one: object, other: object) -> bool:
    """Return whether two values are the same to a plan: `1` is neither `1.0` nor `true`."""
    return one is other or _text(one) == _text(other)


def _text(value: object) -> str:
    return json.dumps(encode(value), sort_keys=True)


def changes(before: Process | Component, after: Process | Component) -> tuple[Change, ...]:
    """Return what differs between two states of one process, or of one component."""
    found = [
        *_names(before, after),
        *_mapped("parameters", before.parameters, after.parameters, _parameters(before), _parameters(after)),
        *_remappings(before, after),
    ]
    if hasattr(before, "command") and hasattr(after, "command"):
        found += _of_process(before, after)  # type: ignore[arg-type]  # only a process has one
    return (*found, *_others(before, after))


def _names(before: Process | Component, after: Process | Component) -> Iterator[Change]:
    for word in ("name", "namespace"):
        one, other = getattr(before, word), getattr(after, word)
        if one != other:
            yield Change(
                word, None, one, other, getattr(before.provenance, word), getattr(after.provenance, word)
            )


def _of_process(before: Process, after: Process) -> Iterator[Change]:
    yield from _words(before, after)
    one, other = before.provenance.environment, after.provenance.environment
    yield from _mapped("environment", before.environment, after.environment, _last(one), _last(other))
    files = [{file.path: file.content for file in process.parameter_files} for process in (before, after)]
    yield from _files(files[0], files[1], before, after)
    yield from _dependencies(before, after)


def _words(before: Process, after: Process) -> Iterator[Change]:
    """Yield the stretches of the command line that differ, but for what the plan puts at its end for a node."""
    old, new = _written(before), _written(after)
    read = _new(before, after), _new(after, before)
    for tag, begin, end, new_begin, new_end in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if tag == "equal":
            continue
        gone, come = list(old[begin:end]) or None, list(new[new_begin:new_end]) or None
        absent = _absent(before=gone is not None, after=come is not None)
        place = f"word {begin + 1}"
        yield Change("command", place, gone, come, before.location, after.location, absent, *read)


def _new(process: Process, other: Process) -> tuple[Via, ...]:
    """Return what was read for the words of one process and had another value for those of the other."""
    known = {(via.kind, via.name, via.value) for via in other.provenance.command}
    return tuple(via for via in process.provenance.command if (via.kind, via.name, via.value) not in known)


def _written(process: Process) -> tuple[str, ...]:
    """Return the words before the last `--ros-args`: names, rules and the parameter file follow it."""
    words = process.command
    if process.kind == "process" or "--ros-args" not in words:
        return words
    return words[: len(words) - 1 - words[::-1].index("--ros-args")]


def _files(before: dict[str, str], after: dict[str, str], old: Process, new: Process) -> Iterator[Change]:
    """Yield the lines that differ in what is passed on for other nodes, but for those of parameters that are told."""
    path = next(iter({**after, **before}), "")
    told = {name for name in {**old.parameters, **new.parameters} if _differs(name, old, new)}
    one, other = (list(_passed_on(texts.values(), told)) for texts in (before, after))
    for tag, begin, end, new_begin, new_end in SequenceMatcher(
        None, one, other, autojunk=False
    ).get_opcodes():
        if tag != "equal":
            gone, come = one[begin:end] or None, other[new_begin:new_end] or None
            absent = _absent(before=gone is not None, after=come is not None)
            yield Change("parameter_files", path, gone, come, old.location, new.location, absent)


def _passed_on(texts: Iterable[str], told: Collection[str]) -> Iterator[str]:
    """Yield the lines of parameter files but for these parameters; a heading only where something is below it."""
    headings: list[str] = []
    lines = [line for text in texts for line in text.splitlines()]
    if not told:
        yield from lines
        return
    for line in lines:
        if not line.startswith("    "):
            headings = [heading for heading in headings if line.startswith(" ")] + [line]
        elif line.strip().partition(": ")[0].strip('"') not in told:
            yield from headings
            yield line
            headings = []


def _differs(name: str, old: Process, new: Process) -> bool:
    return not same(old.parameters.get(name), new.parameters.get(name))


def _remappings(before: Process | Component, after: Process | Component) -> Iterator[Change]:
    """Yield rules that differ: by the name that they remap where their order is the same, else one by one."""
    old, new = before.remappings, after.remappings
    if old == new:
        return
    one, other = dict(old), dict(new)
    places = (_rules(before), _rules(after))
    if len(one) == len(old) and len(other) == len(new) and _in_order(one, other):
        yield from _mapped("remappings", one, other, *places)
        return
    for number, (rule, another) in enumerate(zip_longest(old, new), 1):
        if rule != another:
            yield Change(
                "remappings",
                f"rule {number}",
                None if rule is None else list(rule),
                None if another is None else list(another),
                _place(rule, places[0]),
                _place(another, places[1]),
                _absent(before=rule is not None, after=another is not None),
            )


def _place(rule: tuple[str, str] | None, known: Writers) -> Location | None:
    return known[rule[0]].location if rule is not None and rule[0] in known else None


def _in_order(one: Mapping[str, str], other: Mapping[str, str]) -> bool:
    """Return whether the names that both have come in the same order: the first rule that matches counts."""
    return [name for name in one if name in other] == [name for name in other if name in one]


def _dependencies(before: Process, after: Process) -> Iterator[Change]:
    old = {(edge.process, edge.condition): edge for edge in before.depends_on}
    new = {(edge.process, edge.condition): edge for edge in after.depends_on}
    for key in dict.fromkeys((*new, *old)):
        one, other = old.get(key), new.get(key)
        if not same(_waited(one), _waited(other)):
            yield Change(
                "depends_on",
                f"{key[0]} {key[1]}",
                _waited(one),
                _waited(other),
                one.location if one else None,
                other.location if other else None,
                _absent(before=one is not None, after=other is not None),
            )


def _waited(edge: Dependency | None) -> dict[str, Any] | None:
    return None if edge is None else {"timeout": edge.timeout, "required": edge.required}


def _others(before: Process | Component, after: Process | Component) -> Iterator[Change]:
    """Yield the fields that are one value each."""
    fields = before.__dataclass_fields__
    for name in fields:
        if name in _OF_NO_EFFECT | _PIECEWISE | {"name", "namespace"}:
            continue
        if name in _SAID_ELSEWHERE and hasattr(before, "command"):
            continue
        one, other = getattr(before, name), getattr(after, name)
        if not same(one, other):
            yield Change(name, None, encode(one), encode(other), before.location, after.location)


def _mapped(
    field: str, before: Mapping[str, Any], after: Mapping[str, Any], old: Writers, new: Writers
) -> Iterator[Change]:
    for name in dict.fromkeys((*after, *before)):
        if name in before and name in after and same(before[name], after[name]):
            continue
        yield Change(
            field,
            name,
            encode(before.get(name)),
            encode(after.get(name)),
            old[name].location if name in old and name in before else None,
            new[name].location if name in new and name in after else None,
            _absent(before=name in before, after=name in after),
            old[name].through if name in old else (),
            new[name].through if name in new else (),
        )


def _parameters(record: Process | Component) -> Writers:
    return _last(record.provenance.parameters)


def _last(written: Mapping[str, Sequence[Candidate]]) -> Writers:
    """Return the values that count."""
    winners = {name: [item for item in candidates if item.won] for name, candidates in written.items()}
    return {name: found[-1] for name, found in winners.items() if found}


def _rules(record: Process | Component) -> Writers:
    """Return for each name the first rule for it, which is the one that counts."""
    found: dict[str, Candidate] = {}
    for index, (rule, location) in enumerate(
        zip(record.remappings, record.provenance.remappings, strict=False)
    ):
        known = record.provenance.remapping_values
        through = known[index] if index < len(known) else ()
        found.setdefault(rule[0], Candidate(rule[1], location, True, "the first rule that matches", through))
    return found
