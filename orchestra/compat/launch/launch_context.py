"""`launch.LaunchContext`: what user code sees of the state of a resolution."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.argv import look
from orchestra.compat.seam import connection

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, MutableMapping

    from orchestra.compat.seam import Engine


class LaunchContext:
    """Configurations, environment and locals; writing to the first two is seen by all that follows in the scope.

    Built by users, it has a state of its own. Raises `RuntimeError` outside the loading of launch files.
    """

    def __init__(
        self,
        *,
        argv: Iterable[str] | None = None,
        noninteractive: bool = False,
        _engine: Engine | None = None,
    ) -> None:
        self.__argv = list(argv) if argv is not None else []
        self.__noninteractive = noninteractive
        self.__is_of_run = _engine is not None
        self._engine = _engine if _engine is not None else connection().engine(self.__argv)
        self.__globals: dict[str, Any] = {}
        self.__locals: dict[str, Any] = {}
        self.__outer_locals: list[dict[str, Any]] = []
        self._is_shutdown = False

    @property
    def argv(self) -> list[str]:
        """The words of the command line after the launch file."""
        look()
        return self.__argv

    @property
    def noninteractive(self) -> bool:
        """Whether no terminal is assumed."""
        return self.__noninteractive

    @property
    def is_shutdown(self) -> bool:
        """Whether the run is ending."""
        return self._is_shutdown

    @property
    def asyncio_loop(self) -> Any:
        """The event loop that runs, else one that keeps for the run what it is given; None in one built by users."""
        return self._engine.loop() if self.__is_of_run else None

    @property
    def launch_configurations(self) -> MutableMapping[str, Any]:
        """The launch configurations of the current scope."""
        return self._engine.configurations

    @property
    def environment(self) -> MutableMapping[str, str]:
        """The environment of the current scope."""
        return self._engine.environment

    @property
    def locals(self) -> Locals:
        """What is known at this moment only, by attribute."""
        return Locals(self.get_locals_as_dict())

    def get_locals_as_dict(self) -> dict[str, Any]:
        """Return what is known at this moment."""
        known = dict(self.__globals)
        file = self._engine.current_file
        if file is not None:
            known["current_launch_file_path"] = file
            known["current_launch_file_directory"] = file.rpartition("/")[0]
        return known | self.__locals

    def extend_locals(self, extensions: Mapping[str, Any]) -> None:
        """Make more known, until the event that is being handled is over."""
        self.__locals.update(extensions)

    def extend_globals(self, extensions: Mapping[str, Any]) -> None:
        """Make more known, for good."""
        self.__globals.update(extensions)

    def _push_locals(self) -> None:
        self.__outer_locals.append(dict(self.__locals))

    def _pop_locals(self) -> None:
        if not self.__outer_locals:
            raise RuntimeError("there are no locals to pop")
        self.__locals = self.__outer_locals.pop()

    def _push_launch_configurations(self) -> None:
        self._engine.push_configurations()

    def _pop_launch_configurations(self) -> None:
        self._engine.pop_configurations()

    def _push_environment(self) -> None:
        self._engine.push_environment()

    def _pop_environment(self) -> None:
        self._engine.pop_environment()

    def _reset_environment(self) -> None:
        self._engine.reset_environment()

    def perform_substitution(self, sub: Any) -> str:
        """Return what a substitution comes to."""
        text: str = sub.perform(self)
        return text

    def register_event_handler(self, event_handler: Any, append: bool = False) -> None:
        """Let a handler wait for its event, before those that do already unless it is to be appended."""
        self._engine.register(event_handler, first=not append)

    def unregister_event_handler(self, event_handler: Any) -> None:
        """Let a handler wait no more. Raises `ValueError` where it does not."""
        self._engine.unregister(event_handler)

    def emit_event_sync(self, event: Any) -> None:
        """Let an event happen after the present visit."""
        self._engine.emit(event)

    async def emit_event(self, event: Any) -> None:
        """Let an event happen after the present visit."""
        self._engine.emit(event)

    def would_handle_event(self, event: Any) -> bool:
        """Return whether a handler waits for such an event."""
        return self._engine.would_handle(event)

    def add_completion_future(self, future: Any) -> None:
        """Take a future that nothing waits for: a run ends when its processes have."""


class Locals:
    """Values by attribute, to be read only. Raises `AttributeError` that names what is known."""

    def __init__(self, known: Mapping[str, Any]) -> None:
        object.__setattr__(self, "_known", known)

    def __getattr__(self, name: str) -> Any:
        known: Mapping[str, Any] = object.__getattribute__(self, "_known")
        if name in known:
            return known[name]
        names = ", ".join(sorted(known))
        raise AttributeError(f"the context has no local '{name}', only: {names}")

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"the local '{name}' cannot be set: use extend_locals")
