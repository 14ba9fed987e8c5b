"""Where the `package.xml` of a Python package is: in its folder or, as in a source tree, beside that."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.resolve.model import Resolved, ResolvedProcess

_NAME = "package.xml"


def has_manifests(resolved: Resolved) -> bool:
    """Tell whether a node or component is of a package that says in a file what it needs, and not of ament's."""
    return any(map(may_need_definitions, resolved.processes)) or any(
        component.share is not None and manifest_beside(component.share) is not None
        for component in resolved.components
    )


def may_need_definitions(process: ResolvedProcess) -> bool:
    """Tell whether a process is a node of such a package."""
    return process.kind != "process" and manifest_of(process) is not None


def manifest_of(process: ResolvedProcess) -> str | None:
    """Return the `package.xml` of the Python package or script of a process, None where it has none."""
    if process.share is not None:
        return manifest_beside(process.share)
    if process.kind == "process" or process.package is not None:
        return None
    script = next((word for word in process.program if word.endswith(".py")), None)
    return _first(_above(os.path.abspath(script))) if script else None  # noqa: PTH100 - pathlib is slow


def manifest_beside(share: str) -> str | None:
    """Return the `package.xml` of the package with this share folder, None where ament has installed it."""
    above = os.path.dirname(share)  # noqa: PTH120 - pathlib is slow
    return None if os.path.basename(above) == "share" else _first([share, above])  # noqa: PTH119 - as above


def _above(path: str) -> list[str]:
    found = []
    while (above := os.path.dirname(path)) != path:  # noqa: PTH120 - as above
        found.append(above)
        path = above
    return found


def _first(folders: list[str]) -> str | None:
    paths = (os.path.join(folder, _NAME) for folder in folders)  # noqa: PTH118 - as above
    return next((path for path in paths if os.path.isfile(path)), None)  # noqa: PTH113 - as above
