"""What a form makes of a file is what the compiler makes of it, in all that a code says."""

from __future__ import annotations

import random
import re
import sys
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from orchestra.compat.looks import LOOKS, Compiled
from orchestra.resolve.python.form_codes import is_same
from orchestra.resolve.python.form_slots import Slots, split
from orchestra.resolve.python.forms import Forms

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import CodeType


_LAUNCH_FILE = """\
# Robot @1@
from launch import LaunchDescription
from launch_ros.actions import Node

ROBOT = @1@  # its name
COUNT: int = @2@


def generate_launch_description(second: @1@, first=@3@, third=(@4@, @5@)):
    '''Return what is started.'''
    settings = {@1@: @6@, 'list': [@2@, @7@, 3], @4@: first.get(@5@)}
    settings[@1@] = (@4@, @5@), [@6@, @7@], {'yaw': -0.25, @6@: -31}
    first = settings.get(@3@, @2@)
    return LaunchDescription([
        Node(package=@1@, executable=@3@, name=@4@, namespace=ROBOT, parameters=[{@5@: @6@, 'frame': [ROBOT, @7@]}],
             remappings=[('scan', @1@), (@4@, @5@)], arguments=[
                 @2@,
                 @3@]),
        Node(package=@7@, name=settings[@1@], parameters=[@1@, @2@, @3@]),
        Node(package=@1@
             , name=@1@, output='screen'),
    ])
"""
_PLACES = 7
_TEXTS = st.text("ab_ /-.{%", max_size=20).map(repr)
_NUMBERS = st.one_of(st.integers(0, 300), st.floats(0, 100)).map(repr)
_OTHERS = st.sampled_from(
    ["'name'", "'screen'", "''", "0", "1", "1.0", "0.0", "'scan'", "'x\\n'", "1_0", "0x1", "'a' 'b'"]
)
_LITERALS = st.lists(st.one_of(_TEXTS, _TEXTS, _NUMBERS, _OTHERS), min_size=_PLACES, max_size=_PLACES)


class Files:
    """Files of which codes are made, and the number of those that the compiler was asked for."""

    def __init__(self) -> None:
        self.forms = Forms()
        self.compiled = 0

    def code(self, text: str) -> CodeType:
        """Return the code of a file, which is as the compiler's."""
        source = text.encode()
        own = compile(source, "a.launch.py", "exec", dont_inherit=True)
        made = self.forms.compiled("a.launch.py", source)
        if made is None:
            self.compiled += 1
            self.forms.add(Compiled(own, source, _told(own, source)))
            return own
        assert is_same(made.code, own), text
        assert made.told == {look: told for look, told in _told(own, source).items() if look in made.told}
        return made.code


def _told(code: CodeType, source: bytes) -> dict[str, bool]:
    return {name: look(code, source) for name, look in LOOKS.items()}


def _filled(text: str, literals: list[str]) -> str:
    for number, literal in enumerate(literals, 1):
        text = text.replace(f"@{number}@", literal)
    return text


@settings(max_examples=25, deadline=None)
@given(st.lists(_LITERALS, min_size=2, max_size=4))
def test_any_literals_make_what_the_compiler_makes(files: list[list[str]]) -> None:
    known = Files()
    for literals in files:
        known.code(_filled(_LAUNCH_FILE, literals))


def test_files_that_are_alike_are_compiled_no_more() -> None:
    known = Files()
    for number in range(1, 9):
        words = [f"'{'long_' * number}{place}'" for place in range(_PLACES)]
        known.code(_filled(_LAUNCH_FILE, words))
        known.code(
            _filled(_LAUNCH_FILE, [f"'{number}'", "8", "'b'", "'c'", f"{number}.5", "'d'", f'"{number}e"'])
        )
    assert known.compiled <= 4


_LITERAL = "call({})\n".format(", ".join(f"'{letter}'" for letter in "abcdefghijkl"))


@pytest.mark.parametrize(
    ("first", "other"),
    [
        ("if ('yes'):\n    pass\n", "if (''):\n    pass\n"),
        ("x = 1 if ('yes') else 2\n", "x = 1 if ('') else 2\n"),
        ("x = call(('yes') and 3, not 'yes')\n", "x = call(('') and 3, not '')\n"),
        ("while (1):\n    x()\n", "while (0):\n    x()\n"),
        ("x = 'ab' 'c', 'abc'\n", "x = 'xy' 'z', 'abc'\n"),
        ("x = call('ab' + 'c', 'abc')\n", "x = call('ab' + 'c', 'other')\n"),
        ("x = call('abc', y=-1, z=-2)\n", "x = call('abc', y=-7, z=-2)\n"),
        ("x = ('p', 'q')[1]\n", "x = ('p', 'q')[0]\n"),
        ("x = 'pq'[1]\n", "x = 'pq'[0]\n"),
        ("x = ('p', 'q') * 2, ('p', 'q', 'p', 'q')\n", "x = ('r', 'q') * 2, ('p', 'q', 'p', 'q')\n"),
        ("x = '%s and %d' % ('p', 3)\n", "x = '%s and %d' % ('q', 4)\n"),
        ("x = call('%s', 1)\n", "x = call('%s', True)\n"),
        ("x = call(1, 2)\n", "x = call(1, 1)\n"),
        ("x = call(1, 2)\n", "x = call(1, 1.0)\n"),
        ("x = call(1.5, 2)\n", "x = call(0.0, -0.0)\n"),
        ("x = call('p', name='q')\n", "x = call('name', name='name')\n"),
        ("x = call(p='q'), ('r', 's')\n", "x = call(p='q'), ('p', 's')\n"),
        ("x = call(p=1, q=2), ('r', 's')\n", "x = call(p=1, q=2), ('p', 'q')\n"),
        ("import p\nx = call(5, 6)\n", "import p\nx = call(0, 6)\n"),
        ("def f():\n    'told'\n    return ['told']\n", "def f():\n    'other'\n    return ['told']\n"),
        ("def f():\n    'told'\n    return ['told', 2]\n", "def f():\n    'told'\n    return ['other', 2]\n"),
        ('x = f"{y("p")}", "p"\n', 'x = f"{y("q")}", "p"\n'),
        ("x = f'{y}p', ['p']\n", "x = f'{y}p', ['q']\n"),
        ("x = y + 2 + 3, 5\n", "x = y + 4 + 7, 11\n"),
        ("x = 2 + 3 + y, 5\n", "x = 2 + 4 + y, 6\n"),
        ("x = y, +2, 2\n", "x = y, +3, 2\n"),
        ("x = ('p', 'q') + ('r',), 'p'\n", "x = ('s', 'q') + ('t',), 'p'\n"),
        ("x = y + ('p', 'q') + ('r',)\n", "x = y + ('s', 'q') + ('t',)\n"),
        ("x = 'p' + y + 'q' + 'r', 2 + y\n", "x = 'p1' + y + 'q2' + 'r', 3 + y\n"),
        ("def f(y):\n    return + 2, y + 2\n", "def f(y):\n    return + 3, y + 4\n"),
        ("for y in + 2, 2:\n    x = 1 + y\n", "for y in + 3, 2:\n    x = 2 + y\n"),
        ("x = 2 + True, 3\n", "x = 4 + True, 3\n"),
        ("x: 'int' = ['p']\n", "x: 'str' = ['p']\n"),
        ("x = ['''p''', 'q']\n", "x = ['''p\\\n''', 'q']\n"),
        ("x = [r'p', b'q', 'q']\n", "x = [r'q', b'p', 'q']\n"),
        ("x = ['p', # one\n 'q']\n", "x = ['p2', # another one\n 'q22']\n"),
        ("match y:\n    case ['p', {'q': 1}]: pass\n", "match y:\n    case ['pp', {'r': 2}]: pass\n"),
        ("for x in ('p', 'q'):\n    y['p'] = 'q'\n", "for x in ('p1', 'q1'):\n    y['p1'] = 'q1'\n"),
        ("class C:\n    x = 'C'\n    y = ['p']\n", "class C:\n    x = 'C'\n    y = ['C']\n"),
        ("x = [lambda: 'p', lambda y='q': y]\n", "x = [lambda: 'p1', lambda y='q1': y]\n"),
        ("from __future__ import annotations\ndef f(x: 'p', y: 'q'): ...\n",) * 2,
        ("def f():\n    n_1 = 'p'\n    return n_1\n", "def f():\n    n_22 = 'q'\n    return n_22\n"),
        ("def f():\n    n1 = m1 = 3\n    return n1\n", "def f():\n    n7 = m1 = 3\n    return n7\n"),
        ("def f():\n    n1, n2 = 3\n    return n2, n1\n", "def f():\n    n2, n1 = 3\n    return n1, n2\n"),
        ("def f():\n    n1, n2 = 3\n    return n2, n1\n", "def f():\n    n1, n1 = 3\n    return n1, n1\n"),
        ("def f():\n    n1 = 3\n    return n2, n1\n", "def f():\n    n2 = 3\n    return n2, n2\n"),
        ("def f():\n    n1 = 3\n    return int, n1\n", "def f():\n    int2 = 3\n    return int, int2\n"),
        ("def f():\n    n1 = 3\n    return x(n1=n1)\n", "def f():\n    n2 = 3\n    return x(n2=n2)\n"),
        ("def f():\n    n1 = 3\n    return x.n1, n1\n", "def f():\n    n2 = 3\n    return x.n2, n2\n"),
        ("def f():\n    n1 = 3\n    return f'{n1}'\n", "def f():\n    n2 = 3\n    return f'{n2}'\n"),
        ("def f():\n    n1 = 3\n    return lambda: n1\n", "def f():\n    n2 = 3\n    return lambda: n2\n"),
        (
            "def f():\n    b1 = a1 = 3\n    return lambda: b1 + a1\n",
            "def f():\n    b1 = c1 = 3\n    return lambda: b1 + c1\n",
        ),
        (
            "def f():\n    b1 = a1 = 3\n    def g():\n        return b1, a1\n    return g\n",
            "def f():\n    b1 = c1 = 3\n    def g():\n        return b1, c1\n    return g\n",
        ),
        (
            "def f():\n    b1 = n1 = 3\n    def g():\n        n1 = b1\n        return n1\n    return g\n",
            "def f():\n    b1 = n1 = 3\n    def g():\n        b1 = b1\n        return b1\n    return g\n",
        ),
        ("def f():\n    global n1\n    n1 = 3\n", "def f():\n    global n2\n    n2 = 3\n"),
        ("def f():\n    n1 = 3\ndef g():\n    n1 = 4\n", "def f():\n    n2 = 3\ndef g():\n    n1 = 4\n"),
        ("def f(n1):\n    m1 = n1\n    return m1, 'm1'\n", "def f(n2):\n    m2 = n2\n    return m2, 'm2'\n"),
        ("def f():\n    import n1.x\n    return n1\n", "def f():\n    import n2.x\n    return n2\n"),
        (
            "def f():\n    from y import n1\n    return n1\n",
            "def f():\n    from y import n2\n    return n2\n",
        ),
        ("def f():\n    f1 = 'p'\n    return f1\n", "def f():\n    f2 = 'p'\n    return f'p'\n"),
        (
            "class C:\n    def f(self):\n        __n1 = 3\n        return __n1\n",
            "class C:\n    def f(self):\n        __n2 = 3\n        return __n2\n",
        ),
        (
            "def f():\n    return [n1 for n1 in ['p', 'q']]\n",
            "def f():\n    return [n2 for n2 in ['r', 'q']]\n",
        ),
        ("x = \\\n    'p'\ny = ['q', \\\n 'r']\n", "x = \\\n    'p1'\ny = ['q1', \\\n 'r1']\n"),
    ],
)
def test_literals_that_decide_something_are_left_to_the_compiler(first: str, other: str) -> None:
    known = Files()
    if sys.version_info < (3, 12) and '{y("' in first:
        pytest.skip("quotes inside of quotes")
    for text in (first, other, first, other):
        if not text.startswith("from __future__"):
            known.code(_LITERAL + text)
        known.code(text + _LITERAL)


def _is_plain(parts: list[str]) -> bool:
    try:
        return Slots(parts, ()).is_plain
    except ValueError:
        return False


@pytest.mark.parametrize(
    "text",
    [
        "x = f'{a}'", "x = b'a'", "if x:\n    pass", "x = [lambda: 3]", "x = [i for i in 'a']", "x = not y",
        "x = (a := 3)", "x = a == 3", "x = 3 - 2 - 1", "x = 3 // 2", "x = a -2", "x = call(*y)", "x = ('a', 'b')[1]",
        "x = 'a'[1]", "x = a[1][2]", "@d\ndef f(): pass", "class C: pass", "match x:\n    case 1: pass", "x = 'a' if y else 'b'",
        "x = call() \\\n    .other()", "global x", "async def f(): pass", "x = {*y}", "x = 'a' % y",
    ],
)  # fmt: skip
def test_what_the_compiler_may_work_out_has_no_form(text: str) -> None:
    assert not _is_plain(split(f"from a import b\n{text}\n"))


def test_what_generated_files_do_has_a_form() -> None:
    assert _is_plain(split(_filled(_LAUNCH_FILE, ["'a'", "2", "'c'", "'d'", '"e"', "6.5", "'g'"])))
    assert _is_plain(split("x = [-1, {'a': -1.5}, call(-2, b=-3), None, True]  # it's\n"))


_LOOPING = """\
from names import Node

ARGUMENTS = [f'{sign}-{sign}' for sign in ('a', 'b')]


def generate_launch_description(*names):
    nodes = [
        Node(package='package', name=name, rate=@2@, parameters=[{'use_sim_time': True, 'frame': '@1@'}])
        for name in ['@1@_left', '@1@_right', 'middle']
    ]
    first = @3@ + len(names)
    for number in range(@2@, @3@):
        last = @2@ + number
        words = '@1@_' + str(last), number + @3@
        nodes.append(Node(name=f'node{number}', rate=number + 0.5))
        if number % 2 == 0:
            nodes.append(Node(name='even', args=['%d' % number, -1]))
    try:
        nodes.append(Node('a', 'b', 'c', 'd'))
    finally:
        found = nodes if nodes else ['nothing']
    return found
"""


def test_loops_and_what_else_is_the_same_in_files_are_part_of_forms() -> None:
    known = Files()
    for number in range(10, 30):
        known.code(_filled(_LOOPING, [f"robot{number**2}", f"{number * 20}", f"{number * 30 + 1}"]))
    assert known.compiled == 2


@pytest.mark.parametrize("name", ["left_", "'a' if", "{number}-", "-2", "% 3"])
def test_what_is_looked_at_or_worked_with_is_part_of_no_form(name: str) -> None:
    """Each file differs in a statement that does more than to make things."""
    known, mended = (
        Files(),
        {
            "left_": ("'middle'", "('left_', @4@)[0]"),
            "'a' if": ("if nodes else", "if '@4@' else"),
            "{number}-": ("{number}", "{number}-@4@"),
            "-2": ("-1", "-1 - @4@"),
            "% 3": ("% 2 == 0", "% @4@ == 0"),
        }[name],
    )
    for number in range(10, 15):
        text = _LOOPING.replace(*mended)
        known.code(_filled(text, ["robot", "20", "30", f"{number}"]))
    assert known.compiled == 5


def test_numbered_variables_are_part_of_no_form() -> None:
    known = Files()
    for first in range(0, 120, 12):
        names = range(first, first + 12)
        nodes = "".join(
            f"    node{number} = Node(name='node{number}', rate={number}.5)\n" for number in names
        )
        added = "".join(f"    found.add_action(node{number})\n" for number in names)
        known.code(f"def generate_launch_description():\n{nodes}{added}    return found\n")
    assert known.compiled <= 2


def test_shifted_columns_are_those_of_the_compiler_however_far_right() -> None:
    known, choice = Files(), random.Random(7)  # noqa: S311 - no secret
    for _ in range(40):
        widths = [choice.choice((1, 14, 15, 16, 17, 70, 130, 4000)) for _ in range(_PLACES)]
        known.code(_filled(_LAUNCH_FILE, [f"'{place}{'x' * width}'" for place, width in enumerate(widths)]))
    assert known.compiled <= 2


def test_other_texts_than_ascii_and_other_lines_are_left_to_the_compiler() -> None:
    known = Files()
    texts = [_LITERAL.replace("a", sign) for sign in ("ä", "ö", "ü")] + [_LITERAL.replace("\n", "\r\n")] * 2
    for text in texts:
        known.code(text)
    assert known.compiled == len(texts)


@pytest.mark.parametrize(
    "coding", ["# coding: utf-7", "#!/usr/bin/python\n# -*- coding: iso2022_jp -*-", "# vim: fileencoding=hz"]
)
def test_texts_whose_signs_stand_for_others_are_left_to_the_compiler(coding: str) -> None:
    """Of those alone that say so the compiler makes other signs than stand there."""
    for text, count in ((coding, 4), (re.sub(r"([:=]) ?(?!utf-8)\w[\w-]+", r"\1 utf-8", coding), 2)):
        known = Files()
        for word in ("yes", "other", "third", "+AGE-~{<:~}"):
            known.code(f"{text}\n{_LITERAL}x = f('{word}', y)\n")
        assert known.compiled == count


@pytest.mark.parametrize("before", ["key=", "y + "])
@pytest.mark.parametrize("blanks", ["\n", "  # a number\n", "\n" + " " * 300])
def test_a_number_that_is_asked_for_something_is_none_with_a_sign(before: str, blanks: str) -> None:
    known = Files()
    for number in ("515", "51666", "717", "-518"):
        known.code(f"{_LITERAL}x = call({before}{number}{blanks}.bit_length())\n")


def test_what_two_numbers_come_to_is_one_literal_and_numbers_may_have_signs() -> None:
    known = Files()
    text = "def f(y):\n    return [Node(f'n{y}', rate=@1@ + 0.5, at=[@2@, y]) for y in range(@1@, @1@ * 2)]\n"
    for number in range(10, 18):
        known.code(_filled(_LITERAL + text, [f"{number}", f"-{number}.25"]))
    assert known.compiled == 2
    for number, sign in enumerate(("-", "*", "/"), 20):
        known.code(_filled(_LITERAL + text, [f"{number}", "-91.75"]).replace("+", sign))
    assert known.compiled == 2
    for other in ("+ 0.5 + 1", "+ 0.5 * y", "// 3", "+ (5)"):
        known.code(_filled(_LITERAL + text, ["30", "-91.75"]).replace("+ 0.5", other))
    assert known.compiled == 6


def test_a_file_that_differs_elsewhere_too_makes_the_form_wider() -> None:
    known, text = Files(), f"{_LITERAL}x = ['@1@', '@2@', '@3@', @4@]\n"
    for words in (["o", "p", "q", "1"], ["o", "p2", "q", "1"], ["o", "p", "q3", "1"], ["o", "p", "q", "22"]):
        known.code(_filled(text, words))
    assert known.compiled == 4
    known.code(_filled(text, ["o", "p5", "q55", "555"]))
    assert known.compiled == 4
    known.code(_filled(text, ["o5", "p", "q", "1"]))
    assert known.compiled == 5


def test_positions_move_only_where_the_compiler_has_shown_how() -> None:
    known, text = Files(), f"{_LITERAL}x = ['@1@', y]\n"
    for word in ("p1", "p2", "p3"):
        known.code(_filled(text, [word]))
    assert known.compiled == 2
    for word in ("p22", "p333", "p4444"):
        known.code(_filled(text, [word]))
    assert known.compiled == 3


def test_what_looks_tell_is_so_of_files_that_are_alike_but_for_numbers() -> None:
    known = Files()
    text = f"{_LITERAL}def f():\n    n_@1@ = Node(name='@2@')\n    return [@3@]\n"
    for words in (["1", "n_1", "2.5"], ["7", "n_7", "8.25"], ["9", "n_9", "3.75"], ["9", "n_8", "3.75"]):
        known.code(_filled(text, words))
    assert known.compiled == 2


_CALLS = "".join(f"    call(key_{letter}='@{letter}')\n" for letter in "abcdefghijkl")
_TREACHEROUS = {
    "a name that only a text in braces knows": (
        "from names import *\ndef function():\n    node_@ = call()\n    call(node_@, f'{node_99}')\n",
        "99",
    ),
    "a number that the compiler works with": (
        "def function():\n    call(@7, (1, @7)[1] // 1000000000000)\n",
        "900000000000",
    ),
    "a set that is gone through in the order of its table": (
        "def function():\n    for number in {@16, @8, @24}:\n        call(number)\n",
        "",
    ),
    "a text in braces with the quotes around it, and the sign of a comment": (
        'def function(names):\n    call(key=f"{names["#name"]}", other="@")\n',
        "9",
    ),
}


@pytest.mark.parametrize("name", _TREACHEROUS)
def test_what_only_looks_like_a_literal_is_left_to_the_compiler(name: str) -> None:
    """Each of these was made with a wrong code."""
    text, last = _TREACHEROUS[name]
    if '["#' in text and sys.version_info < (3, 12):
        pytest.skip("texts in braces know no such quotes here")
    files = Files()
    for number in range(10, 18):
        files.code((text + _CALLS).replace("@", str(number)))
    source = (text + _CALLS).replace("@", last)
    made, own = files.code(source), compile(source, "a.launch.py", "exec", dont_inherit=True)
    assert [list(item) for item in _sets(made)] == [list(item) for item in _sets(own)]


def _sets(code: CodeType) -> Iterator[frozenset[object]]:
    for item in code.co_consts:
        if isinstance(item, frozenset):
            yield item
        elif isinstance(item, type(code)):
            yield from _sets(item)
