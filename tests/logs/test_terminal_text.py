from __future__ import annotations

import pytest

from orchestra.logs.terminal_text import coloured, for_screen, harmless, plain, wants_colour


def shown_of(text: str) -> str:
    data = text.encode("utf-8", "surrogateescape")
    return for_screen(data, clean=harmless(plain(data))).decode()


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("plain\n", "plain\n"),
        ("10 %\r50 %\r100 %\n", "100 %\n"),
        ("windows\r\n", "windows\n"),
        ("\x1b[31mred\ntwo\n", "\x1b[31mred\x1b[0m\ntwo\n"),
        ("one\n\x1b[1mbold", "one\n\x1b[1mbold\x1b[0m"),
    ],
)
def test_what_stands_behind_a_prefix(text: str, shown: str) -> None:
    assert shown_of(text) == shown


def test_styles_go_and_the_text_stays() -> None:
    assert plain(b"\x1b[1;38:5:9mbold\x1b[0m and \x1b[2K") == b"bold and \x1b[2K"
    assert plain(coloured("name", 3).encode()) == b"name"
    assert coloured("name", 0) != coloured("name", 1)


@pytest.mark.parametrize(
    ("asked", "terminal", "environment", "colour"),
    [
        (None, True, {}, True),
        (None, False, {}, False),
        (None, True, {"TERM": "dumb"}, False),
        (None, True, {"NO_COLOR": "1"}, False),
        (None, True, {"NO_COLOR": ""}, True),
        (None, False, {"FORCE_COLOR": "1"}, True),
        (None, True, {"FORCE_COLOR": "0"}, False),
        (None, False, {"FORCE_COLOR": "1", "NO_COLOR": "1"}, False),
        (True, False, {"NO_COLOR": "1"}, True),
        (False, True, {"FORCE_COLOR": "1"}, False),
    ],
)
def test_who_decides_about_colour(
    asked: bool | None, terminal: bool, environment: dict[str, str], colour: bool
) -> None:
    assert wants_colour(asked=asked, terminal=terminal, environment=environment) is colour


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a\x1b[2Kb\x1b[1;1Hc", "abc"),
        ("\x1b]0;title\x07x", "x"),
        ("\x1b]8;;http://x\x1b\\link\x1b]8;;\x1b\\", "link"),
        ("\x1bc\x1b(0x", "x"),
        ("\x00\x07\x0e\x7f\x9b\udcff", "??????"),
        ("\x1b[31mred\x1b[K", "\x1b[31mred\x1b[0m"),
        ("tab\tstays", "tab\tstays"),
        ("x\x1b[", "x"),
    ],
)
def test_what_would_change_the_terminal_is_left_out(text: str, shown: str) -> None:
    assert shown_of(text) == shown
