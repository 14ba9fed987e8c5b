"""Every row of the tables of the substitution grammar does what it says, in YAML and in XML (the reference's chapter 3).

The rows that were recorded from upstream are in `test_recorded_texts`.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.description.substitutions import SIGNATURES
from tests.conformance.marks import conforming
from tests.load.planning import installed, planned
from tests.load.written import WRITERS, Actions

if TYPE_CHECKING:
    from pathlib import Path

both = pytest.mark.parametrize("language", sorted(WRITERS))
_SET: Actions = [
    {"let": {"name": "a", "value": "A"}},
    {"let": {"name": "A", "value": "of A"}},
    {"let": {"name": "a\tb", "value": "tabbed"}},
    {"set_parameter": {"name": "rate", "value": 5}},
]

# Text -> what it comes to, None for an error.
ROWS: dict[str, tuple[str, str | None]] = {
    "3.1 1, text and substitutions in turn": ("x $(var a) y$(var a)", "x A yA"),
    "3.1 2, a name begins with a letter": ("$(1var a)", None),
    "3.1 2, a name is not empty": ("$()", None),
    "3.1 2, hyphens and underscores in a name": ("$(not-equals a b)", "true"),
    "3.1 3, one space": ("$(var a)", "A"),
    "3.1 3, any run of spaces": ("$(  var   a  )", "A"),
    "3.1 4, a dollar alone": ("$var $$ $ (var a) $", "$var $$ $ (var a) $"),
    "3.1 5, a backslash before a substitution": (r"\$(var a)", "$(var a)"),
    "3.1 5, a backslash before a letter": (r"a\nb", "anb"),
    "3.1 5, a backslash before a backslash": (r"\\", "\\"),
    "3.1 5, a backslash at the end of a line": ("a\\\nb\\\\\nc", "a\\\nb\\\nc"),
    "3.1 5, one in a quoted argument": ("$(var none 'a \\\n b')", "a \\\n b"),
    "3.1 6, quotes outside are text": ("'$(var a)' \"b\"", "'A' \"b\""),
    "3.1 7, a quoted argument": ("$(var none 'a $(var a)  c')", "a A  c"),
    "3.1 7, in the other quotes": ('$(var none "it\'s")', "it's"),
    "3.1 8, adjoining pieces": ("$(var none x-$(var a)/$(var a).y)", "x-A/A.y"),
    "3.1 8, escaped parentheses": (r"$(var none \(x\))", "(x)"),
    "3.1 8, bare parentheses": ("$(var none (x))", None),
    "3.1 8, an escaped quote": (r"$(var none it\'s)", "it's"),
    "3.1 9, an escaped space does not join": (r"$(var none a\ b)", None),
    "3.1 10, nested": ("$(var $(var $(var none a)))", "of A"),
    "3.1 10, nested in quotes": ("$(eval \"'$(var a)' == 'A'\")", "True"),
    "3.1 11, an empty argument": ("$(env NOPE '')", ""),
    "3.1 12, a tab in an argument": ("$(var a\tb)", "tabbed"),
    "3.1 12, a line break beside": ("a\n$(var a)", "a\nA"),
    "3.1 13, nothing": ("", ""),
    "3.1 14, what the format quotes": ("<&>\"' $(var none '<&>\"')", '<&>"\' <&>"'),
    "3.1 15, an unknown name": ("$(if false $(nosuch x) a)", None),
    "3.1 15, too few arguments": ("$(var)", None),
    "3.1 15, too many arguments": ("$(var a b c)", None),
    "3.2 var": ("$(var a)", "A"),
    "3.2 var, default": ("$(var none d)", "d"),
    "3.2 var, unset": ("$(var none)", None),
    "3.2 env": ("$(env HERE)", "here"),
    "3.2 env, default": ("$(env NOPE d)", "d"),
    "3.2 env, unset": ("$(env NOPE)", None),
    "3.2 eval": ("$(eval '2 * 3')", "6"),
    "3.2 eval, math": ("$(eval 'floor(2.5)')", "2"),
    "3.2 eval, modules": ("$(eval 'sys.maxsize' 'sys')", str(sys.maxsize)),
    "3.2 eval, modules replace math": ("$(eval 'math.pi' '')", None),
    "3.2 eval, failing": ("$(eval '1/0')", None),
    "3.2 dirname": ("$(dirname)", "{folder}"),
    "3.2 filename": ("$(filename)", "{folder}/a.launch"),
    "3.2 find-pkg-share": ("$(find-pkg-share demo)", "{folder}/prefix/share/demo"),
    "3.2 find-pkg-prefix": ("$(find-pkg-prefix demo)", "{folder}/prefix"),
    "3.2 exec-in-pkg": ("$(exec-in-pkg tool demo)", "{folder}/prefix/lib/demo/tool"),
    "3.2 exec-in-pkg, absent": ("$(exec-in-pkg nope demo)", None),
    "3.2 find-exec": ("$(find-exec found)", "{folder}/bin/found"),
    "3.2 find-exec, absent": ("$(find-exec nosuchthing)", None),
    "3.2 command": ("$(command 'echo a  b')", "a b"),
    "3.2 command, failing": ("$(command 'false')", None),
    "3.2 command, with errors": ("$(command 'sh -c \"echo a >&2; echo b\"' ignore)", "b"),
    "3.2 command, capturing": ("$(command 'sh -c \"echo a >&2\"' capture)", "a"),
    "3.2 param": ("$(param rate)", "5"),
    "3.2 param, default": ("$(param none d)", "d"),
    "3.2 param, unset": ("$(param none)", None),
    "3.2 file-content": ("$(file-content $(dirname)/some.txt)", "content"),
    "3.2 file-content, absent": ("$(file-content /nope)", None),
    "3.2 not": ("$(not off)", "true"),
    "3.2 not, of no boolean": ("$(not maybe)", None),
    "3.2 and": ("$(and yes 1)", "true"),
    "3.2 and, of one": ("$(and true)", None),
    "3.2 and, or": ("$(or no 0)", "false"),
    "3.2 and, or of three": ("$(or no 0 1)", None),
    "3.2 any": ("$(any false no 1)", "true"),
    "3.2 any, of none": ("$(any)", "false"),
    "3.2 any, of one": ("$(any off)", "false"),
    "3.2 any, all": ("$(all true yes 1)", "true"),
    "3.2 any, all of none": ("$(all)", "true"),
    "3.2 any, all false": ("$(all true no 1)", "false"),
    "3.2 equals": ("$(equals 1 1.0)", "true"),
    "3.2 equals, not-equals": ("$(not-equals $(var a) A)", "false"),
    "3.2 if": ("$(if $(not false) 'a b' c)", "a b"),
    "3.2 if, without else": ("$(if false x)", ""),
}


def _place(folder: Path) -> dict[str, str]:
    """Make what the rows look for; return the environment to find it in."""
    environment = installed(folder)
    (folder / "bin").mkdir(exist_ok=True)
    (folder / "bin/found").touch(0o755)
    (folder / "some.txt").write_text("content")
    return {**environment, "PATH": f"{folder}/bin:{environment['PATH']}", "HERE": "here"}


@pytest.mark.conforms("D9", "D12")
@both
@pytest.mark.parametrize("row", conforming(ROWS))
def test_a_row_does_what_it_says(row: str, language: str, tmp_path: Path) -> None:
    text, expected = ROWS[row]
    plan = planned(tmp_path, language, [*_SET, {"log": {"message": text}}], _place(tmp_path))
    assert plan.failed is (expected is None), plan.problems
    if expected is not None:
        assert plan.messages == [expected.replace("{folder}", str(tmp_path))]


@pytest.mark.conforms("3.2 log_dir")
@both
@pytest.mark.parametrize("name", ["log_dir", "launch_log_dir"])
def test_the_log_folder_is_one_of_the_run(name: str, language: str, tmp_path: Path) -> None:
    (message,) = planned(tmp_path, language, [{"log": {"message": f"$({name})"}}], {}).messages
    assert message.startswith("${run}")


@pytest.mark.conforms("3.2 anon", "D56")
@both
def test_a_name_made_unique_is_the_same_again_and_in_every_plan(language: str, tmp_path: Path) -> None:
    actions = [{"log": {"message": "$(anon a) $(anon a) $(anon b)"}}]
    messages = [planned(tmp_path, language, actions, {}).messages for _ in range(2)]
    assert messages[0] == messages[1]
    first, again, other = messages[0][0].split()
    assert first == again != other


@pytest.mark.conforms("3.2 names")
def test_every_substitution_has_its_rows() -> None:
    tested = {word for row in ROWS for word in row.removeprefix("3.2 ").split(", ")}
    tested |= {"anon", "log_dir", "launch_log_dir"}
    later = {"path-join", "string-join"}  # in `test_recorded_texts`
    later |= {"for-var", "index"}  # in `resolve/test_loops`
    later |= {"yaml-value"}  # no row: upstream has no such substitution
    assert set(SIGNATURES) <= tested | later
