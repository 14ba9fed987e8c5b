"""Findings of earlier checks that are still true."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING

from orchestra.cli.look.finding import Finding
from orchestra.cli.look.questions import Questions
from orchestra.witness.identity import identity
from orchestra.witness.place import folder
from orchestra.witness.store import Store
from orchestra.witness.world import World

if TYPE_CHECKING:
    from orchestra.cli.targets import Target
    from orchestra.resolve.inputs import Inputs
    from orchestra.witness.record import Record


class Kept:
    """The findings that earlier checks have left in the user's cache; without a folder for that there are none."""

    def __init__(self, inputs: Inputs, *, wanted: bool = True) -> None:
        place = folder(inputs.environment) if wanted else None
        self._store = None if place is None else Store(os.path.join(place, "check"))  # noqa: PTH118 - pathlib is slow
        if self._store is not None:
            self._world = World(inputs.environment, Questions(inputs.environment).answer)
            self._names = self._store.names()
            self._identity = identity(inputs.environment)
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

    def finding(self, target: Target) -> Finding | None:
        """Return what was found in a file if nothing has changed that it depends on."""
        if self._store is None:
            return None
        key = self._key(target)
        found = self._store.read(key) if self._store.has(key, self._names) else None
        if found is None or not self._world.holds(found[0]):
            return None
        try:
            return Finding.from_data(found[1])
        except (KeyError, TypeError, ValueError):
            return None

    def keep(self, target: Target, finding: Finding, record: Record) -> None:
        """Keep a finding for later checks."""
        if self._store is not None:
            self._store.write(self._key(target), record, finding.as_data())

    def tidy(self) -> None:
        """Remove what was not used for longest, where there is too much."""
        if self._store is not None:
            self._store.prune()

    def _key(self, target: Target) -> str:
        path = os.path.abspath(target.path)  # noqa: PTH100 - pathlib is slow
        return json.dumps([self._identity, target.kind, path, self._given])
