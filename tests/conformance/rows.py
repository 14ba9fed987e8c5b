"""The rows of the launch language and the deliberate differences from it, as `docs/compatibility.toml` has them."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "docs" / "compatibility.toml"


@dataclass(frozen=True, slots=True)
class Row:
    """What upstream has; `differs` names differences, `absent` says why Orchestra does not have it."""

    name: str
    says: str
    differs: tuple[str, ...] = ()
    absent: str = ""


@dataclass(frozen=True, slots=True)
class Difference:
    """What Orchestra does otherwise, and why."""

    upstream: str
    here: str
    why: str


@dataclass(frozen=True, slots=True)
class Section:
    """A table of the language."""

    number: str
    title: str
    rows: tuple[Row, ...]

    def identity(self, row: Row) -> str:
        """Return the name by which tests mark a row."""
        return f"{self.number} {row.name}"


@dataclass(frozen=True, slots=True)
class Language:
    """All tables, and all differences by their names."""

    sections: tuple[Section, ...]
    differences: dict[str, Difference]

    @property
    def identities(self) -> list[str]:
        """What tests can mark."""
        return [
            *(section.identity(row) for section in self.sections for row in section.rows),
            *self.differences,
        ]


def read_language() -> Language:
    """Return what the source says."""
    content = tomllib.loads(SOURCE.read_text("utf-8"))
    differences = {name: Difference(**fields) for name, fields in content.pop("differences").items()}
    return Language(tuple(_section(number, table) for number, table in content.items()), differences)


def _section(number: str, table: dict[str, Any]) -> Section:
    return Section(number, table["title"], tuple(_row(name, value) for name, value in table["rows"].items()))


def _row(name: str, value: Any) -> Row:
    if isinstance(value, str):
        return Row(name, value)
    return Row(name, value["is"], tuple(value.get("differs", ())), value.get("absent", ""))
