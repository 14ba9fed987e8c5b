"""Findings of earlier checks that are still true."""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING, Any, Final

from orchestra.cli.look.finding import Finding
from orchestra.cli.look.questions import Questions
from orchestra.witness.batches import Batches
from orchestra.witness.identity import identity as identity_now
from orchestra.witness.place import folder
from orchestra.witness.world import World

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.cli.targets import Target
    from orchestra.resolve.inputs import Inputs
    from orchestra.witness.record import Record


_WAITING: Final = 1.0  # seconds that findings wait to be written, for then they are lost with this process


def anything_kept(environment: Mapping[str, str]) -> bool:
    """Tell whether an earlier check has left anything, be it true or not."""
    place = _place(environment)
    try:
        return place is not None and bool(os.listdir(place))  # noqa: PTH208 - no paths are wanted
    except OSError:
        return False


def _place(environment: Mapping[str, str]) -> str | None:
    place = folder(environment)
    return None if place is None else os.path.join(place, "check")  # noqa: PTH118 - pathlib is slow


class Kept:
    """The findings that earlier checks have left in the user's cache; without a folder for that there are none.

    `identity` is what the function of that name returns for the environment, where that is known already.
    """

    def __init__(self, inputs: Inputs, *, wanted: bool = True, identity: str | None = None) -> None:
        place = _place(inputs.environment) if wanted else None
        self._store = None if place is None else Batches(place)
        self._new: list[tuple[str, Record, Any]] = []
        self._since = time.monotonic()
        if self._store is not None:
            self._world = World(inputs.environment, Questions(inputs.environment).answer)
            self._identity = identity or identity_now(inputs.environment)
            self._given = repr(
                (
                    inputs.arguments,
                    inputs.parameters,
                    inputs.parameter_files,
                    inputs.required,
                    inputs.noninteractive,
                    inputs.debug,
                    sorted(inputs.severity.items()),
                )
            )

    @property
    def is_empty(self) -> bool:
        """Whether no earlier check has left anything that can be read."""
        return self._store is None or self._store.is_empty

    def finding(self, target: Target) -> Finding | None:
        """Return what was found in a file if nothing has changed that it depends on."""
        if self._store is None:
            return None
        found = self._store.read(self._key(target))
        if found is None or not self._world.holds(found[0]):
            return None
        try:
            return Finding.from_data(found[1])
        except (KeyError, TypeError, ValueError):
            return None

    def keep(self, target: Target, finding: dict[str, Any], record: Record) -> None:
        """Keep a finding, as data, for later checks, once it is `written`."""
        if self._store is not None and not record.unknown:
            self._new.append((self._key(target), record, finding))
            if time.monotonic() - self._since > _WAITING:
                self.written()

    def written(self) -> None:
        """Write what is to be kept."""
        if self._store is not None and self._new:
            self._store.write(self._new)
            self._new.clear()
        self._since = time.monotonic()

    def tidy(self) -> None:
        """Remove what was kept first, where there is too much."""
        if self._store is not None:
            self._store.tidy()

    def _key(self, target: Target) -> str:
        path = os.path.abspath(target.path)  # noqa: PTH100 - pathlib is slow
        return f"{self._identity}\0{target.kind}\0{path}\0{self._given}"
