"""Settings files: `orchestra.toml`, or the table `tool.orchestra` of `pyproject.toml`."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Final

from orchestra.errors import Code, Problems
from orchestra.fields import replace
from orchestra.location import Span, displayed, point
from orchestra.nearest import nearest
from orchestra.settings.model import LEVELS, Override, Settings, code_meant

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.settings.toml_places import Path, Place

OWN, SHARED = "orchestra.toml", "pyproject.toml"
_TABLE: Final = ("tool", "orchestra")
_KEYS: Final = ("severity", "overrides", "strict", "exclude")


def read(path: str, problems: Problems) -> Settings | None:
    """Return the settings in a file, None where it has none. What is wrong with them is reported."""
    file = displayed(path)
    try:
        with open(path, encoding="utf-8") as stream:  # noqa: PTH123 - pathlib is slow
            text = stream.read()
    except (OSError, UnicodeDecodeError) as error:
        problems.error(Code.UNREADABLE_FILE, f"cannot read the settings in {file}: {error}", point(file))
        return None
    shared = os.path.basename(path) == SHARED  # noqa: PTH119 - pathlib is slow
    if shared and "orchestra" not in text:
        return None
    # Here, because hardly any folder has settings.
    import tomllib  # noqa: PLC0415

    from orchestra.settings import toml_places  # noqa: PLC0415

    text = text.replace("\r\n", "\n")
    try:
        content: Any = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        reason, span = toml_places.fault(error, text, file)
        problems.error(Code.SYNTAX, f"this is not TOML: {reason}", span)
        return None
    way: Path = ()
    for name in _TABLE if shared else ():
        content, way = content.get(name) if isinstance(content, dict) else None, (*way, name)
    if content is None:
        return None
    reader = _Reader(problems, toml_places.places(text, file), point(file))
    return reader.settings(content, way, os.path.dirname(os.path.abspath(path)))  # noqa: PTH120, PTH100 - pathlib is slow


class _Reader:
    """Reads one file; what is wrong is reported and left out."""

    def __init__(self, problems: Problems, places: dict[Path, Place], file: Span) -> None:
        self.problems = problems
        self.places = places
        self.file = file

    def settings(self, content: object, way: Path, folder: str) -> Settings | None:
        if not isinstance(content, dict):
            self._wrong("a table", content, way)
            return None
        self._known(content, _KEYS, way)
        return Settings(
            folder=folder,
            severity=self._severities(content.get("severity", {}), (*way, "severity")),
            overrides=tuple(
                Override(
                    self._texts(item.get("files", []), (*inner, "files")),
                    self._severities(item.get("severity", {}), (*inner, "severity")),
                )
                for inner, item in self._overrides(content.get("overrides", []), (*way, "overrides"))
            ),
            strict=self._flag(content.get("strict", False), (*way, "strict")),
            exclude=self._texts(content.get("exclude", []), (*way, "exclude")),
        )

    def _overrides(self, items: object, way: Path) -> list[tuple[Path, dict[str, Any]]]:
        if not isinstance(items, list):
            self._wrong("a list of tables", items, way)
            return []
        found = []
        for number, item in enumerate(items):
            inner = (*way, number)
            if not isinstance(item, dict):
                self._wrong("a table", item, inner)
                continue
            self._known(item, ("files", "severity"), inner)
            for name in ("files", "severity"):
                if name not in item:
                    self._error(Code.MISSING_KEY, f"the key '{name}' is missing", self._value(inner))
            found.append((inner, item))
        return found

    def _severities(self, content: object, way: Path) -> dict[str, str]:
        if not isinstance(content, dict):
            self._wrong("a table from codes to severities", content, way)
            return {}
        codes = [code.value for code in Code]
        found = {}
        for code, level in content.items():
            inner = (*way, code)
            if code not in codes:
                meant = code_meant(code)
                self._error(Code.UNKNOWN_KEY, f"there is no code '{code}'", self._key(inner), meant)
            elif not isinstance(level, str):
                self._wrong(f"one of {', '.join(LEVELS)}", level, inner)
            elif level not in LEVELS:
                message = f"expected one of {', '.join(LEVELS)}, found '{level}'"
                span = self._value(inner)
                inside = replace(span, column=span.column + 1, end_column=span.end_column - 1)  # the quotes
                self._error(Code.BAD_VALUE, message, inside, nearest(level, LEVELS))
            else:
                found[code] = level
        return found

    def _texts(self, content: object, way: Path) -> tuple[str, ...]:
        if not isinstance(content, list):
            self._wrong("a list of texts", content, way)
            return ()
        for number, item in enumerate(content):
            if not isinstance(item, str):
                self._wrong("a text", item, (*way, number))
        return tuple(item for item in content if isinstance(item, str))

    def _flag(self, content: object, way: Path) -> bool:
        if not isinstance(content, bool):
            self._wrong("true or false", content, way)
        return content is True

    def _known(self, content: dict[str, Any], names: tuple[str, ...], way: Path) -> None:
        for name in content:
            if name not in names:
                near = nearest(name, names)
                self._error(Code.UNKNOWN_KEY, f"unknown setting '{name}'", self._key((*way, name)), near)

    def _wrong(self, expected: str, found: object, way: Path) -> None:
        message = f"expected {expected}, found {_told(found)}"
        self._error(Code.WRONG_TYPE, message, self._value(way))

    def _error(self, code: Code, message: str, span: Span, suggestion: str | None = None) -> None:
        self.problems.error(code, message, span, suggestion=suggestion)

    def _key(self, way: Path) -> Span:
        return self._place(way, lambda place: place.key)

    def _value(self, way: Path) -> Span:
        return self._place(way, lambda place: place.value)

    def _place(self, way: Path, part: Callable[[Place], Span]) -> Span:
        """Return where something stands, or what is around it: a table that dots have made stands nowhere."""
        while way and way not in self.places:
            way = way[:-1]
        return part(self.places[way]) if way else self.file


def _told(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    kinds = {str: "a text", int: "a number", float: "a number", list: "a list", dict: "a table"}
    return kinds.get(type(value), "a time")
