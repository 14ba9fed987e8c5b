"""What the files of one tree share: the files they include, and the packages they ask for, are looked up once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.compat.seam import connection, is_connected
from orchestra.errors import Problems
from orchestra.fields import replace
from orchestra.load.files import PYTHON, load
from orchestra.witness.looking import signature
from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.description.launch import Description
    from orchestra.errors import Problem
    from orchestra.location import Span
    from orchestra.witness.record import Record, Signature


_MOST: Final = 192  # files: to keep all of a large tree takes longer than to read some of them twice


class _Loaded(NamedTuple):
    description: Description
    problems: tuple[Problem, ...]
    record: Record
    signature: Signature
    named: frozenset[str]


class SharedLoader:
    """Loads launch files; what is written in XML or YAML once for the files that soon after it include it, too.

    `names` gives what a description names. `named` collects that for all that has been loaded since it was cleared.
    """

    def __init__(self, names: Callable[[Description], set[str]]) -> None:
        self.named: set[str] = set()
        self._names = names
        self._known: dict[tuple[str, str | None], _Loaded] = {}

    def load(
        self, path: str, problems: Problems, chain: tuple[Span, ...] = (), ending: str | None = None
    ) -> Description | None:
        """Read a launch file, as `orchestra.load.files.load` does."""
        # Code of Python files may have added to the language of the others.
        if (ending or path).endswith(PYTHON) or _is_extended():
            return self._load(path, problems, chain, ending)
        known = self._found(path, ending)
        if known is None:
            return self._load(path, problems, chain, ending)
        observer().depend(known.record)
        self.named |= known.named
        problems.extend(
            replace(problem, included_from=(*problem.included_from, *chain)) for problem in known.problems
        )
        return known.description

    def read(self, path: str) -> None:
        """Read a launch file in XML or YAML that is asked for soon."""
        self._found(path, None)

    def _load(
        self, path: str, problems: Problems, chain: tuple[Span, ...], ending: str | None
    ) -> Description | None:
        description = load(path, problems, chain, ending)
        if description is not None:
            self.named |= self._names(description)
        return description

    def _found(self, path: str, ending: str | None) -> _Loaded | None:
        """Return what is known of a file, else what `_read` gives."""
        known = self._known.get((path, ending))
        if known is None or signature(path) != known.signature:
            known = self._read(path, ending)
        if known is not None:
            self._keep((path, ending), known)
        return known

    def _read(self, path: str, ending: str | None) -> _Loaded | None:
        """Read a file for all who include it; None where it cannot be read, and each has to tell where it names it."""
        found, before = Problems(), signature(path)
        with observer().part() as record:
            description = load(path, found, (), ending)
            named = set() if description is None else self._names(description)
        if description is None or before is None or _is_extended():
            return None
        return _Loaded(description, tuple(found), record, before, frozenset(named))

    def _keep(self, key: tuple[str, str | None], loaded: _Loaded) -> None:
        """Keep what was used last, and let go of what was not used for longest."""
        known = self._known
        known.pop(key, None)
        known[key] = loaded
        if len(known) > _MOST:
            del known[next(iter(known))]


def _is_extended() -> bool:
    """Tell whether somebody has added to the language, or might have: an unknown word has been asked for."""
    return is_connected() and "front_end" in vars(connection())
