"""`ExecutableInPackage`: the path of an executable of a package."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.calls import CallSubstitution
from orchestra.compat.described import described
from orchestra.compat.launch_ros.substitutions.find_package import FindPackagePrefix
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class ExecutableInPackage(FindPackagePrefix):
    """The path, usually `PREFIX/lib/PACKAGE/EXECUTABLE`."""

    _name = "exec-in-pkg"
    _parameters = ("executable", "package")

    def __init__(self, executable: Sub, package: Sub) -> None:
        super().__init__(package)
        self.__executable = normalized(executable)

    @property
    def executable(self) -> list[Substitution]:
        """The executable's name."""
        return self.__executable

    def describe(self) -> str:
        """Return package and executable."""
        return f"ExecInPkg(pkg={described(self.package)}, exec={described(self.executable)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the path. Raises `PackageNotFoundError`, and `SubstitutionFailure` where it has no such executable."""
        return CallSubstitution.perform(self, context)

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.executable, self.package)
