"""What the resolver process of a run does: read the command line, make the plan, hand it over."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.cli.boundary import guarded
from orchestra.cli.main import carry_out

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import BinaryIO


def prepare(words: Sequence[str], stream: BinaryIO) -> int:
    """Write the plan of `launch` or `run` to the stream; return 0, or the status of the error that was shown."""
    return guarded(
        lambda: carry_out(words[0], words[1:], lambda module, options: int(module.prepare(options, stream))),
        command=words[0],
    )
