"""What is read action by action, by what was learned of others, is what the ordinary way reads."""

from __future__ import annotations

import copy
import pickle
from random import Random
from typing import TYPE_CHECKING, Any, cast

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from orchestra.description.entity import Entity
from orchestra.description.text import Items, Template
from orchestra.errors import Problems
from orchestra.fields import replace
from orchestra.load import xml_file, yaml_file
from orchestra.load.alike import xml_items, yaml_items
from orchestra.load.alike.learned import Forms, action_of
from orchestra.load.alike.one_by_one import actions
from orchestra.load.entities import describe
from orchestra.load.offsets import source
from orchestra.load.reader import Reader
from orchestra.location import Location, point
from orchestra.plan.json_text import text_of as dumps_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.description.actions.log import Log
    from orchestra.description.entity import Action
    from orchestra.location import Span

_YAML = (
    "- node:\n    pkg: {0}\n    exec: {1}\n    name: '{2}'\n    output: screen\n    param:\n"
    '    - {{name: rate, value: {3}}}\n    - {{name: x, value: [{0}, "{1}"]}}\n    - from: {2}\n'
    "    args: {3}\n",
    "- let: {{name: a, value: {0}}} # {1}\n",
    "- arg:\n    name: {0}\n    default: {1}\n    description: {2}\n    choices: [{3}, 'b']\n",
    "- group:\n  - push_ros_namespace: {{namespace: {0}}}\n  - node: {{exec: {1}, name: {2}}}\n  # {3}\n",
    "- executable:\n    cmd: {0}\n    env:\n      - name: A\n        value: {1}\n    shell: {3}\n\n",
    "- include:\n    file: $(dirname)/{0}\n    arg: [{{name: {1}, value: '{2}'}}]\n    if: $(var {3})\n",
    "- log: {{message: {0} $(var a) {1}, level: info}}\n",
    "- set_parameter: {{name: {0}, value: {1}}}\n",
)
_XML = (
    '<node pkg="{0}" exec="{1}" name="{2}" output="screen"><param name="rate" value="{3}"/>\n'
    "  <remap from=\"{0}\" to='{1}'/></node>\n",
    '<let name="{0}" value="{1}"/> <!-- {2} -->\n',
    '<arg name="{0}" default="{1}" description="{2}"/>',
    '<group><push_ros_namespace namespace="{0}"/><node exec="{1}" name="{2}"/></group>\n',
    '<executable cmd="{0}" shell="{3}"><env name="A" value="{1}"/></executable>\n',
)
_ODD = st.text("ab1 :#-,'\"\\\n[]{}$()<>&!*~.|%@`=\tü\u2028", max_size=8)
_LIKELY = st.sampled_from(
    """a -1 --b -/c - -- 1.5 null ~ true $(var\ta) /$(var\ta)/b $(find-pkg-share\tx)/y\tz a:\tb a\t#b [a,\tb] {a:\tb} (var\ta) ${var\ta}
    it's 'q' "q" a,b $(env\tA) $(eval\t1) x=1 ... a\\b""".replace("\t", "\0").split()
).map(lambda text: text.replace("\0", " "))
_VALUES = st.lists(st.tuples(*[st.one_of(_LIKELY, _LIKELY, _ODD)] * 4), min_size=1, max_size=4)


FEW = 4


def _forgetful(module: Any, monkeypatch: pytest.MonkeyPatch, few: int = FEW) -> Forms:
    forms = Forms(few, short=0)
    monkeypatch.setattr(module, "FORMS", forms)
    return forms


def _ordinary(module: Any, text: str) -> tuple[tuple[Action, ...] | None, bool]:
    """Return the actions of a text as it is read otherwise, and whether there is nothing to tell of it."""
    reader = Reader(Problems())
    tree = module.read(text, "a", reader)
    found = None if tree is None else describe(tree, "/a", "a", reader)
    if found is None:
        return None, False
    return found.actions, not len(reader.problems) and not found.lost and found.deprecated is None


def _compare(text: str, items: Any, module: Any) -> bool:
    """Hold both ways to each other; return whether the one by one was taken."""
    found = actions(items, source("a", text), Reader(Problems()))
    if found is None:
        return False
    ordinary, sound = _ordinary(module, text)
    assert sound
    assert found == ordinary
    assert [repr(action) for action in found] == [repr(action) for action in ordinary or ()]
    assert list(_lists(found)) == list(_lists(ordinary))
    return True


def _lists(value: Any) -> Iterator[Span]:
    """Yield the places of lists, which are compared by their items alone."""
    if isinstance(value, Items):
        yield value.span
    elif isinstance(value, Entity | tuple):
        for inner in value.__dict__.values() if isinstance(value, Entity) else value:
            yield from _lists(inner)


def _written(template: str, values: Sequence[tuple[str, ...]]) -> str:
    plain = ("a", "b", "c", "true")
    return "".join(template.format(*item) for item in [*[plain] * FEW, *values])


_PIECES = (
    *" \n\t\r-:#,'\"\\[]{}()$&*!|>%@`~=?.<;\x85\u2028\xa0\ufeff😀\x00",
    *(
        "\n  ",
        "\n\n",
        "# c\n",
        ": ",
        "- ",
        "\n- ",
        "\n---\n",
        "\n...\n",
        "$(",
        "null",
        " #",
        "\r\n",
        "<!-- c -->",
    ),
    *(
        "&amp;",
        "/>",
        "<a/>",
        "''",
        '""',
        "on",
        "012",
        "!!str a",
        "&a b",
        "*a",
        "<<",
        "a: b",
        "a #b",
        "|\n      a",
    ),
    *(
        "$(var a)",
        "$(eval '1')",
        "$(var",
        "(var a)",
        "${a}",
        "$(env A b)",
        "\\x41",
        "it's",
        "a\n    name: z",
        "x:=y",
    ),
)


def _changed(rnd: Random, text: str) -> str:
    """Return a text of which one character or one line is another, or lacks."""
    at, lines = rnd.randrange(len(text)), text.split("\n")
    line = rnd.randrange(len(lines))
    match rnd.randrange(6):
        case 0:
            lines[line] = f" {lines[line]}" if rnd.random() < 0.5 else lines[line][1:]
        case 1:
            lines.insert(line, lines.pop(rnd.randrange(len(lines))))
        case 2:
            return text[:at] + text[at + 1 :]
        case _:
            return text[:at] + rnd.choice(_PIECES) + text[at + rnd.randrange(2) :]
    return "\n".join(lines)


def _attack(written: str, templates: Sequence[str], items: Any, module: Any, rnd: Random) -> bool:
    """Learn a form, perhaps an odd one, and compare what is written nearly so; return whether the form was tried."""
    template = rnd.choice(templates)
    base = template.format("a", "b", "c", "true")
    base = _changed(rnd, base) if rnd.random() < 0.5 else base
    values = [rnd.choice([*_PIECES, "a", "b c", "$(var x)/y"]) for _ in range(4)]
    other = template.format(*values) if rnd.random() < 0.5 else base
    other = _changed(rnd, other) if rnd.random() < 0.7 else other
    indent = rnd.choice(("", "  "))
    text = "".join([*[base] * FEW, other, *rnd.choice(((), (base,)))]).replace("\n", f"\n{indent}")
    return _compare(written.format(indent + text), items, module)


def _attacks(number: int, monkeypatch: pytest.MonkeyPatch) -> int:
    """Attack each format so many times, forms and what is read without any; return how often it was tried."""
    tried = 0
    for seed in range(number):
        for items in (yaml_items, xml_items):
            _forgetful(items, monkeypatch, few=FEW if seed % 2 else 1_000)
        rnd = Random(seed)  # noqa: S311 - the same every time
        tried += _attack("launch:\n{}", _YAML, yaml_items, yaml_file, rnd)
        tried += _attack("<launch>{}</launch>", _XML, xml_items, xml_file, rnd)
    return tried


def test_hostile_files_are_read_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    assert _attacks(40, monkeypatch) > 10


@pytest.mark.long
def test_thousands_of_hostile_files_are_read_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    assert _attacks(5_000, monkeypatch) > 1_500


@pytest.mark.parametrize("head", ["", "<?xml version='1.0'?>", "<!-- a -->", "<launch>"])
def test_blanks_are_matched_in_one_way(head: str) -> None:
    blanks = " \n" * 10_000
    written = source("a", f"{head}{blanks}<robot>{blanks}")
    assert actions(cast("Any", xml_items), written, Reader(Problems())) is None


def test_long_words_are_gone_through_once() -> None:
    word = "a" * 300_000
    assert yaml_items.words(f"a: {word}") == ["a"]
    assert xml_items.words(f"<a b='{word}'/>") == ["<a", "b"]


@settings(deadline=None)  # a busy machine is no fault
@given(st.sampled_from(_YAML), _VALUES, st.integers(0, 4))
def test_yaml_is_read_alike(template: str, values: list[tuple[str, ...]], indent: int) -> None:
    text = _written(template, values).replace("\n", f"\n{' ' * indent}").rstrip(" ")
    _compare(f"launch:\n{' ' * indent}{text}", yaml_items, yaml_file)


@settings(deadline=None)  # a busy machine is no fault
@given(st.sampled_from(_XML), _VALUES)
def test_xml_is_read_alike(template: str, values: list[tuple[str, ...]]) -> None:
    _compare(f"<launch>{_written(template, values)}</launch>\n", xml_items, xml_file)


@pytest.mark.parametrize(
    ("items", "module", "written", "template"),
    [
        *[(yaml_items, yaml_file, "# a\nlaunch:\n{}", template) for template in _YAML],
        *[
            (xml_items, xml_file, '<?xml version="1.0"?>\n<launch>\n{}</launch>', template)
            for template in _XML
        ],
    ],
)
def test_forms_are_learned(
    items: Any, module: Any, written: str, template: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    forms = _forgetful(items, monkeypatch)
    assert _compare(written.format(_written(template, [])), items, module)
    (known,) = forms.known.values()
    assert len(known) == 1
    others = [("x", "/y", "Z1", "true"), ("long_one", "$(var a)", "no text", "true")]
    text = written.format("".join(template.format(*item) for item in others))
    reader, whole = Reader(Problems()), source("a", text)
    assert all(action_of(known, whole, item, reader) for item in items.items(whole))
    assert _compare(text, items, module)


@pytest.mark.parametrize("learned", ["b", "b:c"])
@pytest.mark.parametrize(
    "value",
    [
        "null",
        "Null",
        "full",
        "NULL",
        "b:null",
        "b:full",
        "--b",
        "--",
        "---b",
        "b ?",
        "b & c",
        "b:",
        "b: c",
        "[b]",
    ],
)
def test_values_that_may_be_no_texts_are_read_alike(
    learned: str, value: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    _forgetful(yaml_items, monkeypatch)
    text = "- let:\n    name: a\n    value: {}\n"
    written = [learned] * FEW + [value, learned]
    _compare("launch:\n" + "".join(map(text.format, written)), yaml_items, yaml_file)


def test_what_looks_alike_may_be_of_several_forms(monkeypatch: pytest.MonkeyPatch) -> None:
    forms = _forgetful(yaml_items, monkeypatch)
    plain, quoted = "- arg: {name: a, default: b}\n", "- arg: {name: a, default: 'b'}\n"
    assert _compare("launch:\n" + plain * FEW + quoted * 3 * FEW, yaml_items, yaml_file)
    assert [len(known) for known in forms.known.values()] == [2]


def test_long_actions_are_learned_sooner_than_short_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    def learned_from(action: str) -> int:
        forms = Forms()
        monkeypatch.setattr(yaml_items, "FORMS", forms)
        return next(count for count in range(1, 300) if _logs(action) and forms.known)

    short, long = "- log: {message: a}\n", "- group:\n" + "  - log: {message: a, level: info}\n" * 10
    assert learned_from(short) > 2 * learned_from(long) > 20


def _logs(text: str) -> Sequence[Log]:
    items: Any = yaml_items
    found = actions(items, source("a", f"launch:\n{text}"), Reader(Problems()))
    return cast("Sequence[Log]", found)


def test_texts_of_a_form_are_as_others(monkeypatch: pytest.MonkeyPatch) -> None:
    _forgetful(yaml_items, monkeypatch)
    written = "- log: {message: x $(var b) y, level: info}\n" * (FEW + 1)
    *_, matched = _logs(written)
    found, _ = _ordinary(yaml_file, f"launch:\n{written}")
    *_, read, _ = cast("Sequence[Log]", found)
    text = matched.message
    assert type(read.message) is not type(text)
    assert (text != read.message, text.raw) == (True, read.message.raw)  # they stand in two places
    assert copy.deepcopy(text) is text  # nothing in it can change
    for same in (pickle.loads(pickle.dumps(text)), replace(text, raw=text.raw)):  # noqa: S301 - ours
        assert type(same) is Template
        assert (text == same, same == text, hash(same), repr(same)) == (True, True, hash(text), repr(text))
    assert replace(text, raw="z").raw == "z"


def test_places_of_a_form_are_as_others(monkeypatch: pytest.MonkeyPatch) -> None:
    _forgetful(yaml_items, monkeypatch)
    *_, one, other = _logs("- log: {message: x, level: info}\n" * (FEW + 2))
    chain = (point("b"),)
    found = one.location(chain)
    assert found == one.location(chain)
    assert found != other.location(chain)
    assert found != one.location(())
    for same in (
        pickle.loads(pickle.dumps(found)),  # noqa: S301 - ours
        copy.deepcopy(found),
        replace(found, included_from=chain),
    ):
        assert type(same) is Location
        assert (found == same, same == found, hash(same), repr(same)) == (
            True,
            True,
            hash(found),
            repr(found),
        )
    assert dumps_of(found) == dumps_of(Location(one.span, chain))


@pytest.mark.parametrize("behind", ["", "\n\n", "  ", "   # c\n\n # c", "\n  - log: {message: a}\n"])
def test_lists_in_block_form_end_where_the_next_thing_begins(behind: str) -> None:
    item = "  - arg:\n      name: {0}\n      choices:\n        - {0}\n"
    text = "launch:\n" + "".join(item.format(name) for name in "abcdef").rstrip("\n") + behind
    assert _compare(text, yaml_items, yaml_file)


def test_actions_of_very_many_values_are_no_forms(monkeypatch: pytest.MonkeyPatch) -> None:
    forms = _forgetful(yaml_items, monkeypatch)
    action = "- arg:\n    name: a\n    choices:\n" + "    - b\n" * 1_000
    assert _compare(f"launch:\n{action * (FEW + 1)}", yaml_items, yaml_file)
    assert not forms.known


def test_a_form_has_its_indentation(monkeypatch: pytest.MonkeyPatch) -> None:
    _forgetful(yaml_items, monkeypatch)
    assert _compare("launch:\n" + "- log:\n    message: a\n" * (FEW + 1), yaml_items, yaml_file)
    assert not _compare("launch:\n    - log:\n    message: a\n", yaml_items, yaml_file)


@pytest.mark.parametrize(
    "text",
    [
        "launch:\n- node: {exec: a}\nother: 1\n",
        "launch:\n- node: {exec: a}\n---\nlaunch: []\n",
        "launch:\n- node: {exec: a}\n- node: {exec: 'a\n- node: b'}\n",
        "launch:\n- node: {exec: [a,\n- b]}\n",
        "launch:\n- node: &x {exec: a}\n- *x\n",
        "launch:\n- node: {exec: a}\n-\n  node: {exec: b}\n",
        "launch:\n- node: {exec: a}\n  arg: {name: b}\n",
        "launch:\n- nod: {exec: a}\n",
        "launch: [{node: {exec: a}}]\n",
        "launch:\n- node: {exec: a}\r- node: {exec: b}\n",
        "launch:\n- node: {exec: a, name: (var a)}\n",
        "launch:\n- node: {exec: a}\n...\n- node: {exec: b}\n",
        "launch:\n- a\n",
        "launch:\n",
        "",
    ],
)
def test_what_takes_a_closer_look_is_left_alone(text: str) -> None:
    assert not _compare(text, yaml_items, yaml_file)


@pytest.mark.parametrize(
    "text",
    [
        "<launch><node exec='a'/></launch><launch/>",
        "<launch><node exec='a'/>text</launch>",
        "<launch x='1'><node exec='a'/></launch>",
        "<launch><node exec='a'></launch>",
        "<launch><nod exec='a'/></launch>",
        "<launch><node exec='a' exec='b'/></launch>",
        '<?xml version="1.0" encoding="-x"?><launch/>',
        '<?xml version="1.0" encoding="é"?><launch></launch>',
        "<launch><group><group></group></group></launch>",
        "<launch><node exec='a'/>",
        "",
    ],
)
def test_xml_that_takes_a_closer_look_is_left_alone(text: str) -> None:
    assert not _compare(text, xml_items, xml_file)


@pytest.mark.parametrize(
    "text",
    [
        "<launch><node exec='a'><!-- </node> --></node></launch>",
        "<launch><group><group><node exec='a'/></group><!-- b --></group ></launch >\n",
        "<launch>\n<node\n  exec = 'a'\n  name=\"b's\" namespace='\"'\n/>\n</launch>",
        "<launch><node exec=\"a\" if=\"$(eval '1 &lt; 2 and &quot;&amp;&quot;')\" output='screen'/></launch>",
        '<launch><log message="&gt;"/><log message=""/><log message="it\'s"/><log message="$(var a) &amp;"/></launch>',
        "<launch></launch>",
    ],
)
def test_xml_that_is_plain_takes_no_closer_look(text: str) -> None:
    assert _compare(text, xml_items, xml_file)


def test_a_block_of_the_wrong_kind_in_a_long_file_is_left_to_the_ordinary_way() -> None:
    """What is told of it is told in the words of the file, which the reader of single actions has to know, too."""
    text = f"# {'x' * 1000}\nlaunch:\n- node:\n    pkg: demo\n    exec: talker\n    env:\n      A: '1'\n"
    assert actions(cast("Any", yaml_items), source("a.launch.yaml", text), Reader(Problems())) is None
