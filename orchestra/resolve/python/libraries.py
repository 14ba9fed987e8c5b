"""Libraries of Python that have a state of their own stay as they were, or begin anew where code has imported them."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


class Libraries:
    """What the libraries are when this is made; those that are imported later, as they begin."""

    def __init__(self) -> None:
        self._states = {
            name: read(sys.modules[name]) for name, (read, _) in _STATES.items() if name in sys.modules
        }

    @contextmanager
    def kept(self) -> Iterator[None]:
        """Let code use the libraries for a while."""
        try:
            yield
        finally:
            for name, (read, write) in _STATES.items():
                module = sys.modules.get(name)
                if module is not None:
                    write(module, self._states.get(name))
                    if name not in self._states:
                        self._states[name] = read(module)


def _random(module: Any) -> Any:
    return module.getstate()


def _put_random(module: Any, state: Any) -> None:
    module.seed() if state is None else module.setstate(state)


def _socket(module: Any) -> Any:
    return (module.getdefaulttimeout(),)


def _put_socket(module: Any, state: Any) -> None:
    module.setdefaulttimeout(None if state is None else state[0])


def _loops(module: Any) -> Any:
    """Return the policy of event loops and the loop of this thread."""
    policy = module._event_loop_policy
    return policy, getattr(getattr(policy, "_local", None), "_loop", None)


def _put_loops(module: Any, state: Any) -> None:
    policy, loop = state or (None, None)
    if (module._event_loop_policy, _loops(module)[1]) == (policy, loop):
        return
    module._event_loop_policy = policy
    if policy is not None:
        policy.set_event_loop(loop)


def _starting(module: Any) -> Any:
    return (module._default_context._actual_context,)


def _put_starting(module: Any, state: Any) -> None:
    module._default_context._actual_context = None if state is None else state[0]


def _decimal(module: Any) -> Any:
    return module.getcontext().copy()


def _put_decimal(module: Any, state: Any) -> None:
    module.setcontext(module.DefaultContext if state is None else state.copy())  # code may change it


def _logging(module: Any) -> Any:
    """Return what is set for all messages, and for each logger that there is."""
    root = module.root
    named = [item for item in root.manager.loggerDict.values() if isinstance(item, module.Logger)]
    loggers = {logger: _logger(logger) for logger in (root, *named)}
    return (
        root.manager.disable,
        module._loggerClass,
        module._logRecordFactory,
        module.raiseExceptions,
        loggers,
    )


def _logger(logger: Any) -> tuple[Any, ...]:
    return logger.level, logger.propagate, logger.disabled, list(logger.handlers), list(logger.filters)


def _put_logging(module: Any, state: Any) -> None:
    """Put back what was; loggers that are new are as they begin, for libraries may have taken hold of them."""
    root, known = module.root, {} if state is None else state[4]
    root.manager.disable = module.NOTSET if state is None else state[0]
    module._loggerClass = module.Logger if state is None else state[1]
    module._logRecordFactory = module.LogRecord if state is None else state[2]
    module.raiseExceptions = True if state is None else state[3]
    for logger in _logging(module)[4]:
        level = module.WARNING if logger is root else module.NOTSET
        before = known.get(logger, (level, True, False, [], []))
        if _logger(logger) != before:
            logger.setLevel(before[0])
            logger.propagate, logger.disabled = before[1:3]
            logger.handlers, logger.filters = list(before[3]), list(before[4])


_STATES: Final[dict[str, tuple[Callable[[Any], Any], Callable[[Any, Any], None]]]] = {
    "_decimal": (_decimal, _put_decimal),
    "_socket": (_socket, _put_socket),
    "asyncio.events": (_loops, _put_loops),
    "logging": (_logging, _put_logging),
    "multiprocessing.context": (_starting, _put_starting),
    "random": (_random, _put_random),
}
