"""Whose velocity counts: priorities, time-outs, locks, and clocks that were set back."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bringup.arbiter.choice import NOBODY, chosen
from bringup.arbiter.settings import Settings, Source

AUTONOMY = Source("autonomy", "cmd_vel_autonomy", 10, 0.2)
TELEOPERATION = Source("teleoperation", "cmd_vel_teleop", 100, 0.5)
STOP = Source("stop", "emergency_stop", 255, 0.0)
ALIVE = Source("alive", "watchdog", 50, 1.0)
SETTINGS = Settings((AUTONOMY, TELEOPERATION), (STOP,))
WATCHED = Settings((AUTONOMY, TELEOPERATION), (STOP, ALIVE))


@pytest.mark.parametrize(
    ("name", "heard", "locked", "holder"),
    [
        ("nobody was heard", {}, {}, NOBODY),
        ("autonomy alone", {"autonomy": 9.9}, {}, "autonomy"),
        ("teleoperation over autonomy", {"autonomy": 10.0, "teleoperation": 9.6}, {}, "teleoperation"),
        ("teleoperation has ended", {"autonomy": 10.0, "teleoperation": 9.4}, {}, "autonomy"),
        ("both have ended", {"autonomy": 9.7, "teleoperation": 9.4}, {}, NOBODY),
        ("heard before the clock was set back", {"autonomy": 11.0}, {}, NOBODY),
        ("stopped", {"autonomy": 10.0, "teleoperation": 10.0}, {"stop": (1.0, True)}, "stop"),
        ("free again", {"teleoperation": 10.0}, {"stop": (1.0, False)}, "teleoperation"),
        ("stopped, and nobody was heard", {}, {"stop": (1.0, True)}, "stop"),
        ("stopped before the clock was set back", {"autonomy": 10.0}, {"stop": (11.0, True)}, "stop"),
    ],
)
def test_who_is_in_force(
    name: str, heard: dict[str, float], locked: dict[str, tuple[float, bool]], holder: str
) -> None:
    assert chosen(SETTINGS, heard, locked, 10.0).holder == holder, name


@pytest.mark.parametrize(
    ("name", "alive", "holder"),
    [
        ("it has never spoken", {}, "alive"),
        ("it speaks", {"alive": (9.5, False)}, "autonomy"),
        ("it has fallen silent", {"alive": (8.5, False)}, "alive"),
        ("it says so", {"alive": (9.9, True)}, "alive"),
    ],
)
def test_a_lock_with_a_time_out_holds_as_well_while_it_is_silent(
    name: str, alive: dict[str, tuple[float, bool]], holder: str
) -> None:
    assert chosen(WATCHED, {"autonomy": 10.0}, alive, 10.0).holder == holder, name


def test_a_lock_leaves_inputs_of_greater_priority_free() -> None:
    heard = {"autonomy": 10.0, "teleoperation": 10.0}
    assert chosen(WATCHED, heard, {"alive": (10.0, True)}, 10.0).holder == "teleoperation"


times = st.floats(0.0, 20.0)


@given(
    heard=st.dictionaries(st.sampled_from(["autonomy", "teleoperation"]), times),
    locked=st.dictionaries(st.sampled_from(["stop", "alive"]), st.tuples(times, st.booleans())),
    now=times,
)
def test_nothing_old_and_nothing_below_a_lock_is_ever_in_force(
    heard: dict[str, float], locked: dict[str, tuple[float, bool]], now: float
) -> None:
    choice = chosen(WATCHED, heard, locked, now)
    if choice.input is None:
        assert choice.holder in {NOBODY, "stop", "alive"}
        return
    assert 0.0 <= now - heard[choice.input.name] <= choice.input.timeout
    assert not locked.get("stop", (0.0, False))[1]
    for other in WATCHED.inputs:
        if 0.0 <= now - heard.get(other.name, -1e9) <= other.timeout:
            assert other.priority <= choice.input.priority
