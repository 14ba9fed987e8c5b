"""`$(file-content path)`: the text of a file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import HERE, Code, Severity
from orchestra.location import displayed
from orchestra.nearest import is_one_slip, nearest
from orchestra.resolve.context import POISON, Poison
from orchestra.resolve.refusals import refuse
from orchestra.resolve.substitutions.arguments import made

if TYPE_CHECKING:
    from orchestra.description.text import Call, Template
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the text, its last line break kept; the path is relative to the launch file, then to the working folder.

    Upstream looks in the working folder only.
    """
    found = content(call.arguments[0], context, evaluate)
    return found if isinstance(found, Poison) else made(call, context, found[1])


def content(written: Template, context: Context, evaluate: Evaluate) -> tuple[str, str] | Poison:
    """Return the name of the file that an argument names, as it is told, and its text."""
    path = evaluate(written, context)
    if isinstance(path, Poison):
        return POISON
    folders = [Path(context.file).parent, Path()] if context.file else [Path()]
    try:
        found = next((folder / path.text for folder in folders if (folder / path.text).exists()), None)
        if found is None:
            return _missing(folders[0] / path.text, path.text, written, context)
        if not found.is_file():
            return refuse(written, context, Code.UNREADABLE_FILE, f"{path.text!r} is not a regular file")
        return displayed(str(found)), found.read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        return refuse(written, context, Code.UNREADABLE_FILE, f"{path.text!r} cannot be read: {error}")


def _missing(path: Path, told: str, written: Template, context: Context) -> Poison:
    # Here, because most files that are named are there.
    from orchestra.resolve.lacking import is_of_the_machine  # noqa: PLC0415

    beside = [entry.name for entry in path.parent.iterdir()] if path.parent.is_dir() else []
    near = nearest(path.name, beside)
    weight, certain = context.weights.variable, near is not None and is_one_slip(path.name, near)
    elsewhere = is_of_the_machine(str(path), context.file or "", context.environment)
    if weight is not Severity.ERROR and elsewhere and not certain:
        message = f"there is no file {told!r} {HERE}: what it would give is left open"
        context.problems.weighed(weight, Code.MISSING_FILE, message, context.at(written.span))
        return POISON
    meant = told.removesuffix(path.name) + near if near else None
    return refuse(written, context, Code.MISSING_FILE, f"there is no file {told!r}", meant=meant)
