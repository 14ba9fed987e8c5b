"""The isolation of launch files, kept from one to the next for as long as no code of theirs has run in it."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING

from orchestra.compat.argv import Arguments
from orchestra.resolve.python.environ import put_environment
from orchestra.resolve.python.isolation import isolated
from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from contextlib import AbstractContextManager

    from orchestra.resolve.python.isolation import Isolation


class Standing:
    """Gives what `isolated` gives, to a process that is watched and does nothing but look at launch files."""

    def __init__(self) -> None:
        self._entered: tuple[AbstractContextManager[Isolation], Isolation] | None = None
        self._environment: Mapping[str, str] | None = None

    @contextmanager
    def isolated(
        self, environment: Mapping[str, str], argv: Sequence[str], *, launching: bool = False
    ) -> Iterator[Isolation]:
        """Let launch files in Python be loaded; see `isolated`."""
        if self._entered is None:
            entering = isolated(environment, argv, launching=launching)
            self._entered = entering, entering.__enter__()
        else:
            if environment is not self._environment:
                put_environment(environment)
            sys.argv = Arguments(argv)
        self._environment = environment  # which only code changes
        context, isolation = self._entered
        try:
            yield isolation
        finally:
            if isolation.remaining is not None:
                isolation.renew(environment)
                sys.argv = Arguments(argv)
            elif observer().ran_freely:
                self._entered = None
                context.__exit__(None, None, None)
            elif observer().ran_code:
                self._environment = None  # it was run in that of its scope
