"""Writes the table of codes into `docs/checking.md`."""

from __future__ import annotations

from tests.mistakes.codes import PAGE, with_table

PAGE.write_text(with_table(PAGE.read_text("utf-8")), "utf-8")
