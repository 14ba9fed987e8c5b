"""`expose_action` and `expose_substitution`: how third parties add to the language of XML and YAML files."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any, TypeVar

from orchestra.compat.launch.frontend.calls import CALLS
from orchestra.compat.launch.frontend.tags import TAGS
from orchestra.compat.seam import connection

if TYPE_CHECKING:
    from collections.abc import Callable, Container

_ExposedT = TypeVar("_ExposedT")


def expose_action(name: str) -> Callable[[_ExposedT], _ExposedT]:
    """Return a decorator for a class with a classmethod `parse(entity, parser)`, or for such a function.

    It returns the class of an action and its keywords. Raises `RuntimeError` where the name is taken.
    """
    return _exposing(name, connection().front_end.exposures.actions, "action", TAGS)


def expose_substitution(name: str) -> Callable[[_ExposedT], _ExposedT]:
    """Return a decorator for a class with a classmethod `parse(arguments)`, or for such a function.

    The arguments are lists of substitutions; it returns the class of a substitution and its keywords. Raises
    `RuntimeError` where the name is taken.
    """
    return _exposing(name, connection().front_end.exposures.substitutions, "substitution", CALLS)


def __expose_impl(name: str, register: dict[str, Callable[..., Any]], exposed_type: str) -> Any:
    """Return a decorator that exposes to a register."""
    return _exposing(name, register, exposed_type, ())


def _exposing(
    name: str, register: dict[str, Callable[..., Any]], kind: str, taken: Container[str]
) -> Callable[[_ExposedT], _ExposedT]:
    def expose(exposed: _ExposedT) -> _ExposedT:
        method = _method(exposed, name, kind)
        known = register.get(name)
        if name in taken or (known is not None and not _same(known, method)):
            raise RuntimeError(f"two different {kind}s are exposed as '{name}'")
        register[name] = method
        return exposed

    return expose


def _method(exposed: Any, name: str, kind: str) -> Callable[..., Any]:
    method: Any = getattr(exposed, "parse", None) if inspect.isclass(exposed) else exposed
    if not callable(method):
        raise RuntimeError(  # noqa: TRY004 - as upstream
            f"Exposed {kind} parser for {name} is not a callable or a class containing a parse method"
        )
    return method  # type: ignore[no-any-return]  # callable, which is all that is known


def _same(one: Callable[..., Any], other: Callable[..., Any]) -> bool:
    """Return whether two parse methods are the same, as they are when a module is imported twice."""
    return one == other or (_name(one) == _name(other) and _source(one) == _source(other))


def _name(method: Callable[..., Any]) -> tuple[Any, Any]:
    return getattr(method, "__module__", None), getattr(method, "__qualname__", None)


def _source(method: Callable[..., Any]) -> Any:
    code = getattr(inspect.unwrap(method), "__code__", None)
    return code and (code.co_filename, code.co_firstlineno)
