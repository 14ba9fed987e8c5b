"""What the interpreter tells of."""

from __future__ import annotations

from typing import Any

from orchestra.witness.unknowable import sifted


def test_what_turns_out_to_be_harmless_is_handed_on_no_more() -> None:
    heard: list[tuple[str, tuple[Any, ...]]] = []
    harmless: set[str] = set()
    hook = sifted(lambda event, args: heard.append((event, args)), harmless)
    hook("open", ("file",))
    hook("compile", ())
    harmless.add("compile")
    hook("compile", ())
    hook("open", ("other",))
    assert heard == [("open", ("file",)), ("compile", ()), ("open", ("other",))]
