"""What code of launch files leaves in circles: a module and its functions, an action and what it has come to."""

from __future__ import annotations

import gc
import sys
from typing import Final

_MANY: Final = (
    16  # files, of some 30 kB each: to fetch new memory instead takes longer than to look for garbage
)


class Garbage:
    """Counts files whose code has run in a process whose collector is off, and collects what they leave."""

    def __init__(self) -> None:
        self._files = 0
        self._modules = len(sys.modules)

    def left_by(self, *, code: bool) -> None:
        """Take note of a file that has been looked at; `code` tells whether it has any that has run."""
        if len(sys.modules) > self._modules:
            self._modules = len(sys.modules)
            gc.freeze()  # what has been imported stays, and is far more than files leave: nobody walks through it
        self._files += code
        if self._files >= _MANY:
            self._files = 0
            gc.collect(0)  # what has been made since the last time
