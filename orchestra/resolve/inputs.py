"""What the caller hands to a resolution besides the description."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.location import Span

if TYPE_CHECKING:
    from orchestra.resolve.weights import Weights

ASSIGNED: Final = ":="


@dataclass(frozen=True, slots=True)
class GivenArgument:
    """A launch argument `name:=value`; the span is in the pseudo-file `command line`."""

    name: str
    value: str
    span: Span

    @property
    def value_span(self) -> Span:
        """Where the value stands: behind the name and `:=`."""
        return _behind(self.span, self.value)


@dataclass(frozen=True, slots=True)
class GivenParameter:
    """A parameter `NODE:NAME:=VALUE`; `node` is a full node name or one relative to the root."""

    node: str
    name: str
    value: str
    span: Span

    @property
    def value_span(self) -> Span:
        """Where the value stands: behind the name and `:=`."""
        return _behind(self.span, self.value)


@dataclass(frozen=True, slots=True)
class GivenFile:
    """A parameter file of the command line, for every node."""

    path: str
    span: Span


@dataclass(frozen=True, slots=True)
class Inputs:
    """The command line and the environment of one resolution.

    `launching` tells that processes will be started here. Without `planning` nothing is made of what is found. By
    that it is `weights` how much it counts that something is not here. `required` tells whether a required argument
    without a value is told at all. `noninteractive` is what code of launch files is told: whether no terminal is
    assumed. With `debug` what that code raises is told with all calls. `severity` says for codes how much they
    weigh, over what settings files say. `keeping` lets what is worked out on the way be kept for later plans.
    """

    environment: Mapping[str, str]
    arguments: tuple[GivenArgument, ...] = ()
    parameters: tuple[GivenParameter, ...] = ()
    parameter_files: tuple[GivenFile, ...] = ()
    launching: bool = True
    planning: bool = True
    required: bool = True
    noninteractive: bool = True
    debug: bool = False
    severity: Mapping[str, str] = field(default_factory=dict)
    keeping: bool = True

    @property
    def weights(self) -> Weights:
        """How much it weighs that this machine lacks what another one may have."""
        # Here, because most files lack nothing.
        from orchestra.resolve.weights import Weights  # noqa: PLC0415

        return Weights(self.environment, self.launching, self.planning, bool(self.arguments))


def _behind(name: Span, value: str) -> Span:
    begin = name.end_column + len(ASSIGNED)
    return Span(name.file, name.line, begin, name.line, begin + len(value))
