"""Tests of launch descriptions: the fixtures `launch` and `plan` of the pytest plug-in, and what is behind them.

`launched` and `planned` do the same outside pytest. The names are imported when they are first asked for, since every
test session of the environment imports this package.
"""

from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from orchestra.testing.domain import free_domain
    from orchestra.testing.launching import launched
    from orchestra.testing.planning import planned
    from orchestra.testing.run import Run

__all__ = ["Run", "free_domain", "launched", "planned"]

_HOMES = {"Run": "run", "free_domain": "domain", "launched": "launching", "planned": "planning"}

if not TYPE_CHECKING:  # where types are checked, an unknown name is an error

    def __getattr__(name: str) -> object:
        """Import a public name when it is first asked for."""
        if name not in _HOMES:
            raise AttributeError(f"module 'orchestra.testing' has no attribute '{name}'")
        return getattr(import_module(f"orchestra.testing.{_HOMES[name]}"), name)

    def __dir__() -> list[str]:
        return [*globals(), *__all__]
