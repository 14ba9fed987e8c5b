"""A piece of output, and what is found out about it once for all who write it somewhere."""

from __future__ import annotations

from orchestra.dataclass import dataclass
from orchestra.logs.terminal_text import harmless, plain


@dataclass(frozen=True, slots=True)
class Block:
    """`data` as it was written, `bare` the same without colours.

    Where it is `clean`, all of `bare` is text, and only ends of lines and tabs in it mean anything to a terminal.
    """

    data: bytes
    bare: bytes
    clean: bool


def block_of(data: bytes) -> Block:
    """Return a piece of output as a block."""
    bare = plain(data)
    return Block(data, bare, harmless(bare))
