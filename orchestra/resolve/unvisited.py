"""What can be told of actions that a condition has left out: what is wrong with them whatever the condition says.

Nobody sees such mistakes before the condition is true for once. Told is what does not depend on the condition: packages
and their executables, files that should be there, arguments that the file which is included does not know. All of it
are warnings, of an action that is carried out nowhere in the run; nothing is told where nodes are started.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.description.actions.arg import Arg
from orchestra.description.actions.include import Include
from orchestra.description.actions.let import Let
from orchestra.description.actions.node import Node
from orchestra.description.entity import Conditional
from orchestra.description.parts import Pair, Param
from orchestra.description.text import Call
from orchestra.errors import Code, Problems, Severity
from orchestra.fields import replace
from orchestra.load.files import PYTHON
from orchestra.location import displayed
from orchestra.nearest import is_slip, nearest
from orchestra.resolve.context import Value
from orchestra.resolve.mentions import (
    entities_in,
    glimpse,
    is_fixed,
    names_behind,
    performed_in,
    templates_of,
    variables_in,
)
from orchestra.resolve.near_paths import near_path
from orchestra.resolve.paths import beside, settled_path
from orchestra.resolve.python_programs import is_slip_of, module_fault
from orchestra.resolve.refusals import missing_package
from orchestra.resolve.rehearsal import rehearsed

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping, Sequence

    from orchestra.description.entity import Entity
    from orchestra.description.launch import Description
    from orchestra.description.text import Template
    from orchestra.location import Location
    from orchestra.resolve.context import Variable
    from orchestra.resolve.resolution import Resolution

# A condition that asks whether a file is there.
_ASKS: Final = re.compile(r"exists|is_?file|is_?dir", re.IGNORECASE)
_LEFT_OUT: Final = "a condition leaves this out here"
_FINDS: Final = ("find-pkg-share", "find-pkg-prefix", "exec-in-pkg")


def doubts(action: Conditional, run: Resolution, *, known: bool = True) -> Problems:
    """Return what is wrong with an action that is left out, and with those in it, as warnings.

    Where it is not `known` what the condition comes to, for that is faulty, they are errors as everywhere.
    """
    found = Problems()
    look = _Look(action, run, found, known=known)
    for entity in look.entities:
        look.at_calls(entity)
        if isinstance(entity, Node):
            look.at_program(entity)
        elif isinstance(entity, Include):
            look.at_include(entity)
        elif isinstance(entity, Param) and entity.from_ is not None:
            look.at_file(entity.from_, "parameter file")
    look.aside()
    return found


class _Look:
    """A look at an action that is left out, with the variables that do not depend on why it is."""

    def __init__(self, action: Conditional, run: Resolution, found: Problems, *, known: bool) -> None:
        self.action = action
        self.run = run
        self.found = found
        self.known = known
        self.entities = entities_in(action)
        conditions = [item for item in map(_condition, self.entities) if item is not None]
        self.variables = _independent(self.entities, conditions, run.scope.variables)
        self.asked = any(_ASKS.search(item.raw) for item in conditions)

    def aside(self) -> None:
        """Report what is wrong with names and values that nothing else can make right."""
        for problem in rehearsed(self.entities, self.run, self._lasting()):
            if self.known:
                notes = (*problem.notes, _LEFT_OUT)
                problem = replace(problem, severity=Severity.WARNING, notes=notes)  # noqa: PLW2901 - the same one
            self.found.report(problem)

    def _lasting(self) -> dict[str, Variable]:
        """Return the variables that nobody can give another value, as whoever launches the file does to arguments."""
        if any(isinstance(item, Include) for item in self.entities):
            return {}  # what it includes may set any
        open_to_all = self.run.found.arguments.keys() | {given.name for given in self.run.inputs.arguments}
        return {
            name: variable
            for name, variable in self.variables.items()
            if name not in open_to_all and open_to_all.isdisjoint(_behind(variable))
        }

    def at_calls(self, entity: Entity) -> None:
        """Report packages and variables whose names are slips for others, in whatever names them."""
        performed = (part for template in templates_of(entity) for part in performed_in(template))
        calls = [part for part in performed if isinstance(part, Call) and part.arguments]
        for part in calls:
            if part.name in _FINDS:
                self._package(part.arguments[-1 if part.name == "exec-in-pkg" else 0])
        self._variables(part for part in calls if part.name == "var" and len(part.arguments) == 1)

    def _variables(self, calls: Iterable[Call]) -> None:
        """Report names of variables that are slips for others, and that nothing which is left out sets."""
        for part in calls:
            name, known = part.arguments[0].constant, self.run.scope.variables
            near = nearest(name, known) if name is not None and name not in known else None
            if name is None or near is None or not is_slip(name, near) or name in self._set():
                continue
            told = f"no launch argument or variable '{name}' is set here"
            self._tell(Code.UNDEFINED_VARIABLE, told, part.arguments[0], near)

    def _set(self) -> set[str | None]:
        """Return the names that something sets which is left out, and those that something faulty would have set."""
        hidden = (self.action, *(part.action for part in self.run.scope.ledger.hidden))
        names: set[str | None] = set(self.run.found.lost)
        for item in entities_in(hidden):
            names |= {item.name.constant} if isinstance(item, Arg | Let | Pair) else set()
            names.update(getattr(item, "for_each", None) or ())
        return names

    def at_program(self, node: Node) -> None:
        """Report what a node starts: the package and the executable, the module or the script."""
        if node.script is not None:
            self.at_file(node.script, "script")
        elif node.module is not None:
            self._module(node, node.module)
        elif node.pkg is not None and node.exec is not None and self._package(node.pkg):
            self._executable(node.pkg.constant, node.exec)

    def _executable(self, package: str | None, written: Template) -> None:
        executable = written.constant
        if package is None or executable is None:
            return
        packages = self.run.context.packages
        if packages.executable(package, executable) is not None:
            return
        known = packages.executables(package)
        if known:
            told = f"package '{package}' has no executable '{executable}'"
            notes = (f"it has {', '.join(sorted(known))}",)
            self._tell(Code.MISSING_EXECUTABLE, told, written, nearest(executable, known), notes)

    def _module(self, node: Node, written: Template) -> None:
        name = written.constant
        fault = None if name is None else module_fault(name, node, self.run)
        if name is not None and fault is not None and (fault.certain or is_slip_of(name, fault)):
            self._tell(Code.MISSING_EXECUTABLE, fault.told, written, fault.meant)

    def at_include(self, include: Include) -> None:
        """Report the file of an include that should be there, and arguments that it does not know."""
        path = self.at_file(include.file, "launch file")
        if path is None or include.for_each is not None:
            return
        given = {pair.name.constant: pair.name for pair in (*include.arg, *include.let)}
        description = _opened(path, self.run) if given and None not in given else None
        if description is None:
            return
        declared = {
            item.name.constant for item in entities_in(description.actions) if isinstance(item, Arg)
        } - {None}
        names, more = names_behind((), self.run.context, lambda file: _opened(file, self.run), (path,))
        for name, written in given.items():
            if name is None or name in names or name in self.run.found.lost:
                continue
            meant = nearest(name, {item for item in declared if item is not None} - given.keys())
            if (meant is not None and is_slip(name, meant)) or not more:
                told = f"{description.file} has no argument '{name}'"
                self._tell(Code.UNREAD_ARGUMENT, told, written, meant)

    def at_file(self, written: Template, what: str) -> str | None:
        """Return the path of a file; one that is not there and should be is reported."""
        value = glimpse(written, self.run.context, self.variables)
        if value is None or not value.text:
            return None
        path = beside(self.run.context.file, value.text)
        if path is not None:
            return path
        missing = None if self.asked else settled_path(value, self.run)
        near = None if missing is None else near_path(missing, written.raw)
        if missing is not None and (near is not None or is_fixed(written)):
            told = f"there is no {what} {displayed(str(missing))}"
            self._tell(Code.MISSING_FILE, told, written, near if near != written.raw else None)
        return None

    def _package(self, written: Template) -> bool:
        """Return whether a package is here; one that is not is reported where its name is a slip for another."""
        name = written.constant
        if name is None:
            return False
        packages = self.run.context.packages
        if packages.prefix(name) is not None:
            return True
        missing = missing_package(name, packages.names(), Severity.WARNING)
        if missing.severity is Severity.ERROR:
            self._tell(Code.MISSING_PACKAGE, missing.told, written, missing.meant)
        return False

    def _tell(
        self, code: Code, told: str, written: Template, meant: str | None, notes: tuple[str, ...] = ()
    ) -> None:
        at: Location = self.run.at(written.span)
        if self.known or (code is Code.UNREAD_ARGUMENT and meant is None):
            notes = (*notes, _LEFT_OUT)
            self.found.warning(code, told, at, suggestion=meant, notes=notes)
        else:
            self.found.error(code, told, at, suggestion=meant, notes=notes)


def _condition(entity: Entity) -> Template | None:
    if not isinstance(entity, Conditional):
        return None
    return entity.if_ if entity.if_ is not None else entity.unless


def _independent(
    entities: Iterable[Entity], conditions: Sequence[Template], variables: Mapping[str, Variable]
) -> dict[str, Variable]:
    """Return the variables that neither a condition of some entities depends on nor any of them sets."""
    changing = {item.name.constant for item in entities if isinstance(item, Arg | Let | Pair)}
    for condition in conditions:
        read = variables_in(condition)
        if read is None:
            return {}
        for name in read:
            changing |= {name, *_behind(variables.get(name))}
    return {
        name: variable
        for name, variable in variables.items()
        if name not in changing and changing.isdisjoint(_behind(variable))
    }


def _behind(variable: Variable | None) -> Collection[str]:
    """Return the variables that one was made of."""
    value = None if variable is None else variable.value
    waiting = list(value.through) if isinstance(value, Value) else ()
    if not waiting:
        return ()
    seen: set[int] = set()
    names: set[str] = set()
    while waiting:
        read = waiting.pop()
        if id(read) not in seen:
            seen.add(id(read))
            names.add(read.name)
            waiting += read.through
    return names


def _opened(path: str, run: Resolution) -> Description | None:
    """Return what a file says that is not part of the run, without a word about its faults; None for one in Python."""
    known = run.descriptions.get(path)
    return known if known is not None or path.endswith(PYTHON) else run.load(path, Problems(), ())
