"""What is wrong with a command that has failed: a program or a file that is not there, or a blank."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.description.text import Template
from orchestra.errors import Code, Severity
from orchestra.location import displayed, is_python
from orchestra.nearest import is_slip
from orchestra.resolve.context import Value
from orchestra.resolve.misspelt import misspelt
from orchestra.resolve.near_paths import near_names, near_path
from orchestra.resolve.substitutions.blamed import stands_at

if TYPE_CHECKING:
    from orchestra.location import Span
    from orchestra.resolve.context import Context
    from orchestra.resolve.substitutions.arguments import Evaluate

_ASKS_THE_GRAPH = "ros2"  # whose words are names of nodes and topics
_SHELLS = frozenset({"bash", "dash", "sh", "zsh"})


def explained(
    argv: tuple[str, ...], written: Template, command: Value, context: Context, *, started: bool
) -> bool:
    """Report why a command has failed, where more is known of it than that; return whether something is."""
    if not started and _without_blank(argv[0], written, command, context):
        return True
    files = () if Path(argv[0]).name == _ASKS_THE_GRAPH else argv[1:]
    for word in files:
        if _lacks(word):
            _report_file(Path(word), written, command, context)
            return True
    if started or "/" in argv[0]:
        return False
    report_program(argv[0], _program_at(argv[0], written, command.text), context)
    return True


def look_at_files(written: Template, context: Context, evaluate: Evaluate) -> None:
    """Report files that are not there of a command whose program is not known.

    The program of a shell may write those it names, and so may what runs before it.
    """
    words = written.raw.split(maxsplit=2)
    if len(words) > 1 and Path(words[0]).name in _SHELLS and words[1] == "-c":
        return
    for part in written.parts:
        value = evaluate(Template((part,), written.raw, part.span), context)
        if isinstance(value, Value) and _lacks(value.text):
            _report_file(Path(value.text), written, value, context)


def report_program(name: str, at: Span, context: Context) -> None:
    """Report a program that is not on the PATH, once where that is no error."""
    # Here, because most programs are there.
    from orchestra.resolve.lacking import missing_program  # noqa: PLC0415

    missing = missing_program(name, context.environment, context.weights.program)
    if missing.severity is Severity.ERROR:
        context.problems.error(
            Code.MISSING_EXECUTABLE, missing.told, context.at(at), suggestion=missing.meant
        )
        return
    if f"program {name}" not in context.elsewhere:
        told = f"{missing.told}: what it would give is left open"
        context.problems.weighed(missing.severity, Code.MISSING_EXECUTABLE, told, context.at(at))
    context.elsewhere.add(f"program {name}")


def _without_blank(word: str, written: Template, command: Value, context: Context) -> bool:
    """Report that a program and the path behind it are one word, for want of a blank between them."""
    for end in range(1, len(word)):
        program, path = word[:end], word[end:]
        if path[0] != "/" or not os.path.exists(path):  # noqa: PTH110 - pathlib is slow
            continue
        is_program = "/" not in program or shutil.which(program) is not None
        at = command.text.find(word)
        if is_program and at >= 0:
            span, text = stands_at(written, command.text, at, at + end)
            told = f"a blank, ' ', is missing between {displayed(program)} and {displayed(path)}"
            instead = None if text is None else f"{text} "
            context.problems.error(Code.COMMAND_FAILED, told, context.at(span), suggestion=instead)
            return True
    return False


def _lacks(word: str) -> bool:
    """Return whether a word is the path of a file that is not there in a folder that is, or near one that is there.

    A name right below the root is hardly a file's: `/map` is a topic, `/talker` a node.
    """
    path = Path(word)
    try:
        return (
            path.is_absolute()
            and path.parent != path.parent.parent
            and not path.exists()
            and (path.parent.is_dir() or bool(near_names(path)))
        )
    except OSError:
        return False


def _report_file(path: Path, written: Template, value: Value, context: Context) -> None:
    told = f"there is no file {displayed(str(path))}"
    changes = near_names(path)
    is_sure = all(_is_sure(*(Path(name).name for name in change)) for change in changes)
    place = misspelt(value, written.raw, changes) if is_sure and not is_python(written.span) else None
    if place is not None:
        context.problems.error(Code.MISSING_FILE, told, place.at, suggestion=place.instead)
    else:
        near = near_path(path, str(path)) if is_sure else None
        context.problems.error(Code.MISSING_FILE, told, context.at(written.span), suggestion=near)


def _is_sure(name: str, near: str) -> bool:
    """Return whether a name is hardly anything but another one, mistyped or with another ending."""
    is_cut = name.startswith(near) or near.startswith(name)
    return is_cut or is_slip(name, near) or Path(name).suffix == Path(near).suffix


def _program_at(name: str, written: Template, command: str) -> Span:
    at = command.find(name)
    return written.span if at < 0 else stands_at(written, command, at, at + len(name))[0]
