"""Names of environment variables: nothing can be set whose name holds a `=`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution


def is_faulty_name(name: str, written: Template, run: Resolution) -> bool:
    """Report a name that holds `=`; return whether it does."""
    if "=" not in name:
        return False
    message = f"'{name}' cannot be the name of a variable: it holds '='"
    instead = name.partition("=")[0] if written.constant is not None else None
    run.problems.error(Code.BAD_NAME, message, run.place(written), suggestion=instead or None)
    return True
