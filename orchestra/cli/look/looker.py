"""A look at one file: all stages that start nothing, recorded with everything that they go by."""

from __future__ import annotations

import gc
import os
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra import pipeline
from orchestra.cli.look.finding import Finding
from orchestra.cli.look.questions import RecordedPackages
from orchestra.cli.look.sharing import SharedLoader
from orchestra.cli.look.sources import NOWHERE, Sources
from orchestra.cli.look.standing import Standing
from orchestra.declared.alone import check_common
from orchestra.errors import HERE, Code, Problems
from orchestra.fields import replace
from orchestra.load.encodings import UndecodableError, decoded
from orchestra.load.files import PYTHON
from orchestra.location import Location, displayed, point
from orchestra.resolve.mentions import files_named
from orchestra.resolve.python.environ import put_environment
from orchestra.resolve.python.files import Files
from orchestra.resolve.python.isolation import isolated
from orchestra.resolve.rcl.files import read_parameter_file
from orchestra.settings.comments import MARK
from orchestra.settings.settle import settle
from orchestra.witness.looking import read_lately
from orchestra.witness.observing import observer
from orchestra.witness.once import real
from orchestra.witness.variables import ObservedEnvironment

if TYPE_CHECKING:
    from orchestra.cli.targets import Target
    from orchestra.description.launch import Description
    from orchestra.errors import Problem
    from orchestra.location import Span
    from orchestra.pipeline import Isolating
    from orchestra.resolve.inputs import Inputs
    from orchestra.resolve.weights import Weights
    from orchestra.witness.record import Record


_COLLECTING = 1000  # files, of some 30 kB each, after which memory is tidied up
# What another machine may have: for want of it a file cannot be read, or an action.
_LACKING = (
    *(Code.MISSING_PACKAGE, Code.UNSET_ENVIRONMENT, Code.USER_CODE),
    *(Code.MISSING_EXECUTABLE, Code.MISSING_FILE, Code.COMMAND_FAILED),
)
_ADDED = (Code.UNKNOWN_ACTION,)


class Looker:
    """Looks at one file after the other, in a process that does nothing else; what files share is read once."""

    def __init__(self, inputs: Inputs) -> None:
        self._environment = dict(inputs.environment)
        self._inputs = replace(
            inputs,
            launching=False,
            planning=False,
            environment=ObservedEnvironment(self._environment, observer()),
        )
        self._packages = RecordedPackages(self._environment)
        self._loader = SharedLoader(self._names)
        self._isolating: Isolating = isolated
        self._count = 0

    def watch(self, scratch: str) -> None:
        """Begin to watch what this process looks at, without which what a finding depends on is not known.

        Temporary files of code go below the folder `scratch`: what they are called tells nothing.
        """
        self._isolating = Standing().isolated
        put_environment(self._environment)  # so that none has to be put there and back for each file
        Files.above = scratch
        observer().scratch = scratch
        observer().install()
        gc.disable()
        gc.freeze()  # what the process began with stays; to walk through it takes long

    @property
    def is_spent(self) -> bool:
        """Whether code has loaded into this process what nobody can watch, so that the next file needs another one."""
        return bool(observer().foreign)

    def read(self, target: Target) -> None:
        """Read a launch file that is looked at soon; what is wrong with it is told then.

        A processor is faster at what it has just done: files that are read one after the other take a tenth less.
        """
        if target.kind != "launch":
            return
        path = os.path.abspath(target.path)  # noqa: PTH100 - pathlib is slow
        if path.endswith(PYTHON):
            # Here, because only such files need it.
            from orchestra.resolve.python.codes import compile_ahead  # noqa: PLC0415

            compile_ahead(path)
        else:
            observer().begin(self._environment)
            with suppress(Exception):  # it is raised again when the file is looked at
                self._loader.read(path)
            observer().rest()

    def look(self, target: Target) -> tuple[Finding, Record]:
        """Return what is found in a file, and what that depends on."""
        watching = observer()
        watching.begin(self._environment)
        found = self._launch_file(target.path) if target.kind == "launch" else self._parameters(target.path)
        record = watching.end()
        if _has_comments(target.path):  # it has just been read
            found = replace(found, comments=True)
        self._count += 1
        if not gc.isenabled() and self._count % _COLLECTING == 0:
            gc.collect()
            gc.freeze()  # what is shared stays, as above
        return found, record

    def _launch_file(self, path: str) -> Finding:
        problems = Problems()
        visit = _Visit(self._loader, self._inputs.weights)
        self._loader.named = set()
        absolute = os.path.abspath(path)  # noqa: PTH100 - pathlib is slow
        with pipeline.opened(
            absolute,
            self._inputs,
            problems,
            load=visit.load,
            packages=self._packages,
            whole=False,
            isolating=self._isolating,
        ) as launch:
            left_out = set() if launch is None else launch.left_out
        named = self._loader.named | set(map(real, left_out))
        return Finding(
            real(absolute),
            problems.ordered,
            frozenset(visit.included),
            frozenset(named),
            frozenset(problems.silencing),
        )

    def _names(self, description: Description) -> set[str]:
        files = files_named(description, self._inputs.environment, Sources(self._packages), NOWHERE)
        return set(map(real, files))

    def _parameters(self, path: str) -> Finding:
        problems = Problems()
        file = displayed(path, real)
        try:
            text = decoded(Path(path).read_bytes())
        except OSError as error:
            message = f"cannot read the parameter file {file}: {error}"
            problems.error(Code.UNREADABLE_FILE, message, Location(point(file)))
        except UndecodableError as error:
            at = Location(point(file, error.line, error.column))
            problems.error(Code.PARAMETER_SYNTAX, str(error), at)
        else:
            check_common(read_parameter_file(text, file, problems, template=True), problems)
        settle(problems, str(Path(path).absolute()), self._inputs.severity)
        silencing = frozenset(problems.silencing)
        return Finding(real(path), problems.ordered, silencing=silencing)


class _Visit:
    """What one launch file includes."""

    def __init__(self, loader: SharedLoader, weights: Weights) -> None:
        self.included: set[str] = set()
        self._loader = loader
        self._weights = weights

    def load(
        self, path: str, problems: Problems, chain: tuple[Span, ...] = (), ending: str | None = None
    ) -> Description | None:
        """Read a launch file, as `orchestra.load.files.load` does."""
        if chain:
            self.included.add(real(path))
        description = self._loader.load(path, problems, chain, ending)
        if description is None and not chain:
            problems.amend(lambda problem: _weighed(problem, self._weights, _LACKING))
        elif any(_is_lack(problem, _ADDED) for problem in problems):
            problems.amend(lambda problem: _weighed(problem, self._weights, _ADDED))
        return description


def _is_lack(problem: Problem, codes: tuple[Code, ...]) -> bool:
    """Return whether a problem of these codes is that something is not here which another machine may have."""
    return problem.code in codes and problem.message.endswith(HERE)


def _weighed(problem: Problem, weights: Weights, codes: tuple[Code, ...]) -> Problem:
    """Return a problem that keeps a file or an action from being read, as grave as it is that this is not here."""
    return replace(problem, severity=weights.of(problem.code)) if _is_lack(problem, codes) else problem


def _has_comments(path: str) -> bool:
    try:
        return MARK.encode() in read_lately(os.path.abspath(path))  # noqa: PTH100 - pathlib is slow
    except OSError:
        return False
