"""The state of a resolution as Python launch files reach it: `orchestra.compat.seam.Engine`."""

from __future__ import annotations

from collections import OrderedDict
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from orchestra.compat.explanation import told
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.place import here
from orchestra.description.actions.register_event_handler import RegisterEventHandler
from orchestra.description.actions.reset_env import ResetEnv
from orchestra.description.actions.stacks import (
    PopEnvironment,
    PopLaunchConfigurations,
    PushEnvironment,
    PushLaunchConfigurations,
)
from orchestra.errors import Code, Problems
from orchestra.fields import replace
from orchestra.location import Location
from orchestra.resolve.arguments import lacking
from orchestra.resolve.context import Value
from orchestra.resolve.evaluate import evaluate
from orchestra.resolve.model import InlineParameter
from orchestra.resolve.occasions import Registration
from orchestra.resolve.python.calling import our_code, user_code
from orchestra.resolve.python.configurations import Configurations, Environment
from orchestra.resolve.python.emitting import emit, handle_events
from orchestra.resolve.python.failures import failure, unevaluated
from orchestra.resolve.python.loading import load_description
from orchestra.resolve.python.matching import Lookup
from orchestra.resolve.python.visiting import visit_entities

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from orchestra.description.entity import Action
    from orchestra.description.text import Template
    from orchestra.location import Span
    from orchestra.resolve.resolution import Resolution


class ResolvingEngine:
    """Serves one resolution. What is wrong is reported to it, and raised too, since user code cannot go on."""

    def __init__(self, run: Resolution, argv: Sequence[str] = ()) -> None:
        self._run = run
        self._configurations = Configurations(run)
        self._environment = Environment(run)
        self._lookup = Lookup()
        self.happening: list[tuple[Any, Location]] = []
        self._handlers: OrderedDict[int, Any] = OrderedDict()  # by their identities, the newest last
        self.context = LaunchContext(argv=argv, noninteractive=run.inputs.noninteractive, _engine=self)

    @property
    def configurations(self) -> Configurations:
        """The launch configurations of the current scope."""
        return self._configurations

    @property
    def environment(self) -> Environment:
        """The environment of the current scope."""
        return self._environment

    @property
    def current_file(self) -> str | None:
        """The launch file that is being visited."""
        return self._run.context.file

    def evaluate(self, template: Template) -> str:
        """Return what a text comes to. Raises `SubstitutionFailure`, or what else upstream does, with the problems."""
        found = Problems()
        with our_code(self._run, here().span):
            value = evaluate(template, replace(self._run.context, problems=found, elsewhere=set()))
        if isinstance(value, Value):
            self._run.problems.extend(found)
            return value.text
        raise unevaluated(found)

    def carry_out(self, action: Action) -> None:
        """Carry out an action in the current scope. Raises what upstream does where something is wrong with it."""
        with self._refusing():
            self._run.visit((action,), self._run)

    def visit(self, entities: Iterable[Any]) -> None:
        """Visit Python entities. Raises what upstream does where something is wrong with them."""
        with self._refusing():
            visit_entities(entities, self._run)

    def loop(self) -> Any:
        """Return the event loop that runs, else one that keeps for the run what it is given."""
        # Here, because few actions of users ask for it.
        import asyncio  # noqa: PLC0415

        from orchestra.compat.later_loop import LaterLoop  # noqa: PLC0415

        try:
            return asyncio.get_running_loop()
        except RuntimeError:
            return LaterLoop(self.visit)

    def parameters(self) -> Sequence[tuple[str, Any]]:
        """Return what set_parameter put in scope."""
        set_here = self._run.scope.parameters
        return [(item.name, item.value) for item in set_here if isinstance(item, InlineParameter)]

    def load(self, path: str, language: str | None) -> Any:
        """Return the launch description of a file. Raises `RuntimeError`."""
        with our_code(self._run, here().span):
            return load_description(path, language, self._run)

    def push_configurations(self) -> None:
        """Remember the configurations."""
        self._stack(PushLaunchConfigurations)

    def pop_configurations(self) -> None:
        """Take up the configurations remembered last. Raises `RuntimeError`."""
        self._stack(PopLaunchConfigurations)

    def push_environment(self) -> None:
        """Remember the environment."""
        self._stack(PushEnvironment)

    def pop_environment(self) -> None:
        """Take up the environment remembered last. Raises `RuntimeError`."""
        self._stack(PopEnvironment)

    def reset_environment(self) -> None:
        """Take up the environment with which the launch began."""
        self._stack(ResetEnv)

    def register(self, handler: Any, *, first: bool) -> None:
        """Let an event handler wait, before those that wait already or after them."""
        models: tuple[Any, ...] = getattr(
            handler, "_to_models", tuple
        )()  # one that derives from nothing only hears of emitted events
        self.waits(handler)
        self.carry_out(RegisterEventHandler.at(here().span, handlers=models))
        if not first:
            self._handlers.move_to_end(next(reversed(self._handlers)), last=False)

    def waits(self, handler: Any) -> None:
        """Take note that an event handler waits, the newest of all."""
        self._handlers.setdefault(id(handler), handler)

    def unregister(self, handler: Any) -> None:
        """Let an event handler wait no more. Raises `ValueError` where it does not wait."""
        if self._handlers.pop(id(handler), None) is None:
            raise ValueError(f"{told(handler)} is not registered")
        self._run.found.occasions.forget(handler)
        if self._run.occasion is not None:
            location = Location(here().span, self._run.context.included_from)
            self._run.occasion.do.append(Registration(handler, location, armed=False))

    def emit(self, event: Any) -> None:
        """Let an event happen after the visit."""
        emit(event, Location(here().span, self._run.context.included_from), self._run)

    def handle_events(self) -> None:
        """Hand what has happened to the handlers."""
        handle_events(self._run)

    def would_handle(self, event: Any) -> bool:
        """Return whether a handler waits for such an event."""
        return any(handler.matches(event) for handler in reversed(self._handlers.values()))

    def wanting(self, event: Any, span: Span) -> list[Any]:
        """Return the handlers that want an event, the newest first."""
        found: list[Any] = []
        for handler in tuple(reversed(self._handlers.values())):
            with user_code(self._run, span):
                if handler.matches(event):
                    found.append(handler)
        return found

    def accepted(self, predicate: Any) -> tuple[int, ...]:
        """Return the processes that a predicate on actions means."""
        return self._lookup.accepted(predicate, self._run)

    def completed(self, action: Any) -> None:
        """Take note that an action has been executed."""
        self._run.found.carried_out[id(action)] = action

    def _stack(self, action: type[Action]) -> None:
        self.carry_out(action.at(here().span))

    @contextmanager
    def _refusing(self) -> Iterator[None]:
        """Raise where errors come up meanwhile; code that catches them has nothing of what was faulty."""
        run, begun = self._run, len(self._run.found.processes)
        missing = run.scope.ledger.missing
        known = set(missing)
        with our_code(run, here().span), run.reporting_to(Problems()) as found:
            yield
            for name in [name for name in missing if name not in known]:
                found.error(Code.MISSING_ARGUMENT, lacking(name), missing.pop(name))
        error = failure(found.errors)
        if error is None:
            run.problems.extend(found)
            return
        while len(run.found.processes) > begun and run.found.processes[-1].faulty:
            run.found.drop_process()
            if run.occasion is not None:
                run.occasion.do.pop()
        raise error
