"""Which comments silence, and for which lines."""

from __future__ import annotations

import pytest

from orchestra.settings.comments import ignores


def _found(text: str, file: str) -> list[tuple[list[int], list[str] | None]]:
    return [
        (sorted(item.lines), None if item.codes is None else [code for code, _ in item.codes])
        for item in ignores(text, file)
    ]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("a: 1  # orchestra: ignore[ORC013]\n", [([1], ["ORC013"])]),
        ("a: 1  # orchestra: ignore[ORC013, ORC026] because\n", [([1], ["ORC013", "ORC026"])]),
        ("a: 1  #orchestra:ignore\n", [([1], None)]),
        ("# orchestra: ignore\n\n# more\na: 1\n", [([4], None)]),
        ("a: '# orchestra: ignore'\n", []),
        ('a: "x\n  # orchestra: ignore"\n', []),
        ("a: |\n  # orchestra: ignore\nb: 1\n", []),
        ("a: >-  # orchestra: ignore\n  text\n", [([1], None)]),
        ("a: x# orchestra: ignore\n", []),
        ("a: {b: c}  # orchestra: ignored\n", []),
        ("a: [\n  b,  # orchestra: ignore\n]\n", [([2], None)]),
        ("a: 1  # orchestra: ignore[ORC013]\nb: [\n", [([1], ["ORC013"])]),
        ("a: ä  # orchestra: ignore[]\n", [([1], [])]),
    ],
)
def test_yaml(text: str, found: list[object]) -> None:
    assert _found(text, "a.yaml") == found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ('<node pkg="a"/> <!-- orchestra: ignore[ORC030] -->\n', [([1], ["ORC030"])]),
        ('<!-- orchestra: ignore -->\n<node\n  pkg="a>"\n  exec="b"/>\n', [([2, 3, 4], None)]),
        ('<node\n  pkg="a"/> <!-- orchestra: ignore -->\n', [([1, 2], None)]),
        ("<![CDATA[<!-- orchestra: ignore -->]]>\n", []),
        ('<a b="&lt;!-- orchestra: ignore -->"/>\n', []),
    ],
)
def test_xml(text: str, found: list[object]) -> None:
    assert _found(text, "a.launch.xml") == found
    assert _found(text, "a.launch") == found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("x = 1  # orchestra: ignore[ORC030]\n", [([1], ["ORC030"])]),
        ("x = '# orchestra: ignore'\n", []),
        ('x = """\n# orchestra: ignore\n"""\n', []),
        ("x = f(  # orchestra: ignore\n  1,\n)\n", [([1, 2, 3], None)]),
        ("x = f(\n  1,  # orchestra: ignore\n)\n", [([2], None)]),
        ("# orchestra: ignore\nx = f(\n  1,\n)\n", [([2, 3, 4], None)]),
        ("def f():\n    x = 1  # orchestra: ignore\n    return x\n", [([2], None)]),
        ("x = 1  # orchestra: ignore\ny = (\n", [([1], None)]),
    ],
)
def test_python(text: str, found: list[object]) -> None:
    assert _found(text, "a.launch.py") == found


def test_the_span_is_that_of_the_comment() -> None:
    (comment,) = ignores("a: 1  # orchestra: ignore[ORC013, X] why\n", "a.yaml")
    assert (comment.span.column, comment.span.end_column) == (7, 37)
    assert comment.codes is not None
    assert [(code, span.column, span.end_column) for code, span in comment.codes] == [
        ("ORC013", 27, 33),
        ("X", 35, 36),
    ]


def test_other_files_have_none() -> None:
    assert ignores("x = 1  # orchestra: ignore\n", "a.txt") == ()
