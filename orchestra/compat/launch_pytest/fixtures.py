"""`launch_pytest.fixture`: marks the function that returns a launch description."""

from __future__ import annotations

from typing import Any


def fixture(decorated: Any = None, *args: Any, **kwargs: Any) -> Any:
    """Return the function as it is: a launch description is all that is wanted of it here."""
    if callable(decorated):
        return decorated
    del args, kwargs  # the scope of the fixture and the end of the launch matter to tests that run
    return lambda function: function
