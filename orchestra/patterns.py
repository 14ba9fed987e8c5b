"""Regular expressions that are compiled when they are first used: most of those that are imported never are.

`re` works in Python: all that a launch imports take as long to compile as the interpreter takes to start.
"""

from __future__ import annotations

import re
from contextlib import contextmanager

TYPE_CHECKING = False  # `typing` itself costs more than this module, which the supervisor imports too
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any, AnyStr

_METHODS = ("match", "fullmatch", "search", "sub", "subn", "split", "findall", "finditer")


def pattern(text: AnyStr, flags: int = 0) -> re.Pattern[AnyStr]:
    """Return what `re.compile` would. Whoever uses it first may get the `re.error` that it would have raised."""
    late: Any = _Late(text, flags)  # it has all that is asked of one
    return late  # type: ignore[no-any-return]


@contextmanager
def late() -> Iterator[None]:
    """Have the modules of others that are imported meanwhile compile theirs when they are first used, too."""
    library: Any = re
    compiled = library.compile
    library.compile = pattern
    try:
        yield
    finally:
        library.compile = compiled


class _Late:
    """An expression that has its methods as attributes of its own from its first use on, so none costs more later."""

    def __init__(self, text: str | bytes, flags: int) -> None:
        self._text = text
        self._flags = flags

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - whatever an expression has
        if name.startswith("__"):  # what copies or inspects it asks for these
            raise AttributeError(name)
        made = re.compile(self._text, self._flags)
        for method in _METHODS:
            setattr(self, method, getattr(made, method))
        return getattr(made, name)

    def __repr__(self) -> str:
        return f"pattern({self._text!r}, {self._flags!r})"
