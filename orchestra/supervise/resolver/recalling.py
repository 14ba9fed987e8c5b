"""A document that was handed over in an earlier run, in the place of a resolver."""

from __future__ import annotations

import sys

TYPE_CHECKING = False  # `typing` costs more than this module, which the keeper carries
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import BinaryIO, Protocol, TypeAlias

    from orchestra.supervise.resolver.document import Document
    from orchestra.supervise.resolver.process import Prepare

    class Recalled(Protocol):
        """What an earlier `prepare` has written to the stream, and what it has told on standard error."""

        @property
        def document(self) -> bytes:
            """The document."""

        @property
        def told(self) -> str:
            """The text."""

    Recall: TypeAlias = Callable[[], Recalled | None]


def recalled(recall: Recall | None, prepare: Prepare) -> tuple[Document | None, Prepare]:
    """Return the document of an earlier run, else what prepares one.

    Where something is to be told, that is left to the resolver, because standard error may be stuck.
    """
    found = recall() if recall else None
    if found is None:
        return None, prepare
    document, told = found.document, found.told
    from orchestra.supervise.resolver.document import loads  # noqa: PLC0415 - only the supervisor needs it, from here on

    try:
        read = loads(document)
    except ValueError:  # of a version that this one cannot read
        return None, prepare

    def again(stream: BinaryIO) -> int:
        sys.stderr.write(told)
        stream.write(document)
        return 0

    return (None, again) if told else (read, prepare)
