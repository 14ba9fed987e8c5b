from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.description.substitutions import SIGNATURES
from orchestra.description.text import Call, Template, Words
from orchestra.description.written import escaped
from orchestra.errors import Code, Problems, Severity
from orchestra.load.grammar import DEEPEST, parse_template, unescaped
from orchestra.load.signatures import usage
from orchestra.location import Span

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.text import Part
    from orchestra.errors import Problem


def _span(start: int, end: int) -> Span:
    return Span("a.launch.yaml", 1, start + 1, 1, end + 1)


def _at(text: str, span: Span | None) -> str:
    assert span is not None
    return text[span.column - 1 : span.end_column - 1]


def _parse(text: str) -> tuple[Template, Problems]:
    problems = Problems()
    return parse_template(text, _span, problems), problems


def _one_error(text: str) -> Problem:
    template, problems = _parse(text)
    assert template.faulty
    (problem,) = problems.errors
    return problem


def _shape(template: Template) -> list[object]:
    """Show literal text as text, a substitution as the list of its name and its arguments' shapes."""
    return [_shape_of_part(part) for part in template.parts]


def _shape_of_part(part: Part) -> object:
    if isinstance(part, Words):
        return part.text
    assert isinstance(part, Call)
    return [part.name, *map(_shape, part.arguments)]


@pytest.mark.parametrize(
    ("text", "shape"),
    [
        ("", []),
        ("plain", ["plain"]),
        ("$var $ $$ $ (var a)", ["$var $ $$ $ (var a)"]),
        ('it\'s "so"', ['it\'s "so"']),
        ("x$(var a)y", ["x", ["var", ["a"]], "y"]),
        ("$(dirname)", [["dirname"]]),
        ("'$(var a)'", ["'", ["var", ["a"]], "'"]),
        (r"\$(var a)", ["$(var a)"]),
        (r"\\$(var a)", ["\\", ["var", ["a"]]]),
        (r"a\nb\\", ["anb\\"]),
        ("a\\", ["a\\"]),
        ("$(var  a   b )", [["var", ["a"], ["b"]]]),
        ("$( var a)", [["var", ["a"]]]),
        ("$(var a\tb)", [["var", ["a\tb"]]]),
        ("$(var a '')", [["var", ["a"], []]]),
        ("$(var 'a b')", [["var", ["a b"]]]),
        ('$(var "it\'s (here)")', [["var", ["it's (here)"]]]),
        (r"$(var it\'s\(x\))", [["var", ["it's(x)"]]]),
        (r"$(var 'it\'s')", [["var", ["it's"]]]),
        (r"$(var 'a\\')", [["var", ["a\\"]]]),
        ("$(var x$y)", [["var", ["x$y"]]]),
        ("$(var $(var a))", [["var", [["var", ["a"]]]]]),
        ("$(var pre-$(var a)/$(var b).x)", [["var", ["pre-", ["var", ["a"]], "/", ["var", ["b"]], ".x"]]]),
        ("$(eval \"'$(var a)' == 'A'\")", [["eval", ["'", ["var", ["a"]], "' == 'A'"]]]),
        ("$(any)", [["any"]]),
        ("$(all a b c d)", [["all", ["a"], ["b"], ["c"], ["d"]]]),
        ("$(var a\n)", [["var", ["a\n"]]]),
        ("$(var ünïcode)", [["var", ["ünïcode"]]]),
    ],
)
def test_a_text_is_read_as_upstream_reads_it(text: str, shape: list[object]) -> None:
    template, problems = _parse(text)
    assert not len(problems)
    assert not template.faulty
    assert _shape(template) == shape


@pytest.mark.parametrize(
    ("text", "code", "at", "suggestion"),
    [
        ("a $(var b", Code.SUBSTITUTION_SYNTAX, "$(var b", "$(var b)"),
        ("a $(var", Code.SUBSTITUTION_SYNTAX, "$(", None),
        ("$(var $(var b) c", Code.SUBSTITUTION_SYNTAX, "$(", None),
        ("$(var 'b) c", Code.SUBSTITUTION_SYNTAX, "'", None),
        ('$(eval "$(var a == b")', Code.SUBSTITUTION_SYNTAX, "$(var a", "$(var a)"),
        ("x $()", Code.SUBSTITUTION_SYNTAX, "$()", None),
        ("$(1var a)", Code.SUBSTITUTION_SYNTAX, "1var", None),
        ("$(var\ta)", Code.SUBSTITUTION_SYNTAX, "var\ta", "var a"),
        ("$(env:HOME)", Code.SUBSTITUTION_SYNTAX, "env:HOME", "env HOME"),
        ("$(get_env=HOME)", Code.SUBSTITUTION_SYNTAX, "get_env=HOME", "env HOME"),
        ("$(a:b)", Code.SUBSTITUTION_SYNTAX, "a:b", None),
        ("$((1 + 2))", Code.SUBSTITUTION_SYNTAX, "(1 + 2)", "eval '1 + 2'"),
        ("$(xacro a b:=c)", Code.UNKNOWN_SUBSTITUTION, "xacro a b:=c", "command 'xacro a b:=c'"),
        ("$(xacro 'a b')", Code.UNKNOWN_SUBSTITUTION, "xacro 'a b'", "command 'xacro \"a b\"'"),
        ("$(shell cat a)", Code.UNKNOWN_SUBSTITUTION, "shell cat a", "command 'cat a'"),
        ("$(shell 'cat a')", Code.UNKNOWN_SUBSTITUTION, "shell", "command"),
        ("$(rospack find a)", Code.UNKNOWN_SUBSTITUTION, "rospack find a", "find-pkg-share a"),
        ("$(ros2 pkg prefix a)", Code.UNKNOWN_SUBSTITUTION, "ros2 pkg prefix a", "find-pkg-prefix a"),
        ("$(hostname)", Code.UNKNOWN_SUBSTITUTION, "hostname", "command 'hostname'"),
        ("$('var' a)", Code.SUBSTITUTION_SYNTAX, "'var'", None),
        ("$(vra a)", Code.UNKNOWN_SUBSTITUTION, "vra", "var"),
        ("$(find_pkg_share a)", Code.UNKNOWN_SUBSTITUTION, "find_pkg_share", "find-pkg-share"),
        ("$(arg a)", Code.UNKNOWN_SUBSTITUTION, "arg", "var"),
        ("$(find a)", Code.UNKNOWN_SUBSTITUTION, "find", "find-pkg-share"),
        ("$(no-such a b)", Code.UNKNOWN_SUBSTITUTION, "no-such", None),
        ("x $(and a) y", Code.SUBSTITUTION_SYNTAX, "$(and a)", None),
        ("$(var)", Code.SUBSTITUTION_SYNTAX, "$(var)", None),
        ("$(dirname a b)", Code.SUBSTITUTION_SYNTAX, "$(dirname a b)", None),
        ("$(find-pkg-share a b)", Code.SUBSTITUTION_SYNTAX, "$(find-pkg-share a b)", None),
        ("$(var a b c)", Code.SUBSTITUTION_SYNTAX, "$(var a b c)", "$(var a 'b c')"),
        ("$(eval 1 + 2)", Code.SUBSTITUTION_SYNTAX, "$(eval 1 + 2)", "$(eval '1 + 2')"),
        (
            "$(eval $(var a) == 'b')",
            Code.SUBSTITUTION_SYNTAX,
            "$(eval $(var a) == 'b')",
            "$(eval \"$(var a) == 'b'\")",
        ),
        ("$(command echo a b)", Code.SUBSTITUTION_SYNTAX, "$(command echo a b)", "$(command 'echo a b')"),
        ("$(var a (x))", Code.SUBSTITUTION_SYNTAX, "(x)", "'(x)'"),
        ("$(eval (1 + 2))", Code.SUBSTITUTION_SYNTAX, "(1 + 2)", "'(1 + 2)'"),
        ("$(var it's)", Code.SUBSTITUTION_SYNTAX, "it's", '"it\'s"'),
        ("$(var 'a'b)", Code.SUBSTITUTION_SYNTAX, "'a'b", None),
        (r"$(var a\ b)", Code.SUBSTITUTION_SYNTAX, r"a\ b", r"'a\ b'"),
        ('$(eval "$(env H "a")")', Code.SUBSTITUTION_SYNTAX, '"a"', None),
    ],
)
def test_a_fault_is_told_at_its_place(text: str, code: Code, at: str, suggestion: str | None) -> None:
    problem = _one_error(text)
    assert (problem.code, _at(text, problem.span), problem.suggestion) == (code, at, suggestion)


@pytest.mark.parametrize(
    ("text", "mended"),
    [
        ("a $(vra b)", "a $(var b)"),
        ("$(eval 1 + 2)", "$(eval '1 + 2')"),
        ("$(var it's)", '$(var "it\'s")'),
        ("$(eval (1 + 2))", "$(eval '(1 + 2)')"),
    ],
)
def test_a_suggestion_put_in_place_of_its_span_mends_the_text(text: str, mended: str) -> None:
    problem = _one_error(text)
    assert problem.span is not None
    assert problem.suggestion is not None
    begin, end = problem.span.column - 1, problem.span.end_column - 1
    assert text[:begin] + problem.suggestion + text[end:] == mended
    assert not _parse(mended)[0].faulty


def test_all_faults_of_a_text_are_told() -> None:
    text = "$(nosuch $(var)) and $(eval 1 + 2) and $(var a"
    _, problems = _parse(text)
    assert [_at(text, problem.span) for problem in problems.ordered] == [
        "nosuch",
        "$(var)",
        "$(eval 1 + 2)",
        "$(var a",
    ]


def test_what_is_sound_in_a_faulty_text_stays_to_be_evaluated() -> None:
    """Evaluating it finds further faults, and marks the variables that it reads."""
    template, _ = _parse("x $(nosuch $(var a) b) $(var c)")
    assert template.faulty
    assert template.constant is None
    assert _shape(template) == ["x ", ["var", ["a"]], " ", ["var", ["c"]]]


@pytest.mark.conforms("3.2 wrong arguments")
def test_a_wrong_number_of_arguments_is_told_with_the_usage() -> None:
    assert _one_error("$(if true)").notes == ("it is written $(if CONDITION VALUE [ELSE])",)


@pytest.mark.parametrize(
    ("name", "written"),
    [
        ("dirname", "$(dirname)"),
        ("var", "$(var NAME [DEFAULT])"),
        ("any", "$(any [VALUE] ...)"),
        ("not-equals", "$(not-equals LEFT RIGHT)"),
    ],
)
def test_the_usage_shows_what_may_be_left_out(name: str, written: str) -> None:
    assert usage(name) == written


def test_quotes_that_do_not_quote_are_told_and_kept_as_upstream() -> None:
    text = "$(eval \"$(if $(var sim) 'a' b) == 'a'\")"
    template, problems = _parse(text)
    (problem,) = problems
    assert not template.faulty
    assert (problem.severity, _at(text, problem.span), problem.suggestion) == (
        Severity.WARNING,
        "'a'",
        r"\'a\'",
    )
    mended = text.replace("'a' b", r"\'a\' b")
    again, none = _parse(mended)
    assert not len(none)
    assert _shape(again) == _shape(template)


def test_arguments_know_where_they_stand_without_their_quotes() -> None:
    text = "x $(var name \"a $(env 'b') c\")"
    template, _ = _parse(text)
    call = template.parts[1]
    assert isinstance(call, Call)
    assert [(argument.raw, _at(text, argument.span), argument.quoted) for argument in call.arguments] == [
        ("name", "name", False),
        ("a $(env 'b') c", "a $(env 'b') c", True),
    ]
    assert _at(text, call.arguments[1].parts[0].span) == "a "
    assert _at(text, call.arguments[1].parts[1].span) == "$(env 'b')"


def test_the_format_says_whether_the_whole_is_quoted() -> None:
    assert parse_template("1", _span, Problems(), quoted=True).quoted
    assert not parse_template("1", _span, Problems()).quoted


def _nested(depth: int) -> str:
    return "$(var " * depth + "a" + ")" * depth


def test_nesting_has_a_limit_that_is_told() -> None:
    assert not _parse(_nested(DEEPEST))[0].faulty
    assert "nested more than" in _one_error(_nested(DEEPEST + 1)).message
    assert "nested more than" in _one_error(_nested(100_000)).message


def test_every_substitution_can_be_written_as_its_usage_says() -> None:
    for name in SIGNATURES:
        written = usage(name).replace("[", "").replace("]", "").replace(" ...", "")
        template, problems = _parse(written)
        assert not len(problems), written
        assert not template.faulty


_TEXTS = st.one_of(
    st.text(),
    st.text(alphabet="$()\\'\" a\t\n"),
    st.lists(
        st.sampled_from(["$(", "$(var ", "$(eval ", ")", "'", '"', " ", "\\", "a", "$(dirname)", "(", "é"])
    ).map("".join),
)


def _parts(template: Template) -> Iterator[tuple[Span, Span]]:
    """Yield every pair of a span and the one around it."""
    for part in template.parts:
        yield part.span, template.span
        if isinstance(part, Call):
            for argument in part.arguments:
                yield argument.span, part.span
                yield from _parts(argument)


@given(_TEXTS)
def test_any_text_is_read_with_every_span_inside_the_one_around_it(text: str) -> None:
    template, problems = _parse(text)
    assert template.faulty == bool(problems.errors)
    assert template.span == _span(0, len(text))
    for inner, outer in _parts(template):
        assert outer.column <= inner.column <= inner.end_column <= outer.end_column
    for problem in problems:
        assert problem.span is not None
        assert 1 <= problem.span.column < problem.span.end_column <= len(text) + 1


@given(_TEXTS)
def test_the_raw_text_of_an_argument_is_what_stands_at_its_span(text: str) -> None:
    def check(template: Template) -> None:
        assert template.raw == _at(text, template.span)
        for part in template.parts:
            if isinstance(part, Call):
                for argument in part.arguments:
                    check(argument)

    check(_parse(text)[0])


@given(_TEXTS, _TEXTS)
def test_any_text_survives_being_escaped(first: str, second: str) -> None:
    template, problems = _parse(escaped(first) + escaped(second))
    assert not len(problems)
    assert template.constant == first + second
    assert unescaped(escaped(first)) == first


@given(_TEXTS.filter(lambda text: "$(" not in text))
def test_a_text_without_substitutions_reads_alike_with_and_without_them(text: str) -> None:
    assert _parse(text)[0].constant == unescaped(text)
