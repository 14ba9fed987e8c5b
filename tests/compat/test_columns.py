from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from orchestra.compat.columns import in_code_points


@given(st.text(st.characters(exclude_categories=["Cs"])))
def test_a_column_in_bytes_is_one_in_characters(line: str) -> None:
    begins = [len(line[:column].encode()) for column in range(len(line) + 1)]
    assert [in_code_points(line, begin) for begin in begins] == [*range(len(line) + 1)]
    assert in_code_points(line, begins[-1] + 7) == len(line)
