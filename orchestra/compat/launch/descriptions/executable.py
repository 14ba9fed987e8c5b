"""`Executable`: a program with its arguments and surroundings."""

from __future__ import annotations

import re
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.compat.explanation import told
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.launch_configuration import LaunchConfiguration
from orchestra.compat.refusing import Refusing
from orchestra.compat.text import Sub, normalized, template
from orchestra.compat.values import pairs, words

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.place import Place

_Subs: TypeAlias = list[Substitution]
_Pairs: TypeAlias = list[tuple[_Subs, _Subs]]

_COUNT = "prepared_processes"


class Executable(Refusing):
    """Each item of `cmd` and `arguments` is one word of the command line.

    `env` is the whole environment, without it the program inherits the one in scope; `additional_env` is added to
    either. `prefix` is a command that the program is started with; without it the launch configuration
    `launch-prefix` says, for the programs that match `launch-prefix-filter`. Raises `TypeError` where `cmd` is one
    text, which upstream takes apart into characters.
    """

    def __init__(
        self,
        *,
        cmd: Iterable[Sub],
        prefix: Sub | None = None,
        name: Sub | None = None,
        cwd: Sub | None = None,
        env: Mapping[Sub, Sub] | None = None,
        additional_env: Mapping[Sub, Sub] | None = None,
        arguments: Iterable[Sub] | None = None,
    ) -> None:
        self.__arguments = None if arguments is None else words(arguments, "arguments")
        self.__cmd = [normalized(word) for word in (*words(cmd, "cmd"), *(self.__arguments or ()))]
        self.__prefix = None if prefix is None else normalized(prefix)
        self.__name = None if name is None else normalized(name)
        self.__cwd = None if cwd is None else normalized(cwd)
        self.__env = _normalized_pairs(env)
        self.__additional_env = _normalized_pairs(additional_env)
        self._final: dict[str, Any] = {}

    @property
    def name(self) -> _Subs | None:
        """The label of the process."""
        return self.__name

    @property
    def prefix(self) -> _Subs:
        """The command that the program is started with."""
        if self.__prefix is None:
            return [LaunchConfiguration("launch-prefix", default="")]
        return self.__prefix

    @property
    def cmd(self) -> list[_Subs]:
        """The words of the command line; the list itself, which users append to."""
        return self.__cmd

    @property
    def cwd(self) -> _Subs | None:
        """The working directory."""
        return self.__cwd

    @property
    def env(self) -> _Pairs | None:
        """The whole environment."""
        return self.__env

    @property
    def additional_env(self) -> _Pairs | None:
        """What is added to the environment."""
        return self.__additional_env

    @property
    def arguments(self) -> list[Sub] | None:
        """The arguments, as they were given."""
        return self.__arguments

    @property
    def final_name(self) -> str | None:
        """The label with a number, None before `prepare`."""
        return self._final.get("name")

    @property
    def final_cmd(self) -> list[str] | None:
        """The command line with its prefix, None before `prepare`."""
        return self._final.get("cmd")

    @property
    def final_cwd(self) -> str | None:
        """The working directory, None before `prepare`."""
        return self._final.get("cwd")

    @property
    def final_env(self) -> dict[str, str] | None:
        """The whole environment, None before `prepare`."""
        return self._final.get("env")

    def prepare(self, context: LaunchContext, action: Any) -> None:  # noqa: ARG002 - upstream's signature
        """Perform the substitutions."""
        cmd = [_performed(word, context) for word in self.cmd]
        program = PurePath(cmd[0]).name if cmd else ""
        label = program if self.name is None else _performed(self.name, context)
        number = context.get_locals_as_dict().get(_COUNT, 0) + 1
        context.extend_globals({_COUNT: number})
        self._final = {
            "name": f"{label}-{number}",
            "cmd": [*self.__prefix_words(program, context), *cmd],
            "cwd": None if self.cwd is None else _performed(self.cwd, context),
            "env": self.__environment(context),
        }

    def _add(self, words: Iterable[str]) -> None:
        """Add words to the command line that has been prepared."""
        self._final["cmd"] += words

    def __prefix_words(self, program: str, context: LaunchContext) -> list[str]:
        """Return the prefix where it applies; a prefix of the program's own is not filtered."""
        if self.__prefix is None:
            chosen = LaunchConfiguration("launch-prefix-filter", default="").perform(context)
            if re.match(chosen, program) is None:
                return []
        import shlex  # noqa: PLC0415 - only code that prepares a process by itself needs it

        return shlex.split(_performed(self.prefix, context))

    def __environment(self, context: LaunchContext) -> dict[str, str]:
        environment = dict(context.environment) if self.env is None else {}
        for name, value in (*(self.env or ()), *(self.additional_env or ())):
            environment[_performed(name, context)] = _performed(value, context)
        return environment

    def _fields(self, place: Place) -> dict[str, Any]:
        """Return the fields of a model that say the same, without the command line and the label."""
        found: dict[str, Any] = {"env": pairs(self.additional_env or (), place.at("additional_env"))}
        if self.__prefix is not None:
            found["launch_prefix"] = template(self.__prefix, place.at("prefix"))
        if self.cwd is not None:
            found["cwd"] = template(self.cwd, place.at("cwd"))
        if self.env is not None:
            found["env_only"] = pairs(self.env, place.at("env"))
        return found


def _normalized_pairs(items: Mapping[Sub, Sub] | None) -> _Pairs | None:
    if items is None:
        return None
    if not hasattr(items, "items"):
        raise TypeError(f"an environment is a dict of names and values, this is {told(items)}")
    return [(normalized(name), _value_of(name, value)) for name, value in items.items()]


def _value_of(name: Sub, value: Sub) -> _Subs:
    """Return the value of a variable. Raises `TypeError` with the name of the variable for what is no text."""
    try:
        return normalized(value)
    except TypeError as error:
        named = f"'{name}'" if isinstance(name, str) else "a variable"
        raise TypeError(f"the value of {named} in an environment: {error}") from None


def _performed(subs: _Subs, context: LaunchContext) -> str:
    return "".join(sub.perform(context) for sub in subs)
