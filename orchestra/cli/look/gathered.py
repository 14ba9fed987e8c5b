"""The files that a check looks at, found while what looks at them is imported."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from orchestra.cli.checking import get_ready
from orchestra.cli.look.ahead import ahead
from orchestra.cli.look.kept import anything_kept
from orchestra.cli.targets import Target, targets
from orchestra.witness.identity import identity

if TYPE_CHECKING:
    from collections.abc import Sequence


def gathered(paths: Sequence[str], jobs: int, *, cache: bool) -> tuple[tuple[Target, ...], str | None]:
    """Return what `targets` returns, and the identity of Orchestra here where that has been found out.

    Where nothing is known, and folders are to be walked through, another process does that: this one gets ready to look
    at files meanwhile, which is half of the time until the first is looked at.
    """
    if jobs > 1 and any(map(os.path.isdir, paths)) and not (cache and anything_kept(os.environ)):
        with ahead(lambda: _found(paths, cache=cache)) as wait:
            get_ready()
            told = wait()
        if told is not None:
            return tuple(Target(*item) for item in told["targets"]), told["identity"]
    return targets(paths), None


def _found(paths: Sequence[str], *, cache: bool) -> dict[str, Any]:
    found = [[target.path, target.kind] for target in targets(paths)]
    return {"targets": found, "identity": identity(os.environ) if cache else None}
