"""`$(command "program argument ..." [on_stderr])`: what a command prints."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import Code, Severity
from orchestra.nearest import nearest
from orchestra.resolve.context import POISON, Value
from orchestra.resolve.refusals import refuse
from orchestra.resolve.substitutions.arguments import made, span_of_arguments

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.text import Call
    from orchestra.resolve.context import CommandResult, Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate

_ON_STDERR: Final = ("fail", "ignore", "warn", "capture")
_ROS2: Final = "ros2"
_ASKING: Final = frozenset(
    ["action", "component", "control", "lifecycle", "node", "param", "service", "topic"]
)
_SHOWN: Final = 2000  # characters of standard error in a problem, its end


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Run the command without a shell and return its output, one final line break taken away.

    It fails where the status is not 0 and, by default, where anything goes to standard error; `ignore` and `warn` let
    that pass, `capture` appends it to the output. Upstream keeps the line break.
    """
    values = [evaluate(argument, context) for argument in call.arguments]
    on_stderr = _on_stderr(call, values, context)
    if on_stderr is None:
        return POISON
    if not isinstance(values[0], Value):
        # Here, because only what is missing needs it.
        from orchestra.resolve.faulty_commands import look_at_files  # noqa: PLC0415

        look_at_files(call.arguments[0], context, evaluate)
        return POISON
    command = values[0].text
    import shlex  # noqa: PLC0415 - slow, and few launch files run commands

    try:
        argv = tuple(shlex.split(command))
    except ValueError as error:
        return refuse(
            call.arguments[0], context, Code.COMMAND_FAILED, f"{command!r} cannot be split: {error}"
        )
    if not argv:
        return refuse(call.arguments[0], context, Code.COMMAND_FAILED, "the command is empty")
    if argv[0] == _ROS2 and _is_left_open(argv, call, context):
        return POISON
    result = context.run_command(argv, context.environment)
    fault = _fault(result, on_stderr)
    if fault is not None:
        # Here, because only mistakes need it.
        from orchestra.resolve.faulty_commands import explained  # noqa: PLC0415

        started = result.failure is None or not result.failure.startswith("cannot be started")
        if explained(argv, call.arguments[0], values[0], context, started=started):
            return POISON
        told, notes = f"command {argv[0]!r} {fault}", _notes(argv, result)
        context.problems.error(Code.COMMAND_FAILED, told, context.at(call.span), notes=notes)
        return POISON
    if result.stderr and on_stderr == "warn":
        told, notes = f"command {argv[0]!r} wrote to standard error", _notes(argv, result)
        context.problems.warning(Code.COMMAND_FAILED, told, context.at(call.span), notes=notes)
    output = result.stdout + result.stderr if on_stderr == "capture" else result.stdout
    return made(call, context, output.removesuffix("\n"))


def _is_left_open(argv: Sequence[str], call: Call, context: Context) -> bool:
    """Report a command that asks what runs, where nothing is to run; return whether it is one."""
    if context.weights.program is not Severity.NOTE or not set(argv[1:2]) & _ASKING:
        return False
    import shutil  # noqa: PLC0415 - as above

    if shutil.which(argv[0], path=context.environment.get("PATH")) is None:
        return False
    told = f"'{argv[0]} {argv[1]}', which asks what runs, is not run here: what it would give is left open"
    context.problems.weighed(Severity.NOTE, Code.COMMAND_FAILED, told, context.at(call.span))
    return True


def _on_stderr(call: Call, values: Sequence[Evaluated], context: Context) -> str | None:
    """Return what becomes of standard error; None where that cannot be told, which is reported."""
    if len(values) == 1:
        return "fail"
    word = values[1]
    if not isinstance(word, Value):
        return None
    if word.text in _ON_STDERR:
        return word.text
    first, second = call.arguments
    near = nearest(word.text, _ON_STDERR)
    if near is not None or first.quoted:
        told = f"on_stderr is one of {', '.join(_ON_STDERR)}, not {word.text!r}"
        refuse(second, context, Code.BAD_VALUE, told, meant=near)
    else:
        told = "the words of a command are one argument: they need quotes"
        whole, at = f"{first.raw} {second.raw}", context.at(span_of_arguments(call))
        quote = "'" if "'" not in whole else '"'
        context.problems.error(Code.SUBSTITUTION_SYNTAX, told, at, suggestion=f"{quote}{whole}{quote}")
    return None


def _fault(result: CommandResult, on_stderr: str) -> str | None:
    """Return why the result cannot be used, None where it can."""
    if result.failure is not None:
        return result.failure
    if result.status < 0:
        return f"was ended by signal {-result.status}"
    if result.status > 0:
        return f"ended with status {result.status}"
    return "wrote to standard error" if result.stderr and on_stderr == "fail" else None


def _notes(argv: tuple[str, ...], result: CommandResult) -> tuple[str, ...]:
    import shlex  # noqa: PLC0415 - as above

    said = result.stderr.strip()[-_SHOWN:]
    return (f"it is {shlex.join(argv)}", *([f"it says: {said}"] if said else []))
