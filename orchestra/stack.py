"""Room for the frames of Python functions, so that no call has to ask the system for memory.

The interpreter (CPython since 3.11) keeps frames in chunks of 16 KiB. A call that does not fit into the last one maps
another, which is unmapped when it returns: where that is in the middle of a loop, each round takes two system calls and
a page fault, 7.5 µs where a call takes 0.04. It is by the depth of the stack that it happens, so any change anywhere
brings it about or removes it; `orchestra plan` of one node was found to map 1,567 chunks, a tenth of its time.

A frame that needs more than a chunk has gets one of twice its size, of which the other half is left to all that it
calls. Memory that nobody touches costs nothing.
"""

from __future__ import annotations

TYPE_CHECKING = False  # `typing` itself costs more than this module
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TypeVar

    _CalledT = TypeVar("_CalledT", bound=Callable[..., object])

# Half a MiB, in words. The limit of recursion is at about 300 KiB of frames.
_WORDS = 1 << 16


def roomy(function: _CalledT) -> _CalledT:
    """Let all that a function calls, however deep, have its frames in one piece of memory.

    It is for what a process or a thread does, not for what is called often, and for no generator or coroutine, whose
    frames are elsewhere.
    """
    changed = function.__code__
    function.__code__ = changed.replace(co_stacksize=_WORDS)
    return function
