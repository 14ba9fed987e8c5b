"""NoDL 1: interfaces of executables in XML (`*.nodl.xml`).

An `interface` holds `node`s with `name` and `executable`; in them are `topic`, `service` and `action` with `name`,
`type` and `role` (`publisher`, `subscription`, `server`, `client`, `both`), or with the roles as attributes that are
`true`, as it was before. A `qos` in a topic gives policies. Source: the schema of the reference implementation.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final
from xml.parsers import expat

from orchestra.dataclass import dataclass
from orchestra.declared.interfaces.model import Endpoint, EndpointKind, Interface, Qos
from orchestra.declared.interfaces.words import full_type, policy
from orchestra.errors import Code, Problems
from orchestra.fields import field
from orchestra.location import Location, Span, displayed, point
from orchestra.nearest import nearest

# By element: its roles, and the kinds of endpoints that they are.
_ROLES: Final[dict[str, dict[str, EndpointKind]]] = {
    "topic": {"publisher": "publishers", "subscription": "subscriptions"},
    "service": {"server": "service_servers", "client": "service_clients"},
    "action": {"server": "action_servers", "client": "action_clients"},
}
_BOTH: Final = "both"


def read_nodl(path: str, named_at: Location, problems: Problems) -> dict[str, Interface]:
    """Return the interfaces in a file by executable; what is wrong with it is reported."""
    file = displayed(path)
    chain = (named_at.span, *named_at.included_from)
    try:
        content = Path(path).read_bytes()
    except OSError as error:
        problems.error(Code.UNREADABLE_FILE, f"cannot read {file}: {error}", Location(point(file), chain))
        return {}
    reading = _Reading(file, chain, problems)
    parser = expat.ParserCreate()
    reading.parser = parser
    parser.StartElementHandler = reading.begin
    parser.EndElementHandler = reading.end
    parser.StartDoctypeDeclHandler = reading.refuse_doctype
    try:
        parser.Parse(content, True)
    except expat.ExpatError as error:
        told = f"not XML: {expat.ErrorString(error.code)}"
        problems.error(Code.BROKEN_DECLARATION, told, reading.at(error.lineno, error.offset))
    except _StopError:
        pass  # why has been reported
    return reading.found


class _StopError(Exception):
    """There is no going on."""


@dataclass(slots=True)
class _Reading:
    file: str
    chain: tuple[Span, ...]
    problems: Problems
    parser: expat.XMLParserType | None = None
    found: dict[str, Interface] = field(default_factory=dict)
    node: dict[str, str] = field(default_factory=dict)
    endpoints: list[Endpoint] = field(default_factory=list)
    first: int = 0  # of the endpoints that the element at hand has made

    def begin(self, tag: str, attributes: dict[str, str]) -> None:
        """Take the beginning of an element."""
        if tag == "node":
            self.node, self.endpoints = attributes, []
        elif tag in _ROLES:
            self.first = len(self.endpoints)
            self.endpoints += self.endpoints_of(tag, attributes)
        elif tag == "qos":
            self.endpoints[self.first :] = [
                Endpoint(item.kind, item.name, item.type, self.qos(attributes))
                for item in self.endpoints[self.first :]
            ]

    def end(self, tag: str) -> None:
        """Take the end of an element."""
        executable = self.node.get("executable") or self.node.get("name")
        if tag == "node" and executable:
            self.found.setdefault(executable, Interface(tuple(self.endpoints), self.node.get("name")))

    def endpoints_of(self, tag: str, attributes: dict[str, str]) -> list[Endpoint]:
        """Return what an element declares: one endpoint, or two."""
        roles = _ROLES[tag]
        role = attributes.get("role")
        chosen = [
            word for word in roles if role in (word, _BOTH) or attributes.get(word, "").lower() == "true"
        ]
        name, word = attributes.get("name"), attributes.get("type")
        if not name or not word:
            self.refuse(f"<{tag}> needs a name and a type")
        elif role is not None and not chosen:
            self.refuse(f"'{role}' is no role of a {tag}", nearest(role, [*roles, _BOTH]))
        else:
            types = [(kind, full_type(word, kind)) for kind in (roles[item] for item in chosen)]
            if any(kind is None for _, kind in types):
                self.refuse(f"'{word}' is no type of an interface, as std_msgs/msg/String")
            return [Endpoint(kind, name, full) for kind, full in types if full is not None]
        return []

    def qos(self, attributes: dict[str, str]) -> Qos:
        """Return the policies; durations have had several units, and are left out."""
        words: dict[str, str | None] = {}
        for key in ("reliability", "durability", "liveliness"):
            try:
                words[key] = policy(key, attributes.get(key, ""))
            except ValueError as error:
                self.refuse(str(error.args[0]), error.args[1])
        return Qos(**words)  # type: ignore[arg-type]  # three of the words

    def refuse(self, told: str, meant: str | None = None) -> None:
        """Report what is wrong with the element at hand."""
        notes = () if meant is None else (f"did you mean '{meant}'?",)
        assert self.parser is not None  # noqa: S101 - it is set before anything is read
        at = self.at(self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber)
        self.problems.error(Code.BROKEN_DECLARATION, told, at, notes=notes)

    def refuse_doctype(self, *_: object) -> None:
        """Go no further: entities can come to any length."""
        self.refuse("a declaration has no document type")
        raise _StopError

    def at(self, line: int, column: int) -> Location:
        """Return a place in the file, given a column that counts from 0."""
        return Location(Span(self.file, line, column + 1, line, column + 2), self.chain)
