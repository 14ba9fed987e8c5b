"""What is made of a file that repeats itself is what the compiler makes of it, in all that a code says."""

from __future__ import annotations

import random

import pytest

from orchestra.resolve.python.codes import Codes
from orchestra.resolve.python.form_codes import is_same
from orchestra.resolve.python.runs import code_of

_CALL = (
    "Node(\n        package='p', name={text!r}, parameters=[{{'rate': {number} + 0.5, 'frames': [n, {text!r}]}}],\n"
    "        remappings=[('scan', {other!r}), ('odom', 'odom')], at=-{number}.5)"
)
_BEFORE = "import os\n\n\ndef generate(n, ld):\n    robot = f('robot', 'v1')\n"
_BEHIND = "\n\ndef behind(a=5):\n    return [n + 'v1' for n in a]\n\n\nx = behind('new',\n  5)\n"
_IN_ITS_PLACE = {
    "a list": "    return LaunchDescription([\n        f('first'),\n{items}    ], 'last', 'v3')\n",
    "a tuple": "    return (f('first'),\n{items}    )\n",
    "a call": "    return f('first',\n{items}    )\n",
    "a list behind a loop": "    for a in n:\n        f(a)\n    return [f(1),\n{items}    ]\n",
}


def _items(count: int, call: str = _CALL, end: str = ",\n", wide: int = 0) -> str:
    choice = random.Random(count)  # noqa: S311 - no secret
    return "".join(
        "        "
        + call.format(
            number=number + 2,
            text=f"v{number}{'x' * choice.randrange(wide + 1)}",
            other=f"v{choice.randrange(20)}",
        )
        + end
        for number in range(count)
    )


def _is_made(text: str) -> bool:
    """Return whether a code is made, which is the compiler's."""
    made = code_of("a.launch.py", text.encode())
    if made is not None:
        assert is_same(made, compile(text, "a.launch.py", "exec", dont_inherit=True)), text
    return made is not None


@pytest.mark.parametrize("place", _IN_ITS_PLACE.values(), ids=_IN_ITS_PLACE)
@pytest.mark.parametrize("count", [70, 90, 300])
@pytest.mark.parametrize("wide", [0, 60])
def test_items_of_a_long_file_are_made_of_a_few(place: str, count: int, wide: int) -> None:
    assert _is_made(_BEFORE + place.replace("{items}", _items(count, wide=wide)) + _BEHIND)


def test_statements_and_several_kinds_in_turn_are_made_of_a_few() -> None:
    statements = _items(100, f"ld.add_action({_CALL})\n        x = f({{text!r}}, 'v1')", "\n").replace(
        "\n        ld", "\n    ld"
    )
    assert _is_made(
        f"{_BEFORE}    {statements.replace('        x', '    x').strip()}\n    return ld\n{_BEHIND}"
    )
    call = f"{_CALL},\n        Include(file={{other!r}}),\n        f(n, {{text!r}}, f'v{{{{n}}}}')"
    assert _is_made(_BEFORE + _IN_ITS_PLACE["a list"].replace("{items}", _items(90, call)) + _BEHIND)


def test_a_literal_that_is_another_one_in_one_item_is_that() -> None:
    text = _BEFORE + _IN_ITS_PLACE["a list"].replace("{items}", _items(200)) + _BEHIND
    begin = text.index("'v150'")
    for old, new in (("'odom')", "'other')"), ("'p'", "'another package'"), ("'v150'", "'v3'")):
        place = text.index(old, begin)
        assert _is_made(text[:place] + new + text[place + len(old) :])


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("'rate'", "'v50'"),  # a key of a constant
        ("'p'", "'p\\n'"),
        ("'p'", "'p' 'q'"),
        ("'p'", "7"),
        ("'p'", "f'p'"),
        ("+ 0.5", "+ n"),
        ("+ 0.5", "+ 0.5 * 2"),
        ("[n,", "[not n,"),
        ("n, 'v50'", "n, 'v50' if n else 2"),
        ("n, 'v50'", "n, lambda: 'v50'"),
    ],
)
def test_an_item_of_another_kind_in_the_middle_is_left_to_the_compiler(old: str, new: str) -> None:
    text = _BEFORE + _IN_ITS_PLACE["a list"].replace("{items}", _items(100)) + _BEHIND
    place = text.index(old, text.index("'v50'"))
    changed = text[:place] + new + text[place + len(old) :]
    compile(changed, "a.launch.py", "exec")
    assert not _is_made(changed)


@pytest.mark.parametrize(
    "call",
    [
        "f(lambda: {text!r})", "f([a for a in {text!r}])", "{text!r} if n else {number}", "f(n or {text!r})",
        "f(({text!r}, 'b')[0])", "f('%s' % {text!r})", "f({text!r} 'b')", "f({{{text!r}, 'b', 'c'}})", "f(b{text!r}, {number})",
        "f({number} < {number})", "f(-n, {number} // 3)", "f(n[{number}])", "{text!r}: f(n)",
    ],
)  # fmt: skip
def test_what_the_compiler_may_work_out_is_left_to_it(call: str) -> None:
    items = _items(200, call)
    around = ("{{\n{}    }}\n" if ": f" in call else "[f(1),\n{}    ]\n").format(items)
    assert not _is_made(f"{_BEFORE}    return {around}{_BEHIND}")


@pytest.mark.parametrize(
    "around", ["[\n{}]", "(\n{})", "{{\n{}}}", "f(\n[\n{}])", "[a for a in [\n{}]]", "n in (\n{})"]
)
@pytest.mark.parametrize("item", ["{text!r}", "{number}", "({text!r}, {number})", "'the same'"])
def test_a_long_list_of_literals_is_one_constant_and_left_to_the_compiler(around: str, item: str) -> None:
    assert not _is_made(f"{_BEFORE}    return {around.format(_items(200, item))}\n")


def test_a_number_where_others_have_a_comment_is_no_comment() -> None:
    items = _items(200, "f(n, {text!r},\n          n  # {number}\n          )")
    assert _is_made(f"{_BEFORE}    return [f(1),\n{items}    ]\n")
    assert not _is_made(f"{_BEFORE}    return [f(1),\n{items.replace('# 150', '-3')}    ]\n")


def test_what_follows_may_not_jump_or_know_its_line() -> None:
    text = _BEFORE + _IN_ITS_PLACE["a list"].replace("{items}", _items(80))
    assert not _is_made(text.replace("return", "x =") + "    return x if n else robot\n")
    assert not _is_made(text.replace("return", "with f() as x:\n      x ="))


def test_a_long_file_that_repeats_itself_is_made_so_and_warned_of_as_ever() -> None:
    text = _BEFORE + _IN_ITS_PLACE["a list"].replace("{items}", _items(400)) + _BEHIND
    made = Codes(None, "top").code("b.launch.py", text.encode()).code
    assert is_same(made, compile(text, "b.launch.py", "exec", dont_inherit=True))
    doubtful = text.replace("return Lau", "ld is 'one'\n    return Lau")
    assert code_of("b.launch.py", doubtful.encode()) is None
    with pytest.warns(SyntaxWarning, match="literal"):
        Codes(None, "top").code("b.launch.py", doubtful.encode())
