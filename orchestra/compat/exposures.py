"""What third parties have added to the launch language in one resolution: actions and substitutions by name."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from orchestra.dataclass import dataclass
from orchestra.fields import field


@dataclass(slots=True)
class Exposures:
    """Parse methods by name, and parsers by language; `extended`: the installed extensions have been imported."""

    actions: dict[str, Callable[..., Any]] = field(default_factory=dict)
    substitutions: dict[str, Callable[..., Any]] = field(default_factory=dict)
    parsers: dict[str, type[Any]] = field(default_factory=dict)
    extended: bool = False

    def packages(self) -> frozenset[str]:
        """Return the top-level packages that have exposed something: the next resolution imports them anew."""
        return frozenset(module.partition(".")[0] for module in self._modules())

    def _modules(self) -> Iterator[str]:
        for method in (*self.actions.values(), *self.substitutions.values()):
            yield str(getattr(method, "__module__", ""))
