"""What `node` and `executable` have in common, resolved."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.description.running import ON_EXIT
from orchestra.errors import Code
from orchestra.resolve.bounded import with_change
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.dependencies import dependencies
from orchestra.resolve.environment_names import is_faulty_name, warn_of_shell
from orchestra.resolve.for_all import emulate_tty, set_for_all
from orchestra.resolve.idle_keys import check_keys
from orchestra.resolve.model import EnvironmentChange
from orchestra.resolve.outputs import output
from orchestra.resolve.paths import check_folder
from orchestra.resolve.policies import restart, stop
from orchestra.resolve.reactions import ResolvedStart
from orchestra.resolve.sound import Sound
from orchestra.resolve.worded import texts
from orchestra.witness.variables import copied

if TYPE_CHECKING:
    from orchestra.description.running import Running
    from orchestra.location import Location
    from orchestra.resolve.model import ResolvedProcess
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import Limits


# Variables that say for all processes how they run.
_FOR_ALL = ("launch-prefix", "launch-prefix-filter", "emulate_tty", "sigterm_timeout", "sigkill_timeout")
_NOWHERE: dict[str, tuple[EnvironmentChange, ...]] = {}  # nobody changes it


def add_process(action: Running, program: ResolvedProcess, run: Resolution) -> int:
    """Add a process to what has been found, with how it runs; return its index. It knows its `origin`.

    It starts with the run, or with the timer around it.
    """
    process: Any = program  # which nobody else has
    frame, found, occasion = run.frames[-1] if run.frames else run.frame, run.found.processes, run.occasion
    process.depends_on, process.labels = frame.depends_on, frame.labels
    # What one in Python said of conditions is not known.
    process.conditional = run.conditions > 0 or occasion is not None
    if process.origin is not None:
        process.conditional = True
    if run.around:
        process.around = run.around
    scope = run.scope
    if _says_nothing(action) and scope.variables.keys().isdisjoint(_FOR_ALL):
        places = output(action.output, run, process.location)
        changes = (
            _environment(action, run) if action.env else dict(scope.changes) if scope.changes else _NOWHERE
        )
        process.output = None if places is POISON else places
        process.environment = _NOWHERE if changes is POISON else changes
        faulty = places is POISON or changes is POISON
    else:
        faulty = _say(action, process, run)
    if faulty or action.faulty:  # when all others have been looked at
        process.faulty = True
    if occasion is not None:
        occasion.do.append(ResolvedStart(len(found), process.location))
    found.append(process)
    if process.origin is not None:
        _tell(process, run)
    return len(found) - 1


def _says_nothing(action: Running) -> bool:
    """Return whether nothing but variables and where output goes is said of how a process runs: most are such.

    One by one, for no other way is as quick.
    """
    return (
        action.respawn is None
        and action.respawn_delay is None
        and action.respawn_max_retries is None
        and action.restart is None
        and action.on_exit is None
        and action.required is None
        and action.success_exit_codes is None
        and action.launch_prefix is None
        and action.shell is None
        and action.cwd is None
        and action.env_only is None
        and action.emulate_tty is None
        and action.stdin is None
        and action.stop is None
        and action.sigterm_timeout is None
        and action.sigkill_timeout is None
        and not action.depends_on
        and action.ready is None
        and action.alive is None
        and action.limits is None
        and action.warm is None
    )


def _say(action: Running, process: Any, run: Resolution) -> bool:  # noqa: ANN401 - one that is filled
    """Fill in all that is said of how a process runs, in the order in which faults are told; return if any is."""
    sound = Sound()
    alone = run.scope.variables.keys().isdisjoint(_FOR_ALL)
    on_exit = None if action.on_exit is None else sound(run.word(action.on_exit, ON_EXIT))
    process.output = sound(output(action.output, run, process.location))
    process.restart = sound(restart(action, run))
    check_keys(action, process.restart, process.location, run)
    if not alone or action.launch_prefix is not None:
        process.prefix = sound(_prefix(action, process, run)) or ()
    process.shell = action.shell is not None and sound(run.flag(action.shell)) is True
    if action.cwd is not None:
        process.cwd = sound(_cwd(action, run))
    process.environment = sound(_environment(action, run)) or {}
    process.inherit_environment = action.env_only is None
    if not alone or action.emulate_tty is not None:
        process.emulate_tty = sound(emulate_tty(action, run))
    process.required = sound(run.flag(action.required, default=on_exit is not None)) is True
    process.shutdown_on_exit = on_exit is not None
    if action.success_exit_codes is not None:
        from orchestra.resolve.exit_codes import exit_codes  # noqa: PLC0415 - few processes have some

        process.success_exit_codes = sound(exit_codes(action, run))
    if action.ready is not None or action.alive is not None:
        from orchestra.resolve.readiness import life, readiness  # noqa: PLC0415 - few processes say it

        process.ready = None if action.ready is None else sound(readiness(action.ready, run))
        process.alive = None if action.alive is None else sound(life(action.alive, run))
    process.stop = sound(stop(action, run))
    process.depends_on += sound(dependencies(action.depends_on, run)) or ()
    if action.limits is not None:
        process.limits = sound(_limits(action, run))
    if action.stdin is not None:
        process.stdin = sound(_stdin(action, run))
    if action.warm is not None:
        process.warm = sound(run.flag(action.warm))
    return sound.faulty


def name_in_launch(process: ResolvedProcess, index: int) -> str:
    """Return the name that upstream has for a process: its label, with a number that counts all processes."""
    called = process.label or process.executable
    name = called if process.label or called.isidentifier() else Path(called).name
    return f"{name}-{index + 1}"


def words_of(process: ResolvedProcess) -> list[str]:
    """Return the command line without what the plan adds for ROS."""
    return [*process.prefix, *process.program, *process.arguments]


def _tell(process: ResolvedProcess, run: Resolution) -> None:
    """Let the object of a Python launch file know what the process is started with: user code may ask for it."""
    origin = process.origin
    take = getattr(type(origin), "_prepared_by", None)  # of a class of ours
    if process.faulty or take is None:
        return
    scope = run.scope
    if scope.environment_copy is None:  # most processes are started with the same
        scope.environment_copy = copied(scope.environment)
    environment = scope.environment_copy if process.inherit_environment else {}
    take(origin, partial(_prepared, process, len(run.found.processes) - 1, environment))


def _prepared(
    process: ResolvedProcess, index: int, environment: dict[str, str]
) -> tuple[str, list[str], str | None, dict[str, str]]:
    changed = {name: changes[-1].value for name, changes in process.environment.items()}
    own = copied(environment)
    own |= {name: value for name, value in changed.items() if value is not None}
    return name_in_launch(process, index), words_of(process), process.cwd, own


def _stdin(action: Running, run: Resolution) -> Location | Poison | None:
    """Return the place that says that the process reads what is typed."""
    reads = run.flag(action.stdin)
    if action.stdin is None or isinstance(reads, Poison):
        return POISON if isinstance(reads, Poison) else None
    return run.at(action.stdin.span) if reads else None


def _cwd(action: Running, run: Resolution) -> str | Poison | None:
    value = run.evaluate(action.cwd)
    if action.cwd is not None and isinstance(value, Value):
        check_folder(value, action.cwd, run)
    return value.text if isinstance(value, Value) else value


def _prefix(action: Running, process: ResolvedProcess, run: Resolution) -> tuple[str, ...] | Poison:
    """Return the words of the launch prefix: the action's own, or the one of the whole launch through its filter.

    A text is split after its substitutions (launch, `Executable.prepare`), so that an argument can carry all of it.
    """
    if isinstance(action.launch_prefix, tuple):
        return texts(action.launch_prefix, run)
    if action.launch_prefix is not None:
        own = run.evaluate(action.launch_prefix)
        return _words_of_prefix(own, run) if isinstance(own, Value) else POISON
    prefix, chosen = set_for_all("launch-prefix", run), set_for_all("launch-prefix-filter", run)
    if prefix is None or not prefix.text or not process.program:
        return ()
    try:
        if chosen is not None and not re.match(chosen.text, Path(process.program[0]).name):
            return ()
    except re.error as error:
        message = f"'launch-prefix-filter' is no regular expression: {error}"
        run.problems.error(Code.BAD_VALUE, message, chosen.location if chosen is not None else None)
        return POISON
    return _words_of_prefix(prefix, run)


def _words_of_prefix(prefix: Value, run: Resolution) -> tuple[str, ...] | Poison:
    try:
        import shlex  # noqa: PLC0415 - slow, and few processes have a prefix

        return tuple(shlex.split(prefix.text))
    except ValueError as error:
        run.problems.error(Code.BAD_VALUE, f"'launch-prefix' is no command: {error}", prefix.location)
        return POISON


def _environment(action: Running, run: Resolution) -> dict[str, tuple[EnvironmentChange, ...]] | Poison:
    """Return what the description changes in the environment."""
    changes = dict(run.scope.changes) if action.env_only is None else {}
    for pair in (*(action.env_only or ()), *action.env):
        name, value = run.text(pair.name), run.evaluate(pair.value)
        if not isinstance(name, str) or not isinstance(value, Value) or is_faulty_name(name, pair.name, run):
            return POISON
        warn_of_shell(pair.value, run)
        change = EnvironmentChange(value.text, run.place(pair.value), value.through)
        changes[name] = with_change(changes.get(name, ()), change)
    return changes


def _limits(action: Running, run: Resolution) -> Limits | Poison | None:
    if action.limits is None:
        return None
    from orchestra.resolve.limits import limits  # noqa: PLC0415 - few processes have some

    return limits(action.limits, run)
