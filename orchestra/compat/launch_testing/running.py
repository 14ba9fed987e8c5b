"""What only tests that run can use: it can be imported, and says so when it is called."""

from __future__ import annotations

from typing import Any


def belongs_to_running(name: str) -> type[Any]:
    """Return a class of a name that cannot be instantiated, which serves where a function is meant too."""

    def refuse(self: Any, *_: Any, **__: Any) -> None:  # noqa: ARG001 - whatever it is called with
        raise RuntimeError(f"{name} belongs to tests that run: a launch description is all there is here")

    return type(name, (), {"__init__": refuse, "__doc__": "A part of running tests.", "__module__": __name__})


IoHandler = belongs_to_running("IoHandler")
ActiveIoHandler = belongs_to_running("ActiveIoHandler")
ProcInfoHandler = belongs_to_running("ProcInfoHandler")
ActiveProcInfoHandler = belongs_to_running("ActiveProcInfoHandler")


class ReadyAggregator:
    """Calls a function once its own `ready_fn` has been called often enough."""

    def __init__(self, ready_fn: Any, num_to_aggregate: int) -> None:
        self.__ready = ready_fn
        self.__missing = num_to_aggregate

    def ready_fn(self) -> None:
        """Count a call; the last that is missing calls the function."""
        self.__missing -= 1
        if self.__missing == 0:
            self.__ready()
