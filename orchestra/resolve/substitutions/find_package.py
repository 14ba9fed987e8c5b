"""`$(find-pkg-share package)` and `$(find-pkg-prefix package)`: where a package is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.context import POISON, Poison
from orchestra.resolve.refusals import refuse, report_missing_package
from orchestra.resolve.substitutions.arguments import made

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def share(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the share folder of the package."""
    return _found(call, context, evaluate, context.packages.share)


def prefix(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the install prefix of the package."""
    return _found(call, context, evaluate, context.packages.prefix)


def _found(
    call: Call, context: Context, evaluate: Evaluate, folder_of: Callable[[str], str | None]
) -> Evaluated:
    written = call.arguments[0]
    package = evaluate(written, context)
    if isinstance(package, Poison):
        return POISON
    folder = folder_of(package.text)
    if folder is None and "/" in package.text and written.constant is not None:
        first, _, rest = package.text.partition("/")
        told = f"{package.text!r} is no name of a package: write $({call.name} {first})/{rest}"
        return refuse(written, context, Code.MISSING_PACKAGE, told)
    if folder is None:
        return report_missing_package(package.text, written, context)
    return made(call, context, folder)
