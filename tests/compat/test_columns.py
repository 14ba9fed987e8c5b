from __future__ import annotations

import linecache
from typing import TYPE_CHECKING

from hypothesis import given
from hypothesis import strategies as st

from orchestra.compat.columns import code_points, in_code_points, keep_plain

if TYPE_CHECKING:
    from pathlib import Path


@given(st.text(st.characters(exclude_categories=["Cs"])))
def test_a_column_in_bytes_is_one_in_characters(line: str) -> None:
    begins = [len(line[:column].encode()) for column in range(len(line) + 1)]
    assert [in_code_points(line, begin) for begin in begins] == [*range(len(line) + 1)]
    assert in_code_points(line, begins[-1] + 7) == len(line)


def test_files_of_plain_characters_are_known_until_they_are_others(tmp_path: Path) -> None:
    file = tmp_path / "some.launch.py"
    texts = [
        b"name = 'a'; x",
        "name = '\xe4'; x".encode(),
        b"# coding: utf-7\nname = '+AOQ-'; x",
        b"name = 'b'; x",
    ]
    columns = []
    for source in texts:
        file.write_bytes(source)
        linecache.checkcache(str(file))
        keep_plain(str(file), source)
        line = source.count(b"\n") + 1
        columns.append(code_points(str(file), line, len(linecache.getline(str(file), line).strip().encode())))
    assert columns == [13, 13, 13, 13]
