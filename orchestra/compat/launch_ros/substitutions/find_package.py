"""`FindPackagePrefix` and `FindPackageShare`: where a package is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from orchestra.compat.ament_index_python.packages import get_package_prefix, get_package_share_directory
from orchestra.compat.calls import own
from orchestra.compat.described import described
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.text import normalized, perform_alike
from orchestra.description.text import Call, Opaque, Template, Words

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.text import Part
    from orchestra.location import Span


class FindPackage(ParsedSubstitution):
    """A place of a package: the base of the two below, and of users' own that say in `find` which place it is."""

    _name = "find-pkg-prefix"
    _parameters: ClassVar[tuple[str, ...]] = ("package",)
    __package: list[Substitution] = own()

    def __init__(self, package: Sub) -> None:
        super().__init__()
        self.__package = normalized(package)

    @property
    def package(self) -> list[Substitution]:
        """The package's name."""
        return self.__package

    def find(self, package_name: str) -> str:
        """Return the place of a package. Raises `NotImplementedError` in this class."""
        raise NotImplementedError(f"{type(self).__name__} does not say what it finds of {package_name!r}")

    def describe(self) -> str:
        """Return the kind of place and the package."""
        return f"{type(self).__name__}(pkg={described(self.package)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the place. Raises `PackageNotFoundError`."""
        package = "".join(context.perform_substitution(item) for item in self.package)
        if not self._is_ours():
            return self.find(package)
        span = self._place.span
        words = Template((Words(package, span),), package, span)
        whole = Template((Call(self._name, (words,), span),), self._raw(), span)
        return context._engine.evaluate(whole)

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.package,)

    def _parts(self, span: Span) -> tuple[Part, ...]:
        if self._is_ours():
            return super()._parts(span)
        return (Opaque(self, span, self._call().arguments),)

    def _is_ours(self) -> bool:
        """Return whether `find` is one of ours, so that the launch language can say the same."""
        find: Any = type(self).find
        return find is not FindPackage.find and find.__module__.startswith("orchestra.compat.")


def _keep(self: FindPackage, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
    """See `Refusing`: only those that the launch language can say keep what they are given."""
    if keywords or len(arguments) != 1 or type(arguments[0]) is not str:
        return False
    self._as_given = arguments, keywords
    self._known_as = self._name, arguments[0]
    return True


class FindPackagePrefix(FindPackage):
    """The install prefix."""

    _keep = _keep

    def find(self, package_name: str) -> str:
        """Return the install prefix of a package. Raises `PackageNotFoundError`."""
        return get_package_prefix(package_name)


class FindPackageShare(FindPackage):
    """The share folder."""

    _name = "find-pkg-share"
    _keep = _keep

    def find(self, package_name: str) -> str:
        """Return the share folder of a package. Raises `PackageNotFoundError`."""
        return get_package_share_directory(package_name)


perform_alike(FindPackagePrefix, FindPackageShare)
