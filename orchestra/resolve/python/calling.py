"""The boundary of user code: `os.environ` is that of the scope meanwhile, and what is raised becomes a problem."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.refusing import collecting
from orchestra.location import Location
from orchestra.resolve.python.environ import environment_now, put_environment
from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.location import Span
    from orchestra.resolve.resolution import Resolution

_END: Final = object()


@contextmanager
def user_code(run: Resolution, span: Span) -> Iterator[None]:
    """Run code of a launch file, which `span` led to. What it raises is reported and does not get out."""
    put_environment(run.scope.environment)
    try:
        with collecting(run.problems, run.context.included_from):
            yield
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # the boundary of user code
        if isinstance(error, RecursionError) and run.is_deep:
            raise
        from orchestra.compat import faults  # noqa: PLC0415 - few raise anything

        faults.report(error, run.problems, run.context.included_from, span)
        run.scope.ledger.incomplete = True
    finally:
        take_environment(run, span)


def stepped(items: Iterable[Any] | None, run: Resolution, span: Span) -> Iterator[Any] | None:
    """Return what code of a launch file yields: it runs on when the next item is asked for, as user code does."""
    return None if items is None else _steps(items, run, span)


def _steps(items: Iterable[Any], run: Resolution, span: Span) -> Iterator[Any]:
    left: Iterator[Any] | None = None
    while True:
        item: Any = _END
        with user_code(run, span):
            left = iter(items) if left is None else left
            item = next(left, _END)
        if item is _END:
            return
        yield item


@contextmanager
def our_code(run: Resolution, span: Span) -> Iterator[None]:
    """Run code of ours that user code has called: it sees what that has done to the environment so far."""
    take_environment(run, span)
    try:
        yield
    finally:
        put_environment(run.scope.environment)


def take_environment(run: Resolution, span: Span) -> None:
    """Make what user code has done to the environment of this process part of the scope."""
    environment, now = run.scope.environment, environment_now()
    with observer().aside():
        if dict.__eq__(now, environment) is True:  # not `==`, as in `put_environment`
            return
        location = Location(span, run.context.included_from)
        for name in environment.keys() - now.keys():
            run.scope.change(name, None, location)
        for name, value in now.items():
            if environment.get(name) != value:
                run.scope.change(name, value, location)
