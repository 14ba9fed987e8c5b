"""A plan for people: arguments, files, a tree of the processes by namespace, what triggers do, what was left out.

The tree is indented and has no lines drawn, so that one node more changes no other node's lines in a comparison.
The same plan always gives the same text.
"""

from __future__ import annotations

import shlex
from collections import Counter
from operator import attrgetter
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.location import Span
from orchestra.plan.model import Process
from orchestra.plan.render.details import Details, labelled, process_kind, scalar
from orchestra.plan.render.setting import Setting

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.location import Location
    from orchestra.plan.model import Argument, Component, Plan, Skipped
    from orchestra.plan.render.setting import Additions, Paint

_INDENT = "  "
_CHAIN: Final = attrgetter("included_from")
_PROGRAM: Final = attrgetter("kind", "package", "executable")


def render(plan: Plan, setting: Setting = Setting(), /) -> str:  # noqa: B008 - it is frozen
    """Return the plan as text."""
    paint = setting.paint
    places = [str(process.location.span) for process in plan.processes]
    elsewhere = [component for component in plan.components if component.process is None]
    sections = [
        _heading(plan, paint),
        _section("host", _host(setting.additions), paint),
        _section("arguments", _arguments([item for item in plan.arguments if not item.given]), paint),
        _section("includes", _includes(plan, places, paint), paint),
        _titled("processes", _processes(plan, places, paint), paint),
        _section("components", (_component(item, "") for item in elsewhere), paint),
        _section("triggers", _triggers(plan), paint),
        _section("skipped", map(_skipped, plan.skipped), paint),
    ]
    return "\n".join(filter(None, sections))


def _heading(plan: Plan, paint: Paint) -> str:
    counted = [
        (len(plan.processes), "process", "processes"),
        (len(plan.components), "component", "components"),
        (len(plan.triggers), "trigger", "triggers"),
    ]
    counts = ", ".join(f"{n} {one if n == 1 else many}" for n, one, many in counted if n)
    return f"{paint('strong', plan.file)}: {counts or 'nothing to run'}\n"


def _section(title: str, lines: Iterator[str], paint: Paint) -> str:
    """Return the indented lines under their title, nothing where there are none."""
    return _titled(title, "".join([f"{_INDENT}{line}\n" for line in lines]), paint)


def _titled(title: str, text: str, paint: Paint) -> str:
    return f"{paint('strong', title)}\n{text}" if text else ""


def _host(additions: Additions | None) -> Iterator[str]:
    """Yield what a run adds to the environment of its processes on this machine."""
    if additions is None:
        return
    for name, value in sorted(additions.variables.items()):
        yield f"{name}={shlex.quote(value)}"
    for name, entries in additions.before.items():
        yield f"{name}: {entries} before what is there"
    for name, entries in additions.after.items():
        yield f"{name}: {entries} after what is there"


def _arguments(arguments: Sequence[Argument]) -> Iterator[str]:
    width = max((len(argument.name) for argument in arguments), default=0)
    for argument in arguments:
        value = "(no value)" if argument.value is None else shlex.quote(argument.value)
        origin = "" if argument.value == argument.default else _origin(argument)
        yield f"{argument.name:<{width}} := {value}{origin}"


def _origin(argument: Argument) -> str:
    """Return the default, unless the value may be what the default comes to."""
    if argument.default is not None and "$(" in argument.default:
        return ""
    return "  (required)" if argument.default is None else f"  (default {shlex.quote(argument.default)})"


@dataclass(slots=True)
class _Include:
    """An included file: how many processes and components come out of it, and what it includes in its turn."""

    count: int = 0
    below: dict[tuple[str, Span], _Include] = field(default_factory=dict)


def _includes(plan: Plan, places: Sequence[str], paint: Paint) -> Iterator[str]:
    """Yield the files that are included, below those that include them, in the order in which they are come upon."""
    root = _Include()
    for location, count in _alike(plan, places):
        here = root
        for step in _steps(location):
            here = here.below.setdefault(step, _Include())
            here.count += count
    yield from _included(root, paint)


def _alike(plan: Plan, places: Sequence[str]) -> Iterator[tuple[Location, int]]:
    """Yield one place of each file that was included in one way, and how many processes and components are there."""
    locations = [process.location for process in plan.processes]
    locations += [component.location for component in plan.components]
    told = [*places, *(str(component.location.span) for component in plan.components)]
    files = [place.rsplit(":", 2)[0] for place in told]
    keys = [*zip(map(id, map(_CHAIN, locations)), files, strict=True)]
    first = dict(zip(reversed(keys), reversed(locations), strict=True))
    for key, count in Counter(keys).items():
        if first[key].included_from:
            yield first[key], count


def _steps(location: Location) -> Iterator[tuple[str, Span]]:
    """Yield each file on the way to a place, with the place that includes it, outermost first."""
    places = location.included_from[::-1]
    files = [*(span.file for span in places[1:]), location.span.file]
    yield from zip(files, places, strict=True) if places else ()


def _included(include: _Include, paint: Paint) -> Iterator[str]:
    for (file, at), below in include.below.items():
        told = f"(at {at}, {below.count} node{'s' * (below.count != 1)})"
        yield f"{file}  {paint('faint', told)}"
        yield from (_INDENT + line for line in _included(below, paint))


@dataclass(slots=True)
class _Namespace:
    """A namespace of the tree: what is in it, with its places, and the namespaces below it, in plan order."""

    processes: list[tuple[Process, str]] = field(default_factory=list)
    below: dict[str, _Namespace] = field(default_factory=dict)


def _processes(plan: Plan, places: Sequence[str], paint: Paint) -> str:
    """Return each process with its lines, those of namespaces below the titles of these."""
    root, known = _Namespace(), dict[str, _Namespace]()
    telling, outside = _Telling(plan, paint), list[str]()
    for pair in zip(plan.processes, places, strict=True):
        name = pair[0].namespace
        if name is None:
            outside.append(telling.process(*pair, _INDENT))
            continue
        if name not in known:
            known[name] = _at(root, name)
        known[name].processes.append(pair)
    inside = telling.branch("/", root, _INDENT) if root.processes or root.below else ""
    return "".join([*outside, inside])


def _at(root: _Namespace, namespace: str) -> _Namespace:
    here = root
    for token in namespace.strip("/").split("/"):
        if token:
            here = here.below.setdefault(token, _Namespace())
    return here


class _Telling:
    """Tells of processes, with the components that each of them holds."""

    def __init__(self, plan: Plan, paint: Paint) -> None:
        self._paint = paint
        self._details = Details()
        self._kinds: dict[tuple[str | None, ...], str] = {}
        self._held: dict[str, list[str]] = {}
        for component in plan.components:
            if component.process is not None:
                told = _component(component, component.process)
                self._held.setdefault(component.process, []).append(told)

    def branch(self, title: str, namespace: _Namespace, margin: str) -> str:
        """Return a namespace and all that is in it, behind a margin."""
        inner = margin + _INDENT
        parts = [f"{margin}{self._paint('strong', title)}\n"]
        parts += [self.process(process, place, inner) for process, place in namespace.processes]
        parts += [self.branch(f"{token}/", below, inner) for token, below in namespace.below.items()]
        return "".join(parts)

    def process(self, process: Process, place: str, margin: str) -> str:
        """Return what a process is, and where, and below it what matters of it."""
        program = _PROGRAM(process)
        kind = self._kinds.get(program)
        if kind is None:
            kind = self._kinds[program] = process_kind(process)
        told = self._paint("faint", f"({kind}, {place})")
        inner = margin + _INDENT
        details = self._details.of(process, inner)
        held = self._held.get(process.id) if self._held else None
        components = labelled("components", held, inner) if held else ""
        return f"{margin}{self._paint('strong', process.id)}  {told}\n{details}{components}"


def _component(component: Component, container: str) -> str:
    """Return a component in one line; its container is told where it does not stand below it."""
    told = {**component.parameters, **component.extra_arguments}
    values = "".join(f" {key}={scalar(value)}" for key, value in told.items())
    remaps = "".join(f" {old}->{new}" for old, new in component.remappings)
    elsewhere = "" if container else f" in {component.container} (not of this plan)"
    late = " when a trigger loads it" if component.condition == "event" else ""
    lifecycle = f" brought to {component.lifecycle}" if component.lifecycle else ""
    plugin = f"{component.package}/{component.plugin}"
    return f"{component.id}: {plugin}{elsewhere}{late}{lifecycle}{values}{remaps}"


def _triggers(plan: Plan) -> Iterator[str]:
    if not plan.triggers:
        return iter(())
    from orchestra.plan.render.triggers import trigger_lines  # noqa: PLC0415 - few plans have any

    return trigger_lines(plan.triggers)


def _skipped(skipped: Skipped) -> str:
    name = f" {skipped.name}" if skipped.name else ""
    came_to = "" if skipped.value == skipped.expression else f", which is {skipped.value}"
    return f"{skipped.action}{name}: {skipped.condition} {skipped.expression}{came_to}  ({skipped.location})"
