from __future__ import annotations

import pytest

from orchestra.logs.page import Page


@pytest.mark.parametrize(
    ("pieces", "page"),
    [
        ([("a", "one\n")], "[a] one\n"),
        ([("a", "one\ntwo\n")], "[a] one\n[a] two\n"),
        ([("a", "\n\n")], "[a] \n[a] \n"),
        ([("a", "on"), ("a", "e\ntwo\n")], "[a] one\n[a] two\n"),
        ([("a", "on"), ("b", "one\n"), ("a", "e\n")], "[a] on\n[b] one\n[a] e\n"),
        ([("a", "on"), ("b", "on")], "[a] on\n[b] on"),
        ([("a", "one\n"), ("b", ""), ("a", "two")], "[a] one\n[a] two"),
    ],
)
def test_each_line_has_the_prefix_of_its_source(pieces: list[tuple[str, str]], page: str) -> None:
    composed = Page()
    written = (composed.compose(source, f"[{source}] ".encode(), text.encode()) for source, text in pieces)
    assert b"".join(written).decode() == page


def test_the_end_of_a_page_ends_its_line() -> None:
    page = Page()
    page.compose("a", b"", b"half")
    assert page.end() == b"\n"
    assert page.end() == b""
