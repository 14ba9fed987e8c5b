"""Which processes an object of a Python launch file has made, while they come and go."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

from hypothesis import given
from hypothesis import strategies as st

from orchestra.resolve.found import Found

_STEPS = st.lists(st.sampled_from(["a", "b", "c", "none", "drop", "look"]), max_size=40)


@given(_STEPS)
def test_processes_are_found_by_what_made_them(steps: list[str]) -> None:
    origins: dict[str, Any] = {"a": object(), "b": object(), "c": object(), "none": None}
    found = Found()
    for step in [*steps, "look"]:
        if step == "look":
            for origin in origins.values():
                made = (number for number, process in enumerate(found.processes) if process.origin is origin)
                assert found.made_by(origin) == tuple(made)
        elif step == "drop":
            if found.processes:
                found.drop_process()
        else:
            found.processes.append(cast("Any", SimpleNamespace(origin=origins[step])))
