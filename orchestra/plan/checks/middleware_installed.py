"""Whether the middleware that processes ask for is installed: without it rclpy ends the interpreter with status 102."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.nearest import nearest
from orchestra.resolve.packages import ament

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.errors import Problems
    from orchestra.location import Location
    from orchestra.resolve.inputs import Inputs

_NAME: Final = "RMW_IMPLEMENTATION"
# Those that there are; another one may be the user's own.
_KNOWN: Final = (
    *("rmw_fastrtps_cpp", "rmw_fastrtps_dynamic_cpp", "rmw_cyclonedds_cpp", "rmw_zenoh_cpp"),
    *("rmw_connextdds", "rmw_connextddsmicro", "rmw_gurumdds_cpp"),
)


def check_implementation(
    name: str, value: str, location: Location | None, inputs: Inputs, problems: Problems
) -> None:
    """Report a middleware that is not installed; where nothing is started here, only one that there is not."""
    if name != _NAME or not value:
        return
    installed = implementations(inputs.environment)
    if not installed or value in installed:  # without any, there is no ROS here to be wrong
        return
    near = nearest(value, [*installed, *_KNOWN])
    if not inputs.launching and (value in _KNOWN or near is None):
        return
    meant = near if near and value not in _KNOWN else None
    written = is_written(value, location)
    told = f"{_NAME}: '{value}' is not installed"
    if meant is None:
        told += f": there is {', '.join(installed)}"
    elif not written:
        told += f"; did you mean '{meant}'?"
    problems.error(Code.MISSING_MIDDLEWARE, told, location, suggestion=meant if written else None)


def is_written(value: str, location: Location | None) -> bool:
    """Tell whether a place is that of the value itself, so that another can be put there."""
    span = location.span if location else None
    return span is not None and span.line == span.end_line and span.end_column - span.column == len(value)


def implementations(environment: Mapping[str, str]) -> list[str]:
    """Return the middlewares that are installed."""
    listed = (Path(entry) for entry in environment.get("LD_LIBRARY_PATH", "").split(os.pathsep) if entry)
    prefixes = (prefix / "lib" for prefix in ament.prefixes(environment))
    folders = dict.fromkeys([*listed, *prefixes, Path(sys.prefix, "lib")])
    names = {path.stem.removeprefix("lib") for folder in folders for path in folder.glob("librmw_*.so")}
    return sorted(name for name in names - _PARTS if "__" not in name)


# Libraries of a middleware that are none by themselves.
_PARTS: Final = frozenset({"rmw_implementation", "rmw_fastrtps_shared_cpp", "rmw_dds_common"})
