"""`RunningProcessEvent`: something happens to a process that was started."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.event import Event

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


class RunningProcessEvent(Event):
    """The base of what happens to a process; it says which one, as it was started."""

    name = "launch.events.process.RunningProcessEvent"

    def __init__(
        self,
        *,
        action: Any,
        name: str,
        cmd: Sequence[str],
        cwd: str | None,
        env: Mapping[str, str] | None,
        pid: int,
    ) -> None:
        self.__action = action
        self.__name = name
        self.__cmd = list(cmd)
        self.__cwd = cwd
        self.__env = env
        self.__pid = pid

    @property
    def action(self) -> Any:
        """The action that started the process."""
        return self.__action

    @property
    def execute_process_action(self) -> Any:
        """The same, by its older name."""
        return self.__action

    @property
    def process_name(self) -> str:
        """The name of the process, which is unique in the run."""
        return self.__name

    @property
    def cmd(self) -> list[str]:
        """The command line."""
        return self.__cmd

    @property
    def cwd(self) -> str | None:
        """The working directory, None: that of the launch."""
        return self.__cwd

    @property
    def env(self) -> Mapping[str, str] | None:
        """The environment."""
        return self.__env

    @property
    def pid(self) -> int:
        """The process id."""
        return self.__pid
