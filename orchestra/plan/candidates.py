"""All that was written for a setting of a node: in order, with the rule by which each counts or does not."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.location import is_python
from orchestra.plan.model import Candidate, Via, new_candidate, new_via

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.location import Location, Span
    from orchestra.resolve.context import Read, Value
    from orchestra.resolve.model import EnvironmentChange, ParameterSource
    from orchestra.resolve.rcl.effective import Setting

FROM_COMMAND_LINE = "the command line wins"
_OVERRULED = "overruled by the command line"
# Of a chain that branches, so many variables are told, and so many characters of the value of each.
_MOST = 16
_LONGEST = 200


class Origins:
    """The parameters and files of a node for which something was read, the last one first.

    What a file in YAML or XML says has its place as one object. `in_code`: places in Python are compared.
    """

    __slots__ = ("in_code", "sources")

    def __init__(self, sources: Sequence[ParameterSource], *, in_code: bool) -> None:
        self.sources = sources
        self.in_code = in_code

    def at(self, span: Span, chain: tuple[Span, ...]) -> ParameterSource | None:
        """Return the one that is written at a place."""
        for source in self.sources:
            if source.location.span is span and source.location.included_from == chain:
                return source
        # To compare places in Python they are worked out, and none is in a file of another kind.
        for source in self.sources if self.in_code and is_python(span) else ():
            around = source.location.included_from
            if len(around) == len(chain) and source.location.span == span and around == chain:
                return source
        return None


def origins(sources: Sequence[ParameterSource]) -> Origins:
    """Return what was read for the parameters of a node."""
    found = [source for source in reversed(sources) if source.through or getattr(source, "within", ())]
    return Origins(found, in_code=any(is_python(source.location) for source in found))


def passage(through: Sequence[Read]) -> tuple[Via, ...]:
    """Return what was read on the way to a value, each once: what is behind one follows it, a step deeper."""
    if not through:
        return ()
    if len(through) == 1 and not through[0].through:
        return (_via(through[0], 0),)
    found: list[Via] = []
    seen: set[tuple[str, str, int]] = set()
    waiting = [(read, 0) for read in reversed(through)]
    while waiting and len(found) < _MOST:
        read, depth = waiting.pop()
        key = (read.kind, read.name, id(read.location))  # a variable that is set has one object for its place
        if key in seen:
            continue
        seen.add(key)
        found.append(_via(read, depth))
        waiting += [(other, depth + 1) for other in reversed(read.through)]
    return tuple(found)


def _via(read: Read, depth: int) -> Via:
    value = read.value if len(read.value) <= _LONGEST else f"{read.value[:_LONGEST]}..."
    return new_via(read.kind, read.name, value, read.setter, read.location, depth)


def behind(location: Location, known: Origins) -> tuple[Via, ...]:
    """Return what was read to make the value at a place.

    For one in a file that is what was read in that place of it, and then what was read to make its path.
    """
    if not known.sources:
        return ()
    chain = location.included_from
    source = known.at(location.span, chain)
    if source is not None:
        return passage(source.through)
    source = known.at(chain[0], chain[1:]) if chain else None
    if source is None:
        return ()
    within = getattr(source, "within", ())
    inside = [read for span, reads in within if _touch(span, location.span) for read in reads]
    return passage([*inside, *source.through])


def _touch(one: Span, other: Span) -> bool:
    """Return whether two spans of one file have something in common."""
    starts = (one.line, one.column), (other.line, other.column)
    ends = (one.end_line, one.end_column), (other.end_line, other.end_column)
    return starts[0] < ends[1] and starts[1] < ends[0]


def of_parameter(below: Setting | None, above: Setting | None, known: Origins) -> tuple[Candidate, ...]:
    """Return all values of one parameter: those of the description, then those of the command line, which win."""
    if (
        above is None and below is not None and len(below.written) == 1 and below.written[0].won
    ):  # as nearly always
        entry = below.written[0].entry
        through = behind(entry.location, known)
        return (new_candidate(entry.value, entry.location, True, below.rule, through),)
    written: list[Candidate] = []
    if below is not None:
        written += [
            new_candidate(
                item.value,
                item.location,
                item.won and above is None,
                rule if above is None else f"set for '{item.pattern}', {_OVERRULED}",
                behind(item.location, known),
            )
            for item, rule in zip(below.written, _rules(below), strict=True)
        ]
    if above is not None:
        written += [
            new_candidate(
                item.value,
                item.location,
                item.won,
                FROM_COMMAND_LINE if item.won else f"of the command line, but {rule}",
            )
            for item, rule in zip(above.written, _rules(above), strict=True)
        ]
    return tuple(written)


def _rules(setting: Setting) -> Iterator[str]:
    """Yield for each value that is written why it counts, or does not."""
    counting = next((place for place, item in enumerate(setting.written) if item.won), None)
    for place, item in enumerate(setting.written):
        if counting is None or item.won:
            yield setting.rule
        elif setting.written[counting].pattern != item.pattern:
            winner = setting.written[counting].pattern
            yield f"set for '{item.pattern}', which appears before '{winner}' does"
        elif place > counting:
            yield f"set for '{item.pattern}', but {setting.rule}"
        else:
            yield f"set for '{item.pattern}' before the value that counts"


def of_environment(changes: Sequence[EnvironmentChange]) -> tuple[Candidate, ...]:
    """Return all values of one variable; the last one counts."""
    last = len(changes) - 1
    rules = ("the last one counts", "set before the value that counts")
    return tuple(
        new_candidate(
            change.value, change.location, index == last, rules[index != last], passage(change.through)
        )
        for index, change in enumerate(changes)
    )


def of_name(name: Value | None) -> tuple[Candidate, ...]:
    """Return the one name that the description gives to a node."""
    if name is None:
        return ()
    return (new_candidate(name.text, name.location, True, "the name of the node", passage(name.through)),)


def of_namespace(namespace: Value | None) -> tuple[Candidate, ...]:
    """Return the namespace that is pushed where a node stands, and the one of its own, which may be below it."""
    if namespace is None:
        return ()
    around = next((read for read in namespace.through if read.kind == "namespace"), None)
    if around is None or around.location is None:
        rule = "the namespace of the node itself"
        return (new_candidate(namespace.text, namespace.location, True, rule, passage(namespace.through)),)
    behind_it = passage(around.through)
    if around.location == namespace.location:
        rule = "pushed for all that stands below it"
        return (new_candidate(namespace.text, around.location, True, rule, behind_it),)
    below = namespace.text.startswith(f"{around.value.rstrip('/')}/")
    rules = (
        ("pushed for all that stands below it", "the namespace of the node itself, below what is pushed")
        if below
        else ("pushed, but the node has an absolute namespace", "the absolute namespace of the node itself")
    )
    own = passage([read for read in namespace.through if read is not around])
    return (
        new_candidate(around.value, around.location, False, rules[0], behind_it),
        new_candidate(namespace.text, namespace.location, True, rules[1], own),
    )
