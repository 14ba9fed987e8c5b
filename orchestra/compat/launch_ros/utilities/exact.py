"""A value that has its type already, among substitutions: it is performed as YAML that reads back as the same value."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch.substitution import Substitution

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.values import Scalar


class Exact(Substitution):
    """A scalar."""

    def __init__(self, value: Scalar) -> None:
        self.value = value

    def describe(self) -> str:
        """Return the value as Python writes it."""
        return repr(self.value)

    def perform(self, context: LaunchContext) -> str:  # noqa: ARG002 - there is nothing to look up
        """Return the value in YAML."""
        import yaml  # noqa: PLC0415 - only user code that performs it by hand comes here

        text: str = yaml.safe_dump(self.value, allow_unicode=True)
        return text.removesuffix("\n").removesuffix("\n...")


def builtin(value: Scalar) -> Scalar:
    """Return a scalar without what a subclass has added to it (an enumeration, numpy's floats)."""
    for kind in (bool, int, float, str):
        if isinstance(value, kind):
            return kind(value) if kind is not str else str.__str__(value)
    raise TypeError(f"{value!r} is no scalar")
