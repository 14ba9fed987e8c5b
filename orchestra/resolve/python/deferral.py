"""What only code of the description knows at run time: kept with the scope in which it stands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from orchestra.dataclass import dataclass
from orchestra.fields import fields, replace
from orchestra.location import Location
from orchestra.resolve.context import Context
from orchestra.resolve.ledger import Ledger
from orchestra.resolve.reactions import ResolvedDeferred
from orchestra.resolve.resolution import Frame
from orchestra.resolve.scope import Scope

if TYPE_CHECKING:
    from orchestra.resolve.resolution import Resolution


@dataclass(frozen=True, slots=True)
class Deferred:
    """Code to call.

    `handler`: `callback(event, context)` of an event handler, `target`, which also says whether it wants the event.
    `entity`: a Python entity to visit. `action`: an action that is described, to visit. `event`: an event to emit.
    """

    kind: Literal["handler", "entity", "action", "event"]
    target: Any
    callback: Any = None


@dataclass(frozen=True, slots=True)
class Kept:
    """Deferred code, and where it stands: what it sets later is not seen where it came from."""

    deferred: Deferred
    location: Location
    scope: Scope
    context: Context
    frames: tuple[Frame, ...]


def put_off(deferred: Deferred, location: Location, run: Resolution) -> None:
    """Let code be asked in its turn among what is done when something happens."""
    if run.occasion is not None:
        run.occasion.do.append(ResolvedDeferred(defer(deferred, location, run), location))


def defer(deferred: Deferred, location: Location, run: Resolution) -> int:
    """Keep code for later; return the number under which it is kept."""
    scope = copied(run.scope)
    context = replace(
        run.context, variables=scope, environment=scope.environment, parameters=scope.parameter_texts
    )
    run.found.kept.append(Kept(deferred, location, scope, context, run.frames))
    return len(run.found.kept) - 1


def copied(scope: Scope) -> Scope:
    """Return a scope that is changed without the other, and whose reads and writes are nobody else's."""
    import copy  # noqa: PLC0415 - few launches put something off, and it imports more

    other = copy.copy(scope)
    for entry in fields(scope):
        value = getattr(scope, entry.name)
        if isinstance(value, dict | list):
            setattr(other, entry.name, copy.copy(value))
    other.ledger = Ledger()
    return other
