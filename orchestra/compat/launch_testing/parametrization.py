"""`parametrize`: one description per value."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator


def parametrize(
    argnames: str, argvalues: Iterable[Any]
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator for `generate_test_description`: it yields a function per value, with its arguments.

    `argnames` are separated by commas; a value for several is a tuple.
    """
    names = [name.strip() for name in argnames.split(",") if name.strip()]
    values = [value if isinstance(value, tuple) else (value,) for value in argvalues]

    def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(function)
        def each() -> Iterator[tuple[Callable[..., Any], dict[str, Any]]]:
            for value in values:
                arguments = dict(zip(names, value, strict=False))
                yield functools.update_wrapper(functools.partial(function, **arguments), function), arguments

        each.__parametrized__ = True  # type: ignore[attr-defined]  # the mark itself
        return each

    return decorate
