"""Launch files of a thousand of one thing: a check of them ends, and soon."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.misused import tell
from orchestra.errors import Problems
from orchestra.load.expressions import as_substitutions

if TYPE_CHECKING:
    from pathlib import Path

_MANY = 2_000


def _told(tmp_path: Path, text: str) -> int:
    file = tmp_path / "many.launch.py"
    file.write_text(text, "utf-8")
    problems = Problems()
    tell(compile(text, str(file), "exec"), text.encode(), str(file), problems, ())
    return len(list(problems))


def test_a_text_may_be_put_together_of_very_many_pieces(tmp_path: Path) -> None:
    """They are looked at one after the other, not one within the other."""
    pieces = " + ".join(f"'{{side}}{number}'" for number in range(_MANY))
    assert _told(tmp_path, f"side = 'left'\nLogInfo(msg={pieces})\n") == _MANY


def test_conditions_may_have_very_many_parts(tmp_path: Path) -> None:
    """What is deeper than the interpreter goes is left alone, and nothing but that."""
    sums = " + ".join(["'a'"] * _MANY)
    text = f"if name and {sums} == name:\n    pass\nif mode.lower == 'sim':\n    pass\n"
    assert _told(tmp_path, text) == 1


def test_the_effort_does_not_grow_with_the_square(tmp_path: Path) -> None:
    """Each name is looked for where it is set, not in all that a function sets: a minute of 2,000 before."""
    names = "".join(f"    v{number} = 'x'\n" for number in range(_MANY))
    texts = "".join(f"        LogInfo(msg='{{v{number}}}'),\n" for number in range(_MANY))
    text = f"def generate_launch_description():\n{names}    return LaunchDescription([\n{texts}    ])\n"
    assert _told(tmp_path, text) == _MANY


def test_conditions_of_other_languages_may_have_very_many_brackets() -> None:
    """Nobody has written such one: it is left as it is."""
    assert as_substitutions("(" * _MANY + "a && b" + ")" * _MANY) is None
    assert as_substitutions("not " * _MANY + "a") is None
    assert as_substitutions("((a && b))") == "$(and a b)"
