"""`PyTest`: tests for pytest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.substitutions.find_executable import FindExecutable
from orchestra.compat.launch_testing.actions.test import Test

if TYPE_CHECKING:
    from orchestra.compat.text import Sub


class PyTest(Test):
    """Run pytest on a path."""

    def __init__(self, *, path: Sub, **kwargs: Any) -> None:
        super().__init__(cmd=[FindExecutable(name="python3"), "-m", "pytest", path], **kwargs)
        self.__path = path

    @property
    def path(self) -> Sub:
        """The tests."""
        return self.__path
