"""Names of environment variables, where nothing can be set whose name is empty or holds a `=`, and their values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.location import Span, is_python
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution

# One of the paths in a value that is nothing but a variable as a shell reads it: `$PATH:/opt/bin`.
_OF_A_SHELL: Final = pattern(r"(?:(?<=:)|^)\$(?:\{([A-Za-z_]\w*)\}|([A-Z_][A-Z0-9_]*))(?=[:/]|$)")


def is_faulty_name(name: str, written: Template, run: Resolution) -> bool:
    """Report a name that is empty or holds `=`; return whether it is one."""
    if not name:
        run.problems.error(Code.BAD_NAME, "the name of a variable is empty", run.place(written))
        return True
    if "=" not in name:
        return False
    message = f"'{name}' cannot be the name of a variable: it holds '='"
    instead = name.partition("=")[0] if written.constant is not None else None
    run.problems.error(Code.BAD_NAME, message, run.place(written), suggestion=instead or None)
    return True


def warn_of_shell(written: Template, run: Resolution) -> None:
    """Tell of a value in which a shell would read a variable, which nobody else does: `$PATH:/opt/bin`."""
    if "$" not in written.raw:
        return
    found = _OF_A_SHELL.search(written.raw)
    span = written.span
    if found is None or is_python(span) or span.line != span.end_line:
        return
    at = Span(span.file, span.line, span.column + found.start(), span.line, span.column + found.end())
    message = f"'{found[0]}' stays as it is: no shell reads it"
    run.problems.warning(
        Code.SUBSTITUTION_SYNTAX, message, run.context.at(at), suggestion=f"$(env {found[1] or found[2]})"
    )
