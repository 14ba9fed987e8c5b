"""The states of rcl's parser of parameter files, event by event."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problems
from orchestra.fields import field, replace
from orchestra.location import Location, Span, new_location
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.hollow import Hollow
from orchestra.resolve.rcl.joined import Joined, joined
from orchestra.resolve.rcl.nesting import NESTED, Nesting
from orchestra.resolve.rcl.opened import OpenList, OpenParameter, OpenSection, Unreadable
from orchestra.resolve.rcl.patterns import instead, pattern_fault
from orchestra.resolve.rcl.sections import Section, new_entry
from orchestra.resolve.rcl.strays import SECTION_KEY, Key, Strays, is_misspelt_section, is_section
from orchestra.resolve.rcl.values import scalar, span_of_events, terminated

if TYPE_CHECKING:
    from orchestra.values import ParameterValue

_BELOW = f"stands below one that has '{SECTION_KEY}' itself, which rcl cannot read: write its full name apart"
ALIAS = "rcl does not take aliases"
_NO_KEY, _NO_DOCUMENT = "a key must not be empty", "rcl does not take an empty document"


@dataclass(slots=True)
class Reader:
    """Takes the events of a file one by one; `sections` returns what they came to.

    `inside` (a `ros__parameters` mapping), `fresh` (a mapping whose first key is to come), `depth`, `node` and
    `group` are rcl's states. `keys` are the keys of the open mappings: what the file plainly says.
    """

    file: str
    problems: Problems
    included_from: tuple[Span, ...]
    template: bool = False  # `$(...)` in it may be evaluated before rcl reads it
    inside: bool = False
    expects_key: bool = True
    fresh: bool = False
    depth: int = 0
    node: Joined = field(default_factory=lambda: Joined("/"))
    group: Joined = field(default_factory=lambda: Joined("."))
    keys: list[str] = field(default_factory=list)
    node_depth: int = 0  # how many of `keys` lead to the section
    last_key: str = ""
    last_key_at: Location | None = None
    key_places: list[Location | None] = field(default_factory=list)  # those of `keys`
    before_key: Joined = field(default_factory=lambda: Joined("/"))
    parameter: OpenParameter | None = None
    lists: list[OpenList] = field(default_factory=list)
    emptied: Location | None = None
    lost: bool = False  # not all sections are what the file means
    strays: Strays = field(init=False)
    hollow: Hollow = field(init=False)
    nesting: Nesting = field(init=False)
    found: list[OpenSection] = field(default_factory=list)

    def __post_init__(self) -> None:
        told = self.problems
        self.strays, self.hollow, self.nesting = Strays(told), Hollow(told), Nesting(told)

    def sections(self) -> tuple[Section, ...]:
        """Return the sections read so far."""
        self.strays.end(0)
        sound = (section for section in self.found if section.sound)
        return tuple(Section(section.pattern, tuple(section.entries), section.location) for section in sound)

    def take(self, event: Any) -> None:  # noqa: ANN401 - an event of any kind
        """Go on by one event. Raises `Unreadable` where there is no going on."""
        kind = type(event)
        within = self.nesting.open or (self.expects_key and self.lists)
        if within and self.nesting.leaves_out(event, self.lists, self.depth, self.at):
            pass
        elif kind is yaml.ScalarEvent:
            (self.key if self.expects_key else self.value)(event)
        elif kind is yaml.MappingStartEvent:
            self.open_mapping(event)
        elif kind is yaml.MappingEndEvent:
            self.close_mapping(event)
        elif kind is yaml.SequenceStartEvent:
            self.open_list(event)
        elif kind is yaml.SequenceEndEvent:
            self.close_list(event)
        elif kind is yaml.AliasEvent:
            self.alias(event)

    def key(self, event: yaml.ScalarEvent) -> None:
        """Take a key: of a node, of the section, of a parameter."""
        name = terminated(event.value)
        if not name:
            raise self.unreadable(_NO_KEY if self.depth else _NO_DOCUMENT, event)
        at = self.at(event)
        beside = not self.inside and self.strays.key(Key(name, at, self.depth), self.keys)
        if self.inside:
            self.parameter_key(name, event, at)
        elif is_section(name) or (self.node.count and is_misspelt_section(name)):
            self.open_section(name, event, told=beside)
        else:
            self.before_key = replace(self.node)
            self.node.grow(name)
        self.last_key, self.last_key_at, self.expects_key = name, at, False

    def open_section(self, name: str, event: yaml.ScalarEvent, *, told: bool) -> None:
        """Take the key `ros__parameters`: rcl looks only at how it begins."""
        at = self.at(event)
        if not self.node.count:
            message = f"'{SECTION_KEY}' must stand below the name of a node"
            raise Unreadable if told else self.unreadable(message, event)
        pattern, said = self.node.text, joined("/", self.keys[1:])
        fault, named = pattern_fault(pattern, template=self.template), self.key_places[-1] or at
        self.lost |= told or fault is not None
        if self.depth - 1 in self.strays.around:
            raise self.unreadable(f"'{self.keys[-1]}' {_BELOW}", event, named)
        if fault is not None:
            self.error(f"'{pattern}' cannot be the name of a node: {fault.reason}", named, instead(self.keys))
        elif pattern != said:
            self.surprise(f"rcl reads this as the section of '{pattern}', not of '{said}'", at)
        if not is_section(name):
            self.error(f"'{name}' is not '{SECTION_KEY}', below which parameters belong", at, SECTION_KEY)
        elif name != SECTION_KEY:
            self.surprise(f"rcl reads '{name}' as '{SECTION_KEY}'", at, SECTION_KEY)
        self.found.append(OpenSection(pattern, named, sound=fault is None))
        self.before_key = replace(self.node)
        self.node.shrink()
        self.node_depth, self.inside, self.parameter = len(self.keys), True, None

    def parameter_key(self, name: str, event: yaml.ScalarEvent, at: Location) -> None:
        """Take the name of a parameter or of a group of them."""
        if self.fresh:
            if self.parameter is None:
                raise self.unreadable(f"this {_BELOW}", event)
            self.group.replace(self.parameter.name)
            self.fresh = False
        slot = self.group.text if self.group.count else name
        whole = f"{slot}.{name}" if self.group.count else name
        said = ".".join([*self.keys[self.node_depth + 1 :], name])
        if whole != said and not self.lists:
            self.surprise(f"rcl reads this as the parameter '{whole}', not '{said}'", at)
        elif is_section(name):
            self.surprise(f"'{name}' stands inside itself: rcl reads '{whole}'", at)
        self.hollow.key(name, self.depth)
        self.parameter = OpenParameter(whole, slot, at)

    def value(self, event: yaml.ScalarEvent) -> None:
        """Take a scalar that is no key: a value, or an item of a list."""
        if self.parameter is None or not self.inside:
            self.misplaced(event)
            return
        try:
            read = scalar(event)
        except ValueError:
            self.hollow.value(self.parameter, event, self.at(event), listed=bool(self.lists))
            self.drop()
            return
        if self.lists:
            self.lists[-1].take(read, event)
        else:
            self.emit(read, self.at(event))
            self.expects_key = True

    def drop(self) -> None:
        """Leave out the value at hand, which has been reported."""
        if self.lists:
            self.lists[-1].sound = False
        else:
            self.expects_key = True

    def misplaced(self, event: yaml.Event) -> None:
        """Report a value above the parameters, and go on as if its key were not there."""
        at, self.lost = self.last_key_at, True
        if self.depth == 0 or at is None:
            raise self.unreadable("a parameter file must be a mapping from nodes to parameters", event)
        empty = isinstance(event, yaml.ScalarEvent) and not event.value and not event.style
        if self.inside and not empty:
            self.strays.no_mapping(event, self.at(event))
        else:
            key, around = Key(self.last_key, at, self.depth), self.key_places[-1]
            self.strays.value(key, self.keys, around, self.emptied, empty=empty)
        self.node, self.inside, self.expects_key = self.before_key, False, True

    def open_mapping(self, event: yaml.MappingStartEvent) -> None:
        """Take the beginning of a mapping: of the file, of a node, of the parameters, of a group."""
        if self.depth and self.expects_key:
            raise self.unreadable("a mapping cannot be a key", event)
        if self.lists:
            self.lists[-1].mapping = self.lists[-1].mapping or self.at(event)
        self.keys.append(self.last_key if self.depth else "")
        self.key_places.append(self.last_key_at)
        self.depth += 1
        section = self.inside and self.depth == self.node.count + 3
        if self.inside and not section and self.parameter is not None:
            self.emit(None, self.at(event), opens=True)
            self.hollow.mapping(event, self.depth)
        self.fresh = not section
        self.expects_key = True

    def close_mapping(self, event: yaml.MappingEndEvent) -> None:
        """Take the end of a mapping. An empty group ends the section for rcl: it has no level of its own to leave."""
        if self.inside and self.fresh and self.found[-1].entries:
            entries = self.found[-1].entries
            entries[-1] = replace(entries[-1], opens=False)
        if self.inside:
            if self.group.count:
                self.group.shrink()
            else:
                self.inside = False
                if len(self.keys) > self.node_depth + 1:
                    self.emptied = self.at(event)
        elif self.depth == self.node.count + 1:
            self.node.shrink()
        self.strays.end(self.depth)
        self.hollow.end(event, self.depth, self.at)
        self.depth -= 1
        self.keys.pop()
        self.key_places.pop()

    def open_list(self, event: yaml.SequenceStartEvent) -> None:
        """Take the beginning of a list; to rcl an inner list is a new beginning of the outer one."""
        if self.expects_key:
            what = "a list cannot be a key" if self.depth else "a parameter file must be a mapping"
            raise self.unreadable(what, event)
        if self.parameter is None or not self.inside:
            if self.strays.has_told(self.keys):
                raise Unreadable
            raise self.unreadable(f"a list cannot stand above the parameters of '{SECTION_KEY}'", event)
        if self.lists:
            self.lists[0].inner = self.lists[0].inner or self.at(event)
            if self.lists[-1].items:
                self.flush(event)
        self.lists.append(OpenList(event, self.depth))

    def close_list(self, event: yaml.SequenceEndEvent) -> None:
        """Take the end of a list."""
        self.flush(event)
        closed = self.lists.pop()
        if closed.mapping is not None and closed.sound:
            self.surprise("a list of mappings is no parameter; rcl takes the mapping apart", closed.mapping)
        if self.lists:
            self.lists[-1].items = None
        elif closed.inner is not None:
            self.surprise(f"{NESTED}; rcl takes one of the inner lists", closed.inner)
        self.expects_key = True

    def flush(self, event: yaml.Event) -> None:
        """Set the list as far as it was read. An empty one has no type: the parameter stays without a value."""
        current = self.lists[-1]
        if current.items is None or not current.sound:
            return
        if len({type(item) for item in current.items}) > 1:
            # Here, because most lists are of one type.
            from orchestra.resolve.rcl.mixed_events import report_mixed  # noqa: PLC0415

            report_mixed(current, self.at, self.problems)
            current.sound = False
            return
        value: ParameterValue | None = tuple(current.items) or None  # type: ignore[assignment] # of one type
        self.emit(value, self.at(current.start, event))
        entries, items = self.found[-1].entries, tuple(map(self.at, current.written))
        entries[-1] = replace(entries[-1], items=items if len(items) == len(current.items) else ())

    def emit(self, value: ParameterValue | None, location: Location, *, opens: bool = False) -> None:
        """Set the parameter at hand. A second value for it looks for the slot by the name it has by then."""
        parameter = self.parameter
        assert parameter is not None  # noqa: S101 - a value comes behind its key
        entry = new_entry(parameter.name, value, location, parameter.key, parameter.slot, opens)
        self.found[-1].entries.append(entry)
        parameter.slot = parameter.name

    def alias(self, event: yaml.AliasEvent) -> None:
        """Report an alias, and go on as if a faulty value stood there."""
        message = f"{ALIAS} ('*{event.anchor}'): repeat the value"
        if self.expects_key:
            raise self.unreadable(message, event)
        self.error(message, self.at(event))
        if self.inside and self.parameter is not None:
            self.drop()
        else:
            self.lost, self.node, self.inside, self.expects_key = True, self.before_key, False, True

    def at(self, first: yaml.Event, last: yaml.Event | None = None) -> Location:
        """Return the place of an event, or from one to another."""
        return new_location(span_of_events(first, last or first, self.file), self.included_from)

    def error(self, message: str, at: Location, suggestion: str | None = None) -> None:
        """Report what rcl refuses."""
        self.problems.error(Code.PARAMETER_SYNTAX, message, at, suggestion=suggestion)

    def surprise(self, message: str, at: Location, suggestion: str | None = None) -> None:
        """Report what rcl reads in another way than it stands there."""
        self.problems.warning(Code.PARAMETER_SYNTAX, message, at, suggestion=suggestion)

    def unreadable(self, message: str, event: yaml.Event, at: Location | None = None) -> Unreadable:
        """Report what rcl refuses and cannot go on behind; raise what is returned."""
        self.error(message, at or self.at(event))
        return Unreadable(message)
