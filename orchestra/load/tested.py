"""Files that test a launch: their `generate_test_description` stands for `generate_launch_description`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from types import ModuleType

FUNCTION: Final = "generate_test_description"
_READY: Final = "ready_fn"  # what such functions took before there was `ReadyToTest`


def description_in(module: ModuleType) -> Any:  # noqa: ANN401 - whatever the user's function returns
    """Return the description of a file's tests, the first where there is one per value; None without a function."""
    generate: Any = getattr(module, FUNCTION, None)
    if generate is None:
        return None
    import inspect  # noqa: PLC0415 - few launch files are tests, and it takes time

    if getattr(generate, "__parametrized__", False):
        generate = next(iter(generate()))[0]
    arguments = [lambda: None] if _READY in inspect.signature(generate).parameters else []
    made = generate(*arguments)
    return made[0] if isinstance(made, tuple) and made else made
