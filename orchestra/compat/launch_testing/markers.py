"""Marks of tests and of their descriptions."""

from __future__ import annotations

import functools
import inspect
import time
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch_testing.util.keep_alive_process import KeepAliveProc
from orchestra.compat.place import Place

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


def keep_alive(test_description: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that adds a process which does nothing to the description that another one returns.

    So do those that it yields where there is one per value.
    """
    if getattr(test_description, "__parametrized__", False):

        @functools.wraps(test_description)
        def each() -> Iterator[tuple[Callable[..., Any], dict[str, Any]]]:
            for function, arguments in test_description():
                yield keep_alive(function), arguments

        return each

    @functools.wraps(test_description)
    def described(*args: Any, **kwargs: Any) -> Any:
        found = test_description(*args, **kwargs)
        description = found[0] if isinstance(found, tuple) else found
        process = KeepAliveProc()
        code = getattr(inspect.unwrap(test_description), "__code__", None)
        process._place = process._place if code is None else Place(code, 0)
        description.add_action(process)
        return found

    return described


def retry_on_failure(
    *, times: int, delay: float | None = None
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator for a test that is tried so often, with `delay` seconds between, until it passes."""
    if times <= 0:
        raise ValueError("a test is tried at least once")

    def decorate(test: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(test)
        def tried(*args: Any, **kwargs: Any) -> Any:
            for _ in range(times - 1):
                try:
                    return test(*args, **kwargs)
                except AssertionError:
                    time.sleep(delay or 0.0)
            return test(*args, **kwargs)

        return tried

    return decorate
