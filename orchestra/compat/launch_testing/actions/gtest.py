"""`GTest`: a program made with GoogleTest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch_testing.actions.test import Test

if TYPE_CHECKING:
    from orchestra.compat.text import Sub


class GTest(Test):
    """Run the program at a path."""

    def __init__(self, *, path: Sub, **kwargs: Any) -> None:
        super().__init__(cmd=[path], **kwargs)
        self.__path = path

    @property
    def path(self) -> Sub:
        """The program."""
        return self.__path
