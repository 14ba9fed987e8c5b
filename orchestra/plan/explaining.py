"""Why a node has the values that it has: all that was written for each, in order, and the rule by which one counts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.nearest import nearest
from orchestra.plan.explained import Explained, Explanation, Subject
from orchestra.plan.remapping_order import rules_for

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from orchestra.plan.model import Component, Plan, Process

_SIGNS = {".": "parameter", ":": "remapping", "$": "environment"}
_BEHIND = {
    ".": "the name of a parameter",
    ":": "the name of a topic or service",
    "$": "the name of a variable",
}


class UnknownSubjectError(ValueError):
    """There is nothing of this name to explain; `meant` is what it is most like, if there is such a thing."""

    def __init__(self, what: str, meant: str | None) -> None:
        super().__init__(f"{what}; did you mean '{meant}'?" if meant else what)
        self.meant = meant


def explain(plan: Plan, target: str, inherited: Mapping[str, str]) -> Explanation:
    """Explain `NODE`, `NODE.PARAMETER`, `NODE:NAME` (of a topic or service) or `NODE$VARIABLE`.

    `inherited` is the environment that a process has where the description changes nothing. Raises
    `UnknownSubjectError`.
    """
    record, sign, name = _found(plan, target)
    if sign and not name:
        raise UnknownSubjectError(f"'{target}' is not all: {_BEHIND[sign]} stands behind the '{sign}'", None)
    match _SIGNS.get(sign):
        case "parameter":
            values = list(_parameters(record, name))
        case "remapping":
            values = _remapping(record, name)
        case "environment":
            values = [_variable(record, name, inherited)]
        case _:
            values = list(_everything(record))
    kind = getattr(record, "kind", "component")
    return Explanation(record.id, kind, record.location, tuple(values))


def _found(plan: Plan, target: str) -> tuple[Process | Component, str, str]:
    """Return the node that a text begins with (of several, the longest name), the sign behind it, and the rest."""
    records: list[Process | Component] = [*plan.processes, *plan.components]
    named = {record.id.removeprefix("/"): record for record in records}
    text = target.removeprefix("/")
    for length in range(len(text), 0, -1):
        record = named.get(text[:length])
        if record is not None and (length == len(text) or text[length] in _SIGNS):
            return record, text[length : length + 1], text[length + 1 :]
    end = min((text.index(sign) for sign in _SIGNS if sign in text), default=len(text))
    meant = nearest(text[:end], named)
    what = f"no process or component is called '{target[: len(target) - len(text) + end]}'"
    raise UnknownSubjectError(what, named[meant].id if meant else None)


def _everything(record: Process | Component) -> Iterator[Explained]:
    for word in ("name", "namespace"):
        written = record.provenance.naming.get(word, ())
        value = getattr(record, word)
        if written or value is not None:
            subject: Subject = "name" if word == "name" else "namespace"
            yield Explained(subject, word, value, written)
    for name in record.provenance.parameters:
        yield _parameter(record, name)
    seen = dict.fromkeys(source for source, _ in record.remappings)
    for source in seen:
        yield from rules_for(record, source)
    for name in record.provenance.environment:
        yield _variable(record, name, {})


def _parameters(record: Process | Component, name: str) -> Iterator[Explained]:
    """Yield the parameter, else all those below this name."""
    known = record.provenance.parameters
    found = [name] if name in known else [other for other in known if other.startswith(f"{name}.")]
    if not found:
        raise UnknownSubjectError(f"nothing sets the parameter '{name}' of {record.id}", nearest(name, known))
    yield from (_parameter(record, other) for other in found)


def _parameter(record: Process | Component, name: str) -> Explained:
    return Explained("parameter", name, record.parameters.get(name), record.provenance.parameters[name])


def _remapping(record: Process | Component, name: str) -> list[Explained]:
    try:
        return rules_for(record, name)
    except ValueError as error:
        raise UnknownSubjectError(
            str(error), _near(name, (source for source, _ in record.remappings))
        ) from None


def _variable(record: Process | Component, name: str, inherited: Mapping[str, str]) -> Explained:
    written = record.provenance.environment.get(name)
    if written:
        note = f"without the description it would be '{inherited[name]}'" if name in inherited else None
        return Explained("environment", name, written[-1].value, written, note)
    whole = getattr(record, "inherit_environment", True)
    if name in inherited and whole:
        return Explained("environment", name, inherited[name], (), "the description does not change it")
    known = [*record.provenance.environment, *(inherited if whole else ())]
    raise UnknownSubjectError(f"nothing sets the variable '{name}' for {record.id}", nearest(name, known))


def _near(name: str, known: Iterable[str]) -> str | None:
    return nearest(name, known)
