"""Packages that code of a launch file looks for and that are not here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.explanation import Explanation
from orchestra.compat.literals import argument_span
from orchestra.compat.seam import connection
from orchestra.errors import Code

if TYPE_CHECKING:
    from orchestra.compat.ament_index_python.packages import PackageNotFoundError
    from orchestra.compat.place import Place


def explained(error: PackageNotFoundError, place: Place) -> Explanation:
    """Explain a package that is not here, at its name where the code has it; others may raise this too."""
    if error.package is None:
        return Explanation(f"PackageNotFoundError: {error}", Code.MISSING_PACKAGE)
    severity, told, meant = connection().missing_package(error.package)
    span = argument_span(place, error.package) or place.span
    return Explanation(told, Code.MISSING_PACKAGE, span, meant, (), severity)
