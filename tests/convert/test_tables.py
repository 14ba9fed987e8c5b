"""The tables of the launch language, converted there and back."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.convert.converting import convert
from orchestra.convert.texts import normal, written
from orchestra.description.text import Template
from orchestra.errors import Problems
from orchestra.load.files import load
from orchestra.load.grammar import parse_template
from orchestra.location import point
from tests.convert.turning import round_trip, same_everywhere, turned
from tests.load import test_grammar_tables as grammar
from tests.load import test_language_tables as language_tables
from tests.load import test_parameter_tables as parameters
from tests.load.written import WRITERS, Actions, attribute

if TYPE_CHECKING:
    from collections.abc import Iterator

_PROBES = Path(__file__).parents[1] / "data" / "launch-probes.jsonl"
_SOUND = [row for row, (_, _, expected) in language_tables.ROWS.items() if expected not in (True, ["error"])]
# What a language has no words for, with what is told.
_UNSAYABLE = {"2.5 file, allow_substs as text": "in Python this is True or False, no substitution"}


def _place(folder: Path) -> dict[str, str]:
    """Make what the rows look for; return the environment to find it in."""
    (folder / "p.yaml").write_text("/**: {ros__parameters: {from_file: $(var a)}}", "utf-8")
    (folder / "inner.launch.yaml").write_text(WRITERS["yaml"](language_tables._INNER), "utf-8")
    return {**grammar._place(folder), "OUTSIDE": "outer", "PATHS": "/a"}


def _write(folder: Path, text: str, ending: str = "yaml") -> Path:
    path = folder / f"a.launch.{ending}"
    path.write_text(text, "utf-8")
    return path


@pytest.mark.parametrize("row", [row for row in _SOUND if row not in _UNSAYABLE])
def test_a_row_of_the_language_says_the_same_there_and_back(row: str, tmp_path: Path) -> None:
    environment = _place(tmp_path)
    round_trip(_write(tmp_path, WRITERS["yaml"](language_tables.ROWS[row][0])), environment)


def test_modules_and_scripts_say_the_same_everywhere(tmp_path: Path) -> None:
    (tmp_path / "run.py").touch()
    actions: Actions = [
        {"arg": {"name": "m", "default": "tool"}},
        {"node": {"module": "json.$(var m)", "name": "a", "args": "b c", "warm": False}},
        {"node": {"script": "$(dirname)/run.py", "name": "b", "param": [{"name": "x", "value": 1}]}},
        {"lifecycle_node": {"script": "run.py", "name": "c", "namespace": "n"}},
    ]
    path = _write(tmp_path, WRITERS["yaml"](actions))
    same_everywhere(path, {"PATH": "/bin"})
    round_trip(path, {"PATH": "/bin"}, rounds=2)


@pytest.mark.parametrize("row", _UNSAYABLE)
def test_what_python_cannot_say_is_told(row: str, tmp_path: Path) -> None:
    environment = _place(tmp_path)
    path = _write(tmp_path, WRITERS["yaml"](language_tables.ROWS[row][0]))
    found = convert(str(path), "python", environment)
    assert [remark.message for remark in found.remarks] == [_UNSAYABLE[row]]
    assert found.text is None


_LOOPS = ("for", "for_each")


@pytest.mark.parametrize("name", _LOOPS)
def test_a_loop_is_converted_where_it_is_no_function(name: str, tmp_path: Path) -> None:
    environment = _place(tmp_path)
    path = _write(tmp_path, WRITERS["yaml"]([{name: language_tables._NEEDED[name]}]))
    (remark,) = convert(str(path), "python", environment).remarks
    assert remark.message == f"in Python `{name}` takes a function"
    back = convert(str(turned(path, "xml", environment)), "yaml", environment)
    assert back.remarks == ()


def test_every_action_with_a_condition_says_the_same_everywhere(tmp_path: Path) -> None:
    actions: Actions = [
        {name: {**keys, condition: "$(var x false)"}}
        for name, keys in language_tables._NEEDED.items()
        for condition in ("if", "unless")
        if name not in _LOOPS
    ]
    same_everywhere(_write(tmp_path, WRITERS["yaml"](actions)), _place(tmp_path))


def test_every_substitution_says_the_same_everywhere(tmp_path: Path) -> None:
    texts = [text for text, expected in grammar.ROWS.values() if expected is not None]
    texts += [probe["in"] for probe in _probes("subst") if "out" in probe and _is_read(tmp_path, probe["in"])]
    actions: Actions = [{"log": {"message": text}} for text in texts]
    same_everywhere(_write(tmp_path, WRITERS["yaml"]([*grammar._SET, *actions])), _place(tmp_path))


def _is_read(folder: Path, text: str) -> bool:
    problems = Problems()
    load(str(_write(folder, WRITERS["yaml"]([{"log": {"message": text}}]))), problems)
    return not problems.errors


def _probes(kind: str) -> list[dict[str, Any]]:
    probes = map(json.loads, _PROBES.read_text("utf-8").splitlines())
    return [probe for probe in probes if probe["k"] == kind]


def _values(language: str) -> Iterator[tuple[dict[str, str], Any]]:
    """Yield the keys of parameters as they are written, with the value that each has."""
    for text, expected in parameters.PLAIN.items():
        yield {"value": text}, expected[language == "yaml"] if isinstance(expected, list) else expected
    for (word, text), expected in parameters.TYPED.items():
        if (language, word) != ("yaml", "yaml"):
            written = text if language == "xml" else "'" + text.replace("'", "''") + "'"
            yield {"value": written, "type": word}, expected


@pytest.mark.parametrize("language", ["xml", "yaml"])
def test_every_value_of_a_parameter_has_its_type_everywhere(language: str, tmp_path: Path) -> None:
    sound = []
    for keys, expected in _values(language):
        if expected is not parameters._ERROR:
            sound.append(keys)
    path = _write(tmp_path, _node(language, sound), language)
    same_everywhere(path, {"PATH": "/bin"})


def _node(language: str, params: list[dict[str, str]]) -> str:
    """Return a launch file with a node that has a parameter for each of the values."""
    if language == "xml":
        lines = [
            f'<param name="p{index}" {" ".join(f"""{key}="{attribute(text)}" """ for key, text in keys.items())}/>'
            for index, keys in enumerate(params)
        ]
        inside = "".join(lines)
        return f'<launch><let name="x" value="7"/><let name="l" value="[1, 2]"/><node exec="e" name="n">{inside}</node></launch>'
    lines = [
        f"    - name: p{index}\n" + "".join(f"      {key}: {text}\n" for key, text in keys.items())
        for index, keys in enumerate(params)
    ]
    head = "launch:\n- let: {name: x, value: 7}\n- let: {name: l, value: '[1, 2]'}\n"
    return f"{head}- node:\n    exec: e\n    name: n\n    param:\n{''.join(lines)}"


@pytest.mark.long
@pytest.mark.timeout(1_200)
@pytest.mark.parametrize("kind", ["xml", "yaml"])
def test_what_upstream_was_recorded_to_accept_says_the_same_everywhere(kind: str, tmp_path: Path) -> None:
    environment = _place(tmp_path)
    for probe in _probes(kind):
        text = f"launch:\n{probe['in']}\n" if kind == "yaml" else probe["in"]
        path = _write(tmp_path, text, kind)
        problems = Problems()
        load(str(path), problems)
        if not problems.errors and "value: []" not in text:
            same_everywhere(path, environment)


@pytest.mark.parametrize("name", ["log_dir", "launch_log_dir"])
def test_a_substitution_keeps_the_name_that_was_written(name: str) -> None:
    problems = Problems()
    parsed = parse_template(f"echo $({name})/x", lambda *_: point("a.launch.yaml"), problems)
    assert (
        written(Template(parsed.parts, "", parsed.span)) == f"echo $({name})/x"
    )  # put together, not as it stood
    assert normal(parsed) == ("echo ", ("launch_log_dir",), "/x")
