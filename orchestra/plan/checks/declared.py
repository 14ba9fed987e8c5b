"""Parameters against what their nodes declare: types, bounds, names, and what must be given."""

from __future__ import annotations

from functools import cache
from itertools import chain, compress, repeat
from operator import attrgetter, ne
from typing import TYPE_CHECKING, Final

from orchestra.declared.beside import schema_of_package
from orchestra.declared.common import COMMON, KNOWN, common_meant
from orchestra.declared.convention import endings_beside
from orchestra.errors import Code, Problem, Problems, Severity
from orchestra.fields import replace
from orchestra.location import is_python
from orchestra.plan.written import Places, Written
from orchestra.resolve.command_line import COMMAND_LINE
from orchestra.resolve.model import FileParameters, NamedSchema, ResolvedComponent
from orchestra.resolve.refusals import forget_surprise

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from typing import TypeAlias

    from orchestra.declared.model import Fault, FaultKind, ParameterSchema
    from orchestra.location import Location
    from orchestra.plan.model import Component, Plan, Process
    from orchestra.resolve.model import ParameterSource, Resolved, ResolvedProcess
    from orchestra.values import ParameterValue

    _Program: TypeAlias = "tuple[str | None, str | None, str, NamedSchema | None]"

_CODES: dict[FaultKind, Code] = {
    "undeclared": Code.UNDECLARED_PARAMETER,
    "type": Code.DECLARED_TYPE,
    "value": Code.REFUSED_VALUE,
    "missing": Code.REQUIRED_PARAMETER,
}
_KIND: Final = attrgetter("kind")
# What tells which parameters a node declares.
_EXECUTABLE: Final = attrgetter("share", "package", "executable", "params_schema")
_PLUGIN: Final = attrgetter("share", "package", "plugin", "params_schema")
_MANAGERS = "nav2_lifecycle_manager"


def check_declared(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Report parameters that their nodes would refuse, or drop without a word."""
    schemas, places = _Schemas(problems), Places(resolved)
    surprises = {problem.span for problem in problems if problem.code is Code.SURPRISING_SCALAR}
    broken = {_line(item) for item in problems if item.severity is Severity.ERROR and item.span is not None}
    plain: set[str] = set()  # names that are no slip for one that every node has
    forms: set[tuple[object, ...]] = set()  # of values among which are such
    unknown: set[_Program] = set()  # programs of which nothing is known
    for program, node, planned in programs_of(resolved, plan):
        if program in unknown and planned.parameters.keys() <= plain:
            continue  # as most nodes
        if node.package == _MANAGERS and not node.faulty:
            # Here, because few descriptions have such.
            from orchestra.plan.checks.managed import check_managed  # noqa: PLC0415

            check_managed(planned, places.of("node_names", node, planned), plan, problems)
        schema, named = schemas.of(node)
        values = planned.parameters
        if schema is None and node.package != _MANAGERS:
            unknown.add(program)
        if schema is None and (values.keys() <= plain or (*values, *map(type, values.values())) in forms):
            continue
        faults = _of_every_node(values, plain, forms) if schema is None else schema.faults(values)
        for fault in faults:
            if not (fault.whole or fault.kind == "missing") or _is_whole(node):
                written = places.of(fault.name, node, planned)
                problem = _problem(fault, written, node, named=named)
                if fault.kind == "value" and _line(problem) in broken:
                    continue  # what is left of a value that could not be read
                if problem.span is not None and problem.span in surprises:
                    forget_surprise(problem.span, problems)
                problems.report(problem)


def _line(problem: Problem) -> tuple[str, int]:
    return ("", 0) if problem.span is None else (problem.span.file, problem.span.line)


def nodes_of(
    resolved: Resolved, plan: Plan
) -> list[tuple[ResolvedProcess | ResolvedComponent, Process | Component]]:
    """Return the nodes of a plan, each with what it was resolved to."""
    return [(node, planned) for _, node, planned in programs_of(resolved, plan)]


def programs_of(
    resolved: Resolved, plan: Plan
) -> Iterator[tuple[_Program, ResolvedProcess | ResolvedComponent, Process | Component]]:
    """Return the nodes of a plan, each behind what tells its program, with what it was resolved to."""
    processes, components = resolved.processes, resolved.components
    nodes = zip(map(_EXECUTABLE, processes), processes, plan.processes, strict=True)
    return chain(
        compress(nodes, map(ne, map(_KIND, processes), repeat("process"))),
        zip(map(_PLUGIN, components), components, plan.components, strict=True),
    )


class _Schemas:
    """The schemas of a description; each is read once."""

    def __init__(self, problems: Problems) -> None:
        self._problems = problems
        self._read: dict[object, ParameterSchema | None] = {}
        self._endings = cache(endings_beside)

    def of(self, node: ResolvedProcess | ResolvedComponent) -> tuple[ParameterSchema | None, bool]:
        """Return the schema of a node, and whether its description names it."""
        if node.params_schema is not None:
            return self._named(node.params_schema), True
        called = node.plugin if isinstance(node, ResolvedComponent) else node.executable
        key = (node.share, node.package, called)
        if key not in self._read:
            path = self._beside(node.share, called)
            named = None if path is None else NamedSchema(path, node.location, path)
            self._read[key] = _known(node.package, called) if named is None else self._named(named)
        return self._read[key], False

    def _beside(self, share: str | None, called: str) -> str | None:
        return None if share is None else schema_of_package(share, called, self._endings(share))

    def _named(self, named: NamedSchema) -> ParameterSchema | None:
        # Here, because few nodes have a schema, and for what it imports.
        from orchestra.declared.reading import read_named  # noqa: PLC0415

        key = named.path or id(named.model)
        if key not in self._read:
            self._read[key] = read_named(named, self._problems)
        return self._read[key]


def _known(package: str | None, called: str) -> ParameterSchema | None:
    if package not in KNOWN:
        return None
    from orchestra.declared.known import known_schema  # noqa: PLC0415 - few nodes are so well known

    return known_schema(package, called)


def _of_every_node(
    values: dict[str, ParameterValue], plain: set[str], forms: set[tuple[object, ...]]
) -> Iterable[Fault]:
    typed = all(isinstance(values.get(name, True), bool) for name in COMMON)
    if typed and not any(map(common_meant, values)):
        plain |= values.keys() - COMMON.keys()
        forms.add((*values, *map(type, values.values())))
        return ()
    from orchestra.declared.judging import of_every_node  # noqa: PLC0415 - hardly any description needs it

    return of_every_node(values)


def _is_whole(node: ResolvedProcess | ResolvedComponent) -> bool:
    """Return whether all parameters that the node is given are known: else what is missing may be among the others."""
    among = () if isinstance(node, ResolvedComponent) else node.parameter_arguments
    return not node.faulty and not any(map(_is_lacking, (*node.parameters, *among)))


def _is_lacking(source: ParameterSource) -> bool:
    return isinstance(source, FileParameters) and (not source.path or not source.sound)


def _problem(
    fault: Fault, written: Written, node: ResolvedProcess | ResolvedComponent, *, named: bool
) -> Problem:
    """Return what is to be told of a fault, at the place that is to be changed."""
    at, suggestion, notes = _place(fault, written, node)
    if suggestion is not None and at.span.file == COMMAND_LINE:  # the place is all of NODE:NAME:=VALUE
        suggestion, notes = None, (f"did you mean '{suggestion}'?",)
    sure = fault.certain and (named or fault.kind != "undeclared") and not _is_lenient(fault, at, named=named)
    return Problem(
        _CODES[fault.kind],
        Severity.ERROR if sure else Severity.WARNING,
        " ".join(fault.told.split()),
        at.span,
        at.included_from,
        suggestion,
        notes if fault.source is None else (*notes, _source(fault)),
    )


def _source(fault: Fault) -> str:
    """Return from where a fault is known, and what to do where the node at hand is another."""
    silenced = f"'orchestra: ignore[{_CODES[fault.kind]}]'"
    return f"so it is in the code of {fault.source} (Humble to Jazzy); a comment with {silenced} silences it"


def _is_lenient(fault: Fault, at: Location, *, named: bool) -> bool:
    """Return whether a description in Python that nobody has given a schema goes on in spite of a fault."""
    return not named and fault.name in COMMON and is_python(at)


def _place(
    fault: Fault, written: Written, node: ResolvedProcess | ResolvedComponent
) -> tuple[Location, str | None, tuple[str, ...]]:
    if fault.kind == "missing" or written.value is None:
        return node.location, None, ()
    if fault.kind == "undeclared":
        key = written.key(fault.name, fault.meant)
        return key.location, key.meant, key.notes
    if fault.item is not None and fault.item < len(written.items):
        return written.items[fault.item], fault.meant, ()
    if fault.meant is not None and not written.is_whole:
        return written.value, None, (f"did you mean '{fault.meant}'?",)
    place = _with_quotes(written.value) if fault.kind == "type" else written.value
    return place, fault.meant, ()


def _with_quotes(at: Location) -> Location:
    """Return the place of a text in YAML with its quotes: what stands in them is no number, whatever it says."""
    span = at.span
    if span.line != span.end_line or not span.file.endswith((".yaml", ".yml")):
        return at
    import linecache  # noqa: PLC0415 - slow, and only mistakes need it

    line = linecache.getline(span.file, span.line)
    around = line[span.column - 2 : span.column - 1], line[span.end_column - 1 : span.end_column]
    if around not in {("'", "'"), ('"', '"')}:
        return at
    return replace(at, span=replace(span, column=span.column - 1, end_column=span.end_column + 1))
