"""A process that waits for many is judged by those that have changed as if all had been looked at."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from hypothesis import given
from hypothesis import strategies as st

from orchestra.plan.conditions import Dependency
from orchestra.supervise.process import life, order
from orchestra.supervise.process.beginning import Beginning
from orchestra.supervise.process.ending import Ending
from orchestra.supervise.process.life import Phase, State
from orchestra.supervise.process.rules import rules_of
from tests.supervise.plans import HERE, process

if TYPE_CHECKING:
    import pytest

    from orchestra.plan.model import Process
    from orchestra.values import Condition

_STATES = (
    State(),
    State(Phase.RUNNING, starts=1),
    State(Phase.READY, starts=1, been_ready=True),
    State(Phase.EXITED, starts=1, ending=Ending(code=0)),
    State(Phase.FAILED, starts=1, ending=Ending(code=1)),
    State(Phase.EXITED, starts=1, ending=Ending(code=0), halted=True),
)
_CONDITIONS: tuple[Condition, ...] = ("started", "ready", "completed", "exited")
_EDGES = st.lists(
    st.tuples(st.integers(0, 4), st.sampled_from(_CONDITIONS), st.booleans()), min_size=1, max_size=8
)
_CHANGES = st.lists(st.lists(st.tuples(st.integers(0, 4), st.sampled_from(_STATES)), max_size=4), max_size=8)


class _Unit:
    """A process whose phase somebody else decides upon."""

    def __init__(self, described: Process) -> None:
        self.process, self.id, self.name = described, described.id, described.id
        self.state = State(Phase.RUNNING)
        self.rules = rules_of(described)

    @property
    def standing(self) -> order.Life:
        return order.Life(self.rules, self.state)

    def handle(self, event: life.Event) -> None:
        self.state = State(Phase.SKIPPED if isinstance(event, life.Skip) else Phase.STARTING)


class _Around:
    """Whatever else a beginning asks for: nothing comes of it."""

    def __getattr__(self, name: str) -> Any:
        return self

    def __call__(self, *_: object, **__: object) -> None:
        pass


def _begun(units: dict[str, _Unit]) -> Beginning:
    around = cast("Any", _Around())
    beginning = Beginning(cast("Any", units), around, around)
    beginning.add(unit.process for unit in units.values())
    return beginning


@given(_EDGES, _CHANGES)
def test_it_begins_and_is_skipped_when_all_that_it_waits_for_says_so(
    edges: list[tuple[int, Condition, bool]], changes: list[list[tuple[int, State]]]
) -> None:
    awaited = tuple(
        Dependency(f"p{target}", condition, None, HERE, required=required)
        for target, condition, required in edges
    )
    described = [*(process(f"p{number}") for number in range(5)), process("z", depends_on=awaited)]
    units = {one.id: _Unit(one) for one in described}
    for unit in units.values():
        unit.state = State()
    beginning, waiting = _begun(units), units["z"]
    for number in range(5):
        units[f"p{number}"].state = State(Phase.STARTING)
    for together in changes:
        for number, state in together:
            units[f"p{number}"].state = state
            beginning.changed(f"p{number}")
        fate = order.fate(awaited, {one: unit.standing for one, unit in units.items()})
        beginning.begin_or_skip()
        wanted = Phase.SKIPPED if fate.blocker else Phase.STARTING if fate.begin else Phase.WAITING
        assert waiting.state.phase is wanted
        if wanted is not Phase.WAITING:
            return


def test_of_what_is_waited_for_that_is_looked_at_which_has_changed(monkeypatch: pytest.MonkeyPatch) -> None:
    looks, reached = list[str](), order.reached

    def counted(condition: Condition, life_of_it: order.Life) -> bool | None:
        looks.append(condition)
        return reached(condition, life_of_it)

    monkeypatch.setattr(order, "reached", counted)
    names = [f"p{number}" for number in range(100)]
    awaited = tuple(Dependency(name, "completed", None, HERE) for name in names)
    units = {one.id: _Unit(one) for one in [*map(process, names), process("z", depends_on=awaited)]}
    units["z"].state = State()
    beginning = _begun(units)
    for name in names:
        beginning.begin_or_skip()
        assert units["z"].state.phase is Phase.WAITING
        units[name].state = State(Phase.EXITED, starts=1, ending=Ending(code=0))
        beginning.changed(name)
    beginning.begin_or_skip()
    assert units["z"].state.phase is Phase.STARTING
    assert len(looks) == 2 * len(names)
