"""The pages of the codes of this room: the wrong example gives the code and nothing else, the right one nothing."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.declared.checking import checked

_PAGES = Path(__file__).parents[2] / "orchestra" / "cli" / "explaining" / "pages"
_FENCE = re.compile(r"^```\w+\n# (?P<name>\S+)\n(?P<text>.*?)^```$", re.DOTALL | re.MULTILINE)


def _files(example: str) -> dict[str, str]:
    """Return the files of an example, the launch file first."""
    return {found["name"]: found["text"] for found in reversed([*_FENCE.finditer(example)])}


@pytest.mark.parametrize("code", [f"ORC{number:03}" for number in range(90, 98)])
def test_examples_do_what_their_page_says(tmp_path: Path, code: str) -> None:
    wrong, right = (_PAGES / f"{code}.md").read_text("utf-8").split("## Wrong")[1].split("## Right")
    assert [problem.code for problem in checked(tmp_path / "wrong", _files(wrong))] == [code]
    assert checked(tmp_path / "right", _files(right)) == ()
