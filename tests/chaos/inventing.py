"""Invents runs at random: the same seed gives the same run."""

from __future__ import annotations

from dataclasses import replace
from random import Random
from typing import TYPE_CHECKING, NamedTuple

from tests.chaos.cases import MANNERS, Act, Case, Member, Root

if TYPE_CHECKING:
    from tests.chaos.cases import Door, Screen

_IGNORED = ((), (), ("INT",), ("INT", "TERM"), ("INT", "TERM", "HUP"), ("HUP",))
_STOP_SIGNALS = ("INT", "TERM", "HUP")
_STORM = 50


class Abilities(NamedTuple):
    """What the machine allows: file systems that nobody else sees, memory caps."""

    private: bool
    caps: bool


_EVERYTHING = Abilities(private=True, caps=True)


def case(seed: str, here: Abilities = _EVERYTHING) -> Case:
    """Return the case of a seed, which asks for no more than is possible here."""
    chance = Random(seed)  # noqa: S311 - that is the purpose
    roots = _roots(chance)
    door: Door = "launch file" if chance.random() < 0.4 else "document"
    screen: Screen = chance.choices(
        ("file", "full pipe", "closed pipe", "terminal", "blocked terminal"), (4, 1, 1, 3, 2)
    )[0]
    disk = chance.choice((64, 300)) if here.private and chance.random() < 0.2 else None
    leaps = door == "document" and chance.random() < 0.15
    acts = _acts(chance, screen, disk)
    if screen in ("terminal", "blocked terminal") and chance.random() < 0.3:
        roots = _with(roots, chance.randrange(len(roots)), stdin=True, tty=False)
    if here.caps and chance.random() < 0.2:
        roots = _with(roots, chance.randrange(len(roots)), capped=True)
    return Case(seed, roots, acts, door, screen, disk, leaps)


def _with(roots: tuple[Root, ...], number: int, **changes: bool) -> tuple[Root, ...]:
    return (*roots[:number], replace(roots[number], **changes), *roots[number + 1 :])  # type: ignore[arg-type]


def _roots(chance: Random) -> tuple[Root, ...]:
    count = chance.choice((1, 1, 2, 3, 4, 6))
    stormy = chance.randrange(count) if chance.random() < 0.15 else None
    roots: list[Root] = []
    for number in range(count):
        name = f"p{number}"
        storm = _STORM if number == stormy else 0
        roots.append(_root(chance, name, roots, storm))
    return tuple(roots)


def _root(chance: Random, name: str, earlier: list[Root], storm: int) -> Root:
    kind = chance.choices(("polite", "plain", "crashing", "ending"), (5, 4, 2, 1))[0]
    flaw = {
        "polite": {
            "polite": True,
            "lines": chance.choice((0, 1, 500, 5000)),
            "floods": chance.random() < 0.15,
        },
        "plain": {"ignores": chance.choice(_IGNORED), "closes": chance.random() < 0.15},
        "crashing": {"after": chance.choice((0.0, 0.0, 0.3)), "code": chance.choice((3, 5, 77)), "lines": 3},
        "ending": {"after": chance.choice((0.1, 1.0)), "lines": 20},
    }[kind]
    member = Member(
        name,
        members=_members(chance, name, 0),
        slow=chance.choice((0.0, 0.0, 0.0, 1.0)),
        stops=kind == "plain" and chance.random() < 0.15,
        storm=storm,
        **flaw,  # type: ignore[arg-type]
    )
    needed = chance.choice(earlier) if earlier and chance.random() < 0.3 else None
    return Root(
        member,
        respawn=kind == "crashing" and chance.random() < 0.7,
        required=chance.random() < 0.15,
        needs=(needed.member.name,) if needed else (),
        needs_ready=needed is not None and needed.ready and chance.random() < 0.7,
        ready=chance.random() < 0.3 and not member.closes,
        never_ready=chance.random() < 0.03,
        tty=chance.random() < 0.25,
        stop=(0.3, 0.3) if chance.random() < 0.5 else None,
    )


def _members(chance: Random, name: str, depth: int) -> tuple[Member, ...]:
    count = chance.choices((0, 1, 2, 3), (5, 3, 2, 1))[0] if depth < 3 else 0
    return tuple(_member(chance, f"{name}.{number}", depth) for number in range(count))


def _member(chance: Random, name: str, depth: int) -> Member:
    return Member(
        name,
        chance.choice(MANNERS),
        chance.choice(_IGNORED),
        closes=chance.random() < 0.15,
        stops=chance.random() < 0.1,
        after=chance.choice((0.1, 0.5)) if chance.random() < 0.2 else None,
        members=_members(chance, name, depth + 1),
    )


def _acts(chance: Random, screen: Screen, disk: int | None) -> tuple[Act, ...]:
    begin = (
        [Act("wait for all")]
        if chance.random() < 0.7
        else [Act("pass time", chosen=round(chance.uniform(0, 1.2), 2))]
    )
    between = [_annoyance(chance, disk) for _ in range(chance.choice((0, 0, 1, 1, 2, 3)))]
    return (*begin, *between, *_end(chance, screen))


def _annoyance(chance: Random, disk: int | None) -> Act:
    delay = round(chance.choice((0.0, chance.uniform(0, 0.6))), 2)
    common = [
        Act(
            "signal",
            delay,
            "member",
            chance.choice(("KILL", "STOP", "SEGV", "TERM", "CONT")),
            chosen=chance.random(),
        ),
        Act("signal", delay, "member", "KILL", chosen=chance.random()),
        Act("signal", delay, chance.choice(("keeper", "supervisor")), "QUIT"),
        Act("signal", delay, "keeper", "TSTP"),
        Act("signal", delay, "keeper", "CONT"),
        Act("signal", delay, chance.choice(("keeper", "supervisor")), "STOP"),
        Act("signal", delay, chance.choice(("keeper", "supervisor")), "CONT"),
        Act("signal", delay, "observer", chance.choice(("KILL", "STOP", "TERM"))),
        Act("hammer", delay),
        Act(
            "order",
            delay,
            order=chance.choice(("start", "stop", "restart", "restart")),
            chosen=chance.random(),
        ),
    ]
    rare = [Act("remove logs", delay)]
    full = [Act("fill disk", delay), Act("fill disk", delay), Act("free disk", delay)] if disk else []
    return chance.choice([*common, *common, *rare, *full, *full, *full])


def _end(chance: Random, screen: Screen) -> tuple[Act, ...]:
    """Return what ends the run for sure: whoever still sleeps is woken."""
    delay = round(chance.choice((0.0, chance.uniform(0, 0.8))), 2)
    # Twice: what is suspended by its own hand may not have come to it yet (SIGTSTP).
    wake = (
        *(Act("signal", wait, "keeper", "CONT") for wait in (delay, 0.2)),
        Act("signal", 0.0, "supervisor", "CONT"),
    )
    ends = [
        (
            Act("signal", 0.0, "supervisor", "STOP"),
            Act("signal", 0.3, "keeper", chance.choice(_STOP_SIGNALS)),
        ),
        (Act("order", order="down"), Act("signal", 3.0, "keeper", "TERM")),
        (Act("signal", 0.0, "keeper", chance.choice(_STOP_SIGNALS)),),
        (Act("signal", 0.0, "supervisor", chance.choice(_STOP_SIGNALS)),),
        (Act("signal", 0.0, "keeper", "KILL"),),
        (Act("signal", 0.0, "supervisor", "KILL"),),
        tuple(Act("signal", round(chance.uniform(0.0, 0.4), 2), "keeper", "INT") for _ in range(3)),
        (
            Act("signal", 0.0, "keeper", "INT"),
            Act("signal", round(chance.uniform(0.0, 0.5), 2), "keeper", "KILL"),
        ),
        (
            Act("signal", 0.0, "keeper", "INT"),
            Act("signal", round(chance.uniform(0.0, 0.5), 2), "supervisor", "KILL"),
        ),
        (
            Act("signal", 0.0, "resolver", chance.choice((*_STOP_SIGNALS, "KILL"))),
            Act("signal", 0.5, "keeper", "TERM"),
        ),
    ]
    if screen in ("terminal", "blocked terminal"):
        ends += [
            (Act("hang up"),),
            (Act("type", signal="INT"),),
            (Act("type", signal="INT"), Act("hang up", 0.1)),
        ]
    return (*wake, *chance.choice(ends))
