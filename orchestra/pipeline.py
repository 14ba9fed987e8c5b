"""The table of contents: a launch file is loaded, resolved and planned; the supervisor then runs the plan."""

from __future__ import annotations

import gc
import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from orchestra.compat.seam import connected
from orchestra.errors import Code, DescriptionError, Problem, Problems
from orchestra.fields import replace
from orchestra.load.files import load
from orchestra.location import displayed, is_python, point
from orchestra.nearest import renew
from orchestra.plan.build import build
from orchestra.plan.checks.table import has_settings
from orchestra.plan.relocated import relocated
from orchestra.plan.warm import Warmth, warmed
from orchestra.resolve import launch_files
from orchestra.resolve.command_line import inputs_from
from orchestra.resolve.commands import run_command
from orchestra.resolve.packages import InstalledPackages, has_manifests
from orchestra.resolve.python.calling import take_environment
from orchestra.resolve.python.connection import LoadingConnection
from orchestra.resolve.python.isolation import isolated
from orchestra.resolve.resolve import begin, carry_through, end, outcome
from orchestra.resolve.single import single_node
from orchestra.settings.find import without_settings
from orchestra.settings.settle import settle
from orchestra.stack import roomy
from orchestra.witness.observing import observer
from orchestra.witness.once import once, real
from orchestra.witness.place import folder

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from contextlib import AbstractContextManager
    from typing import TypeAlias

    from orchestra.plan.model import Plan
    from orchestra.resolve.inputs import Inputs
    from orchestra.resolve.model import Resolved
    from orchestra.resolve.python.files import Files
    from orchestra.resolve.python.isolation import Isolation
    from orchestra.resolve.resolution import LoadFile, Resolution

    Isolating: TypeAlias = Callable[..., AbstractContextManager[Isolation]]

__all__ = [
    "Launch",
    "check",
    "collect",
    "find_launch_file",
    "inputs_from",
    "make_plan",
    "opened",
    "plan_of_node",
]

FILES = "${run}/files"  # where temporary files of launch files' code are, in a plan


def make_plan(path: str, inputs: Inputs) -> Plan:
    """Return the plan of a launch file. Raises `DescriptionError` with all problems where there are errors."""
    problems = Problems()
    plan = collect(path, inputs, problems)
    if plan is None or problems.errors:
        raise DescriptionError(problems.ordered)
    return plan


def check(path: str, inputs: Inputs) -> tuple[Problem, ...]:
    """Return everything that is wrong with a launch file."""
    problems = Problems()
    collect(path, inputs, problems)
    return problems.ordered


def plan_of_node(
    package: str, executable: str, arguments: Sequence[str], inputs: Inputs, *, prefix: str = ""
) -> Plan:
    """Return the plan of one node whose arguments are passed on unchanged. Raises `DescriptionError`."""
    problems = Problems()
    packages = InstalledPackages(inputs.environment)
    resolved = single_node(package, executable, arguments, prefix, problems, packages)
    plan = build(_provided_for(resolved, inputs, problems), problems)
    if problems.errors:
        raise DescriptionError(problems.ordered)
    return warmed(plan, inputs.environment)


def find_launch_file(words: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """Return the launch file that the first words name, and the words after it. Raises `UsageError`."""
    return launch_files.find_launch_file(words, InstalledPackages(os.environ))


@roomy  # whoever calls it, at whatever depth
def collect(path: str, inputs: Inputs, problems: Problems, *, load: LoadFile = load) -> Plan | None:
    """Return the plan of a launch file as far as it goes, with everything that is wrong in `problems`.

    `load` reads the files. None where the file itself cannot be read as a launch file.
    """
    with opened(path, inputs, problems, load=load) as launch:
        return None if launch is None else launch.plan


@contextmanager
def opened(
    path: str,
    inputs: Inputs,
    problems: Problems,
    *,
    load: LoadFile = load,
    packages: InstalledPackages | None = None,
    whole: bool = True,
    isolating: Isolating = isolated,
    postponed: list[Callable[[], None]] | None = None,
) -> Iterator[Launch | None]:
    """Resolve and plan a launch file, whose code can be called as long as the context lasts.

    What is wrong is in `problems`. `load` reads the files. None where the file itself cannot be read as a launch file.
    `whole`: the plan is wanted, and not only what is wrong with it. `isolating` keeps from this process what code of
    the files does. What is kept for other plans is written at the end, or `postponed`: it waits there for a call.
    """
    renew()
    packages = packages or InstalledPackages(inputs.environment)
    keeping = whole and inputs.keeping  # of what is only checked the findings are kept
    with _loading(path, inputs, load, packages, problems, isolating, keeping, postponed) as isolation:
        with _collector_paused():
            run = begin(inputs, problems, load=load, packages=packages, run_command=run_command)
            description = load(path, problems, ())
            if isolation.remaining is not None:  # code of the file may have changed it
                take_environment(run, point(displayed(path, real)))
            launch = None
            if description is not None:
                resolved = _symbolic(carry_through(description, run), isolation.files)
                resolved = _provided_for(resolved, inputs, problems)
                _warn_of_remaining(path, isolation, problems)
                warmth = Warmth(inputs.environment) if whole else None
                plan = build(resolved, problems, whole=whole, warmth=warmth)
                launch = Launch(plan, run, isolation.files)
                if not inputs.launching:
                    # Here, because a run looks at its machine itself.
                    from orchestra.plan.checks.memory import check_memory  # noqa: PLC0415

                    check_memory(launch.plan, problems)
            _point_into_code(problems, inputs)
            settle(problems, path, inputs.severity, bare=_is_bare(path))
            if launch is not None and whole:
                launch.plan = replace(launch.plan, problems=problems.ordered)
        yield launch
        end(run)


def _provided_for(resolved: Resolved, inputs: Inputs, problems: Problems) -> Resolved:
    """Return what was resolved with what its nodes need around them: definitions; how they talk is looked at."""
    if has_settings(resolved, inputs.environment):
        # Here, because few launch files say how nodes talk.
        from orchestra.plan.checks.middleware import check_middleware  # noqa: PLC0415

        check_middleware(resolved, inputs, problems)
    if not has_manifests(resolved):
        return resolved
    # Here, because few packages say what they need in a file that is looked for.
    from orchestra.resolve.interfaces.needed import with_definitions  # noqa: PLC0415

    return with_definitions(resolved, inputs, problems, run_command)


def _is_bare(path: str) -> bool:
    """Tell whether no settings can count for a file, which those beside it share."""
    folder = os.path.dirname(os.path.abspath(path))  # noqa: PTH100, PTH120 - pathlib is slow
    return once(("settings", folder), lambda: without_settings(f"{folder}/file"))


def _point_into_code(problems: Problems, inputs: Inputs) -> None:
    """Let problems of Python files stand at the text that is wrong."""
    if any(problem.span is not None and is_python(problem.span) for problem in problems):
        # It takes time to import, and only problems of such files need it.
        from orchestra.compat.suggestions import point_into_code  # noqa: PLC0415
        from orchestra.resolve.python.leaving_open import leave_open  # noqa: PLC0415

        point_into_code(problems)
        if not inputs.planning:
            leave_open(problems, inputs.environment, inputs.weights.variable)


def _warn_of_remaining(path: str, isolation: Isolation, problems: Problems) -> None:
    """Tell what code of the launch files has begun that is no part of the plan."""
    if isolation.remaining is not None:
        for told, span in isolation.remaining.told(lambda: point(displayed(path, real))):
            problems.warning(Code.USER_CODE, told, span)


class Launch:
    """A plan, and the state of the resolution that it is from: code of the launch files may be left in it.

    `files` are the temporary ones of that code, `${run}/files` in the plan.
    """

    def __init__(self, plan: Plan, run: Resolution, files: Files) -> None:
        self.plan = plan
        self.files = files
        self._run = run

    @property
    def left_out(self) -> set[str]:
        """The files that includes name which conditions left out, as far as that can be told."""
        hidden = self._run.scope.ledger.hidden
        return {file for part in hidden for file in part.files if file is not None}

    @property
    def deferred(self) -> bool:
        """Whether code of the launch files decides about triggers while the plan runs."""
        return any(trigger.deferred for trigger in self.plan.triggers)

    def answer(self, question: dict[str, Any]) -> dict[str, Any]:
        """Return what that code decides, as JSON data: see `orchestra.supervise.run.run`."""
        # Here, because few launches need it, and what it imports.
        from orchestra.plan.fragment import fragment  # noqa: PLC0415
        from orchestra.resolve.python.deciding import decide  # noqa: PLC0415

        problems, event = Problems(), question["event"]
        ids = [process.id for process in self.plan.processes]
        target = event.get("process")
        do = decide(question["ref"], event, ids.index(target) if target in ids else None, self._run, problems)
        resolved = _symbolic(outcome(self.plan.file, self._run), self.files)
        settled = self._run.found.triggers - len(resolved.triggers)
        self.plan, answer = fragment(self.plan, resolved, do, problems, triggers=settled)
        return answer


def _symbolic(resolved: Resolved, files: Files) -> Resolved:
    """Return what was resolved, with the folder of temporary files as a part of the run directory."""
    return relocated(resolved, files.folder, FILES) if files.folder is not None and files.used else resolved


def _place_of_codes() -> str | None:
    """Return the folder for compiled code of launch files; None where there is no place for it."""
    with observer().aside():  # no plan depends on it
        where = folder(os.environ)
    return where and os.path.abspath(f"{where}/codes")  # noqa: PTH100 - pathlib is slow


@contextmanager
def _collector_paused() -> Iterator[None]:
    """Keep the garbage collector from walking the trees as they grow, which takes almost half of the time.

    Afterwards they count as old, so that the next thing that is made does not set off a walk through all of them.
    """
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            if not gc.get_freeze_count():  # else somebody wants some to stay frozen
                gc.freeze()
                gc.unfreeze()  # it puts all into the oldest generation
            gc.enable()


@contextmanager
def _loading(
    path: str,
    inputs: Inputs,
    load: LoadFile,
    packages: InstalledPackages,
    problems: Problems,
    isolating: Isolating = isolated,
    keeping: bool = False,
    postponed: list[Callable[[], None]] | None = None,
) -> Iterator[Isolation]:
    """Let launch files in Python be loaded, and leave this process as it was. `keeping`: their code is kept."""

    def begin_alone(problems: Problems) -> Resolution:
        """Begin a resolution for a context that user code builds for itself."""
        own = replace(inputs, environment=dict(os.environ), arguments=())
        return begin(own, problems, load=load, packages=packages, run_command=run_command)

    words = (f"{item.name}:={item.value}" for item in inputs.arguments)
    codes = (_place_of_codes() if keeping else None, path)
    with (
        isolating(
            inputs.environment, ("ros2", "launch", path, *words), launching=inputs.launching
        ) as isolation,
        connected(
            LoadingConnection(
                packages,
                begin_alone,
                isolation.prepare,
                problems=problems,
                inputs=inputs,
                codes=codes,
                postponed=postponed,
            )
        ),
    ):
        yield isolation
