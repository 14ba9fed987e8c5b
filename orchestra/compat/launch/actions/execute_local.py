"""`ExecuteLocal`: starts a process."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from orchestra.compat.explanation import told
from orchestra.compat.extensions import RUNNING, extension_fields, taken
from orchestra.compat.launch.action import Action, ModelledAction
from orchestra.compat.launch.event_handler import entities_of, is_of_ours
from orchestra.compat.launch.substitutions.launch_configuration import LaunchConfiguration
from orchestra.compat.text import normalized, template
from orchestra.compat.values import optional, output_field, scalar, written
from orchestra.compat.wrong import WrongType
from orchestra.description.actions.executable import Executable as ExecutableModel
from orchestra.description.running import Running

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.compat.launch.actions.shutdown_action import Shutdown
    from orchestra.compat.launch.descriptions.executable import Executable
    from orchestra.compat.launch.event import Event
    from orchestra.compat.launch.event_handlers.on_action_event_base import OnActionEventBase
    from orchestra.compat.launch.events.process.running_process_event import RunningProcessEvent
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model
    from orchestra.description.handlers import Handler

OVERRIDE = "OVERRIDE_LAUNCH_PROCESS_OUTPUT"
_TRUTHS, _NUMBERS = frozenset({bool, type(None)}), frozenset({float, int, type(None)})


class ExecuteLocal(ModelledAction):
    """Start a process.

    Where `output` is not said, both streams go to the screen and to the log. `on_exit` is entities, or a callable that
    takes event and context and returns some; it is looked at each time the process ends. The environment variable
    OVERRIDE_LAUNCH_PROCESS_OUTPUT stands for every `output`, as upstream. `output_format` and `log_cmd` have no effect.
    Orchestra's own keys are keywords too: `RUNNING`.
    """

    _more_keywords: tuple[str, ...] = RUNNING

    def __init__(  # noqa: PLR0913 - upstream's signature
        self,
        *,
        process_description: Executable,
        shell: bool = False,
        sigterm_timeout: Sub | float | None = None,
        sigkill_timeout: Sub | float | None = None,
        emulate_tty: bool | Sub | None = None,
        output: Sub | Mapping[str, Any] | None = None,
        output_format: str = "[{this.process_description.final_name}] {line}",
        cached_output: bool = False,
        log_cmd: bool = False,
        on_exit: Any = None,
        respawn: bool | Sub = False,
        respawn_delay: Sub | float | None = None,
        respawn_max_retries: int = -1,
        **kwargs: Any,
    ) -> None:
        self.__extensions = taken(kwargs, self._more_keywords)
        super().__init__(**kwargs)
        self.__process_description = process_description
        self.__shell = shell
        self.__timeouts = {"sigterm_timeout": sigterm_timeout, "sigkill_timeout": sigkill_timeout}
        self.__emulate_tty = emulate_tty
        self.__output = os.environ.get(OVERRIDE, output)
        if not (self.__output is None or isinstance(self.__output, dict)):
            self.__output = normalized(self.__output)
        self.__output_format = output_format
        self.__cached_output = cached_output
        self.__log_cmd = log_cmd
        self.__on_exit = _checked_exit(on_exit)
        self.__respawn = respawn if isinstance(respawn, bool) else normalized(respawn)
        self.__respawn_delay = respawn_delay
        self.__respawn_max_retries = respawn_max_retries
        self._details: dict[str, Any] | None = None
        self._return_code: int | None = None
        self.__written = {"stdout": bytearray(), "stderr": bytearray()}
        flags = respawn, shell, cached_output, log_cmd, emulate_tty
        numbers, others = (respawn_delay, respawn_max_retries), map(type, (*flags, *self.__timeouts.values()))
        if not (_TRUTHS.issuperset(others) and _NUMBERS.issuperset(map(type, numbers))):
            from orchestra.compat.refused_upstream import tell_of_process  # noqa: PLC0415 - few have such

            tell_of_process((*flags, *numbers), self.__timeouts, self._place)

    @property
    def process_description(self) -> Executable:
        """The program."""
        return self.__process_description

    @property
    def shell(self) -> bool:
        """Whether a shell reads the command."""
        return self.__shell

    @property
    def emulate_tty(self) -> bool | Sub:
        """Whether the output is a terminal."""
        return False if self.__emulate_tty is None else self.__emulate_tty

    @property
    def sigterm_timeout(self) -> list[Substitution]:
        """Seconds from SIGINT to SIGTERM."""
        return self.__timeout("sigterm_timeout")

    @property
    def sigkill_timeout(self) -> list[Substitution]:
        """Seconds from SIGTERM to SIGKILL."""
        return self.__timeout("sigkill_timeout")

    @property
    def output(self) -> Any:
        """Where the output goes."""
        return normalized("log") if self.__output is None else self.__output

    @property
    def process_details(self) -> dict[str, Any] | None:
        """What the process was started with, and its `pid` where it runs; None before it is prepared."""
        return self._details

    @property
    def return_code(self) -> int | None:
        """The exit status, None before the end."""
        return self._return_code

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities of `on_exit` where they are a list."""
        return self.__on_exit if isinstance(self.__on_exit, list) else []

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start the process, prepared first where a subclass says how."""
        if not is_of_ours(self, "prepare"):
            self.prepare(context)
        return super().execute(context)

    def prepare(self, context: LaunchContext) -> None:
        """Perform the substitutions of the program."""
        description = self.process_description
        description.prepare(context, self)
        description._add(self._words_of_its_own(context))
        self._details = {"action": self, **description._final}

    def _prepared_by(self, details: Callable[[], tuple[Any, ...]]) -> None:
        """Take note of what gives what a visit has come to."""
        self._prepared_as(*details())

    def _prepared_as(self, name: str, cmd: list[str], cwd: str | None, env: dict[str, str]) -> None:
        """Take note of what a visit has come to."""
        self.process_description._final = {"name": name, "cmd": cmd, "cwd": cwd, "env": env}
        self._details = {"action": self, **self.process_description._final}

    def _words_of_its_own(self, context: LaunchContext) -> list[str]:  # noqa: ARG002 - for subclasses
        """Return the words that a kind of process adds to its command line."""
        return []

    def get_stdout(self) -> str:
        """Return what the process has written. Raises `RuntimeError` without `cached_output`."""
        return self.__cached("stdout")

    def get_stderr(self) -> str:
        """Return what the process has written to standard error. Raises `RuntimeError` without `cached_output`."""
        return self.__cached("stderr")

    def _is_as_described(self) -> bool:
        return super()._is_as_described() and is_of_ours(self, "prepare")

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        """Return the model of the process; in a group where handlers of its own are to wait before it starts."""
        handlers = tuple(self._handlers())
        if not handlers:
            return self._process_model(common)
        # Here, because few processes have any.
        from orchestra.description.actions.group import Group  # noqa: PLC0415
        from orchestra.description.actions.register_event_handler import RegisterEventHandler  # noqa: PLC0415

        span = self._place.span
        children = (RegisterEventHandler.at(span, handlers=handlers), self._process_model({"origin": self}))
        condition = {name: value for name, value in common.items() if name != "origin"}
        return Group.at(span, scoped=scalar(value=False, span=span), children=children, **condition)

    def _process_model(self, common: Mapping[str, Any]) -> Model:
        """Return the model of the process alone. Kinds of nodes have models of their own."""
        at, description = self._place.at, self.process_description
        words = tuple(template(word, at("cmd", index)) for index, word in enumerate(description.cmd))
        name = optional(description.name, at("name"))
        return ExecutableModel.at(self._place.span, cmd=words, name=name, **self._running_fields(), **common)

    def _running_fields(self) -> dict[str, Any]:
        """Return the fields that the models of all processes share, without the name."""
        span, at, ending = self._place.span, self._place.at, self.__ending()
        explained = ending is not None and ending._has_reason
        given = {
            "shell": self.__shell or None,
            "emulate_tty": self.__emulate_tty,
            "respawn": self.__respawn or None,
            "respawn_delay": _delay(self.__respawn_delay),
            "respawn_max_retries": None if self.__respawn_max_retries == -1 else self.__respawn_max_retries,
            **self.__timeouts,
        }
        found = self.process_description._fields(self._place)
        found |= {name: scalar(value, at(name)) for name, value in given.items() if value is not None}
        if self.__output is not None:
            found["output"] = output_field(self.__output, at("output"))
        if explained:
            found["required"] = scalar(value=True, span=span)
        elif ending is not None:
            found["on_exit"] = template("shutdown", span)
        return found | self._extension_fields(self.__extensions) if self.__extensions else found

    def _extension_fields(self, extensions: Mapping[str, Any]) -> dict[str, Any]:
        """Return the fields for Orchestra's own keywords. Kinds of nodes take more of them."""
        return extension_fields(Running, extensions, self._place)

    def _handlers(self) -> list[Handler]:
        """Return what is done about the events of this process."""
        if self.__on_exit is None and not self.__cached_output:
            return []
        # Here, as above.
        from orchestra.compat.launch.events.process.process_exited import ProcessExited  # noqa: PLC0415
        from orchestra.compat.launch.events.process.process_io import ProcessIO  # noqa: PLC0415

        handlers, ending = [], self.__ending()
        if self.__on_exit is not None and (ending is None or ending._has_reason):
            handlers.append(self.__handler(ProcessExited, self.__on_exit))
        if self.__cached_output:
            keeper = self.__handler(ProcessIO, self.__cache)
            keeper._serves_code = True
            handlers.append(keeper)
        return [model for handler in handlers for model in handler._to_models()]

    def __handler(self, event: type[Event], done: Any) -> OnActionEventBase:
        from orchestra.compat.launch.event_handlers.on_action_event_base import (  # noqa: PLC0415 - as above
            OnActionEventBase,
        )

        handler = OnActionEventBase(
            action_matcher=self, on_event=done, target_event_cls=event, target_action_cls=ExecuteLocal
        )
        handler._place = self._place
        return handler

    def __cache(self, event: Any, _: LaunchContext) -> None:
        """Keep what the process has written."""
        self.__written["stdout" if event.from_stdout else "stderr"] += event.text

    def _observe(self, event: RunningProcessEvent) -> None:
        """Take note of what has happened to the process; whoever delivers events calls this before."""
        self._details = {
            "action": self,
            "name": event.process_name,
            "cmd": event.cmd,
            "cwd": event.cwd,
            "env": event.env,
            "pid": event.pid,
        }
        self._return_code = getattr(event, "returncode", None)

    def __cached(self, stream: str) -> str:
        if not self.__cached_output:
            raise RuntimeError(f"the {stream} of a process is only kept with cached_output=True")
        return self.__written[stream].decode(errors="replace")

    def __ending(self) -> Shutdown | None:
        """Return the action that ends the run where `on_exit` is nothing else."""
        if self.__on_exit is None:
            return None
        from orchestra.compat.launch.actions.shutdown_action import Shutdown  # noqa: PLC0415 - as above

        entities = self.__on_exit if isinstance(self.__on_exit, list | tuple) else [self.__on_exit]
        if len(entities) != 1 or not isinstance(entities[0], Shutdown):
            return None
        ending = entities[0]
        return ending if ending.condition is None and type(ending).visit is Action.visit else None

    def __timeout(self, name: str) -> list[Substitution]:
        value = self.__timeouts[name]
        return normalized(LaunchConfiguration(name, default="5") if value is None else written(value))


def _checked_exit(done: Any) -> Any:
    """Return what is to be done at the end. Raises `TypeError` for what can be seen to be no action."""
    if isinstance(done, type):
        told_so = f"on_exit is actions or a function, this is {told(done)}: brackets make an object"
        raise WrongType(told_so, done)
    if isinstance(done, str | list | tuple):
        entities_of(done)
    return done


def _delay(delay: Sub | float | None) -> Sub | float | None:
    """Return a delay: upstream does not wait for one below zero."""
    return max(delay, 0) if isinstance(delay, int | float) else delay
