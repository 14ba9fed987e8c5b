"""A check of what a function is given."""

from __future__ import annotations

from collections.abc import Iterable


def ensure_argument_type(
    argument: object, types: type | Iterable[type], argument_name: str, caller: str | None = None
) -> None:
    """Raise `TypeError`, which names the argument and who was called, unless it is of one of the types."""
    if not isinstance(types, type | Iterable):
        raise TypeError(f"ensure_argument_type() takes a type or several as its types, not {types!r}")
    if not isinstance(argument_name, str):
        raise TypeError(f"ensure_argument_type() takes a text as the argument's name, not {argument_name!r}")
    wanted = [types] if isinstance(types, type) else list(types)
    if any(isinstance(argument, kind) for kind in wanted):
        return
    names = " or ".join(getattr(kind, "__name__", str(kind)) for kind in wanted)
    called = "" if caller is None else f"{caller}: "
    raise TypeError(
        f"{called}'{argument_name}' must be {names}, found {type(argument).__name__}: {argument!r}"
    )
