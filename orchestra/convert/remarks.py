"""What is told about a conversion: what cannot be said in the other language, and what comes out differently."""

from __future__ import annotations

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.location import Span


@dataclass(frozen=True, slots=True)
class Remark:
    """One sentence about a place of the file; `lost` where something of it is not in the result."""

    message: str
    span: Span
    lost: bool


@dataclass(slots=True)
class Remarks:
    """Collects them, the same one at a place once."""

    found: list[Remark] = field(default_factory=list)

    def lose(self, message: str, span: Span) -> None:
        """Tell that something cannot be converted."""
        self._tell(Remark(message, span, lost=True))

    def warn(self, message: str, span: Span) -> None:
        """Tell that something comes out as it is here and now, or a little different."""
        self._tell(Remark(message, span, lost=False))

    @property
    def lossy(self) -> bool:
        """Whether something of the file is not in the result."""
        return any(remark.lost for remark in self.found)

    @property
    def ordered(self) -> tuple[Remark, ...]:
        """All of them in the order of their places."""
        return tuple(sorted(self.found, key=_place))

    def _tell(self, remark: Remark) -> None:
        if remark not in self.found:
            self.found.append(remark)


def _place(remark: Remark) -> tuple[str, int, int, str]:
    return (remark.span.file, remark.span.line, remark.span.column, remark.message)


class UnsayableError(Exception):
    """Something that the other language has no words for: the message says why, the span where it stands."""

    def __init__(self, message: str, span: Span) -> None:
        super().__init__(message)
        self.message = message
        self.span = span
