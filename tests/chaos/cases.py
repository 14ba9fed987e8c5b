"""What a chaos run is made of, as data that goes through JSON and back: families of processes, and what befalls them."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, fields
from typing import Any, Literal, TypeAlias

# How a member comes about: forked; as a program; in a session of its own; forked twice; that and a session; all of it
# and a new program without any environment.
Manner: TypeAlias = Literal["fork", "program", "session", "orphan", "daemon", "bare"]
Door: TypeAlias = Literal["document", "launch file"]
Screen: TypeAlias = Literal["file", "full pipe", "closed pipe", "terminal", "blocked terminal"]
Target: TypeAlias = Literal["keeper", "supervisor", "resolver", "observer", "both", "member"]
Deed: TypeAlias = Literal[
    "signal",
    "type",
    "hang up",
    "fill disk",
    "free disk",
    "remove logs",
    "hammer",
    "order",
    "wait for all",
    "pass time",
]

MANNERS: tuple[Manner, ...] = ("fork", "program", "session", "orphan", "daemon", "bare")


@dataclass(frozen=True, slots=True)
class Member:
    """A process below another; `tests/processes/tree.py` is it.

    `ignores` names signals without SIG. It may close its outputs, stop itself (SIGSTOP), or fork `storm` others at
    once. It writes `lines` numbered lines at the start, or goes on writing where it `floods`; None for nothing that is
    counted. `polite`: asked by SIGINT or SIGTERM it finishes its output and ends with `code`; so does everybody `after`
    so many seconds. `slow` is how long it takes until it says anything.
    """

    name: str
    manner: Manner = "fork"
    ignores: tuple[str, ...] = ()
    closes: bool = False
    stops: bool = False
    storm: int = 0
    lines: int | None = None
    floods: bool = False
    polite: bool = False
    after: float | None = None
    code: int = 0
    slow: float = 0.0
    members: tuple[Member, ...] = ()


@dataclass(frozen=True, slots=True)
class Root:
    """A process of the plan, and what the plan says about it.

    `stop` is the two times of the stop ladder. `capped`: it has a memory cap. `stdin`: it has the user's terminal.
    """

    member: Member
    respawn: bool = False
    required: bool = False
    needs: tuple[str, ...] = ()
    needs_ready: bool = False
    ready: bool = False
    never_ready: bool = False
    tty: bool = False
    capped: bool = False
    stdin: bool = False
    stop: tuple[float, float] | None = None


@dataclass(frozen=True, slots=True)
class Act:
    """Something that befalls the run, `delay` seconds after what befell it before.

    `signal` is sent to `target` (a name without SIG), typed (`^C`, `^Z`, `^\\` by the signals that they make), or of no
    meaning. `chosen` picks the member, of those that are there, or the process of the plan that a client of the control
    socket gives an `order` about: start, stop, restart, or down, which is about all.
    """

    deed: Deed
    delay: float = 0.0
    target: Target = "keeper"
    signal: str = ""
    order: str = ""
    chosen: float = 0.0


@dataclass(frozen=True, slots=True)
class Case:
    """One run. `disk` is the size of the file system of the run's files in KiB, None for as much as there is.

    `leaps`: the wall clock of keeper and supervisor jumps.
    """

    seed: str
    roots: tuple[Root, ...]
    acts: tuple[Act, ...]
    door: Door = "document"
    screen: Screen = "file"
    disk: int | None = None
    leaps: bool = False


def dumps(case: Case) -> str:
    """Return the case as JSON, without what is as usual."""
    return json.dumps(_sparse(asdict(case)))


def loads(text: str) -> Case:
    """Read a case that `dumps` wrote."""
    data = json.loads(text)
    roots = tuple(_root(root) for root in data.pop("roots"))
    acts = tuple(Act(**act) for act in data.pop("acts", ()))
    return Case(roots=roots, acts=acts, **data)


def member_words(member: Member) -> str:
    """Return the description of a member for `tree.py`."""
    return json.dumps(_sparse(asdict(member)))


def everyone(members: tuple[Member, ...]) -> list[Member]:
    """Return members and all below them."""
    return [found for member in members for found in (member, *everyone(member.members))]


def _root(data: dict[str, Any]) -> Root:
    lists = {name: tuple(data[name]) for name in ("needs", "stop") if data.get(name) is not None}
    return Root(**{**data, **lists, "member": _member(data["member"])})


def _member(data: dict[str, Any]) -> Member:
    below = tuple(_member(member) for member in data.get("members", ()))
    return Member(**{**data, "ignores": tuple(data.get("ignores", ())), "members": below})


_USUAL: dict[str, Any] = {
    field.name: field.default for kind in (Member, Root, Act, Case) for field in fields(kind)
}


def _sparse(value: Any) -> Any:
    """Leave out what has the value that it has anyway: nothing, or the usual manner, door, screen and target."""
    if isinstance(value, dict):
        return {key: _sparse(each) for key, each in value.items() if not _is_usual(key, each)}
    if isinstance(value, list | tuple):
        return [_sparse(each) for each in value]
    return value


def _is_usual(key: str, value: Any) -> bool:
    if key in ("acts", "roots"):
        return False
    return bool(value == _USUAL[key]) and type(value) is type(_USUAL[key])
