"""The packages of definitions that can be used although they are not installed.

They are sources, what was built of sources, what Python packages bring (in the folder `interfaces` of the package
`demo` are the definitions of `demo_interfaces`) and what Orchestra brings.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.resolve.interfaces import prefixes, sources
from orchestra.witness.place import folder as cache_folder

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.resolve.interfaces.sources import Source

_PROVIDED: Final = Path(__file__).parents[2] / "ros" / "interfaces" / "provided"


def available(start: Path, environment: Mapping[str, str]) -> dict[str, Source]:
    """Return them by their names; those around a folder win, then those that were built."""
    around = sources.found_in(sources.places(start, environment))
    return provided() | _brought([*map(Path, sys.path), start]) | built(environment) | around


def _brought(folders: Iterable[Path]) -> dict[str, Source]:
    """Return the definitions that Python packages have in folders of theirs."""
    found: dict[str, Source] = {}
    for folder in dict.fromkeys(folders):
        for kind in sources.KINDS:
            for path in folder.glob(f"*/interfaces/{kind}"):
                name = f"{path.parents[1].name}_interfaces"
                source = sources.in_folder(path.parent, name) if name not in found else None
                if source is not None:
                    found[name] = source
    return found


def provided() -> dict[str, Source]:
    """Return the packages that Orchestra brings the definitions of, because no wheel has them."""
    found = (sources.in_folder(path, path.name) for path in sorted(_PROVIDED.iterdir()))
    return {source.name: source for source in found if source is not None}


def built(environment: Mapping[str, str]) -> dict[str, Source]:
    """Return what was built: as its source is now, or as it was where that has gone."""
    where = cache_folder(environment)
    found: dict[str, Source] = {}
    if where is None:
        return found
    for name, prefix in prefixes.latest(Path(where, "interfaces")).items():
        told = str(prefixes.record(prefix)["source"])
        source = sources.in_folder(Path(told), name) or sources.in_folder(prefix / "share" / name, name)
        if source is not None:
            found[name] = source
    return found
