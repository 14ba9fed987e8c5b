"""`ExecuteProcess`: starts a program."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch.descriptions.executable import Executable
from orchestra.compat.launch.plain_process import OF_PROCESSES, PlainProcess, words_of
from orchestra.compat.launch_ros.made_later import Usual
from orchestra.description.actions.executable import Executable as ExecutableModel

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.launch_ros.plain_texts import Readers
    from orchestra.compat.text import Sub

_READ: Final[Readers] = {**OF_PROCESSES, "cmd": words_of("cmd", empty=None), "name": "name"}


class ExecuteProcess(PlainProcess):
    """Start a program; the arguments are those of `launch.descriptions.Executable` and of `ExecuteLocal`."""

    _usual = Usual(ExecutableModel, _READ, {"cmd": ("words", "cmd", None)}, ("cmd",))

    def __init__(
        self,
        *,
        cmd: Iterable[Sub],
        prefix: Sub | None = None,
        name: Sub | None = None,
        cwd: Sub | None = None,
        env: Mapping[Sub, Sub] | None = None,
        additional_env: Mapping[Sub, Sub] | None = None,
        **kwargs: Any,
    ) -> None:
        executable = Executable(
            cmd=cmd, prefix=prefix, name=name, cwd=cwd, env=env, additional_env=additional_env
        )
        super().__init__(process_description=executable, **kwargs)

    @classmethod
    def _parse_cmdline(cls, cmd: str, parser: Any) -> list[list[Substitution]]:
        """Return the words of a command in a launch file in XML or YAML, split by shell rules."""
        words = import_module("orchestra.compat.launch.frontend.reading.words")  # which few launch files need
        found: list[list[Substitution]] = words.parse_cmdline(cmd, parser)
        return found

    @property
    def name(self) -> Any:
        """The label of the process: a text with a number once it is prepared."""
        description = self.process_description
        return description.name if description.final_name is None else description.final_name

    @property
    def cmd(self) -> Any:
        """The command line: texts once it is prepared."""
        description = self.process_description
        return description.cmd if description.final_cmd is None else description.final_cmd

    @property
    def cwd(self) -> Any:
        """The working directory: a text once it is prepared."""
        description = self.process_description
        return description.cwd if description.final_cwd is None else description.final_cwd

    @property
    def env(self) -> Any:
        """The whole environment: a mapping once it is prepared."""
        description = self.process_description
        return description.env if description.final_env is None else description.final_env

    @property
    def additional_env(self) -> Any:
        """What is added to the environment."""
        return self.process_description.additional_env
