"""Parameters that every node has, in a file that no launch file gives to a node."""

from __future__ import annotations

import pytest

from orchestra.declared.alone import check_common
from orchestra.errors import Problems
from orchestra.resolve.rcl.files import read_parameter_file


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("true", []),
        ("'true'", ["true"]),
        ("ture", ["true"]),
        ("1", ["true"]),
        ("2", [None]),
        ("'<use_sim_time>'", []),
        ("$(var use_sim_time)", []),
        ("[]", []),
    ],
)
def test_a_value_is_refused_where_it_is_plain_what_was_meant(written: str, meant: list[str | None]) -> None:
    """A text that another program puts a value in place of is none of our business."""
    problems = Problems()
    text = f"/talker: {{ros__parameters: {{use_sim_time: {written}}}}}"
    check_common(read_parameter_file(text, "params.yaml", problems), problems)
    assert [found.suggestion for found in problems] == meant
