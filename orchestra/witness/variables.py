"""Environments that tell who reads them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping


class Watching(Protocol):
    """Is told what is read."""

    def variable(self, name: str) -> None:
        """Be told that one variable is read."""

    def all_names(self) -> None:
        """Be told that all names are read."""


class ObservedEnvironment(dict[str, str]):  # noqa: PLW1641 - as any other mapping, it has no hash
    """An environment; what is read of it is told."""

    def __init__(self, content: Mapping[str, str], watching: Watching) -> None:
        super().__init__(content)
        self.watching = watching

    def __getitem__(self, name: str) -> str:
        self.watching.variable(name)
        return super().__getitem__(name)

    def __contains__(self, name: object) -> bool:
        self.watching.variable(str(name))
        return super().__contains__(name)

    def get(self, name: str, default: Any = None) -> Any:
        """Return a variable, or the default."""
        self.watching.variable(name)
        return super().get(name, default)

    def __iter__(self) -> Iterator[str]:
        self.watching.all_names()
        return super().__iter__()

    def keys(self) -> Any:
        """Return all names."""
        self.watching.all_names()
        return super().keys()

    def items(self) -> Any:
        """Return all variables."""
        self._all()
        return super().items()

    def values(self) -> Any:
        """Return all values."""
        self._all()
        return super().values()

    def __eq__(self, other: object) -> bool:
        self._all()
        return super().__eq__(other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    def _all(self) -> None:
        self.watching.all_names()
        for name in list(dict.keys(self)):
            self.watching.variable(name)


class ObservedData(dict[bytes, bytes]):
    """The table behind `os.environ`; what is read of it is told."""

    def __init__(self, content: Mapping[bytes, bytes], watching: Watching) -> None:
        super().__init__(content)
        self._watching = watching

    def __getitem__(self, name: bytes) -> bytes:
        self._watching.variable(name.decode("utf-8", "surrogateescape"))
        return super().__getitem__(name)

    def __contains__(self, name: object) -> bool:
        if isinstance(name, bytes):
            self._watching.variable(name.decode("utf-8", "surrogateescape"))
        return super().__contains__(name)

    def __iter__(self) -> Iterator[bytes]:
        self._watching.all_names()
        return super().__iter__()

    def __setitem__(self, name: bytes, value: bytes) -> None:
        self._watching.variable(name.decode("utf-8", "surrogateescape"))  # it may be what it was
        super().__setitem__(name, value)

    def __delitem__(self, name: bytes) -> None:
        self._watching.variable(name.decode("utf-8", "surrogateescape"))
        super().__delitem__(name)


def copied(environment: Mapping[str, str]) -> dict[str, str]:
    """Return a copy of an environment, which tells as well who reads it."""
    if not isinstance(environment, ObservedEnvironment):
        return dict(environment)
    return ObservedEnvironment(dict(dict.items(environment)), environment.watching)
