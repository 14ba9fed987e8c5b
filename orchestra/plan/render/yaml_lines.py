"""The YAML text of JSON data, as PyYAML writes it in blocks, at a twentieth of its price.

What is plain in every place is written here, and by PyYAML what may need quotes or more than a line: a plan of a
thousand nodes took it six seconds.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, Final

from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Callable

_WIDTH: Final = 110
_LONGEST_KEY: Final = 100  # longer ones may be written in another form
_FOLDED: Final = ("\x85", "\u2028", "\u2029", "\ufeff")
# What means nothing to YAML between keys and items that stand below each other: no blanks, no colon at the end.
_PLAIN: Final = pattern(r"(?:[A-Za-z_/$]|--?[A-Za-z])(?:[A-Za-z0-9_/.:=+@%~${},-]*[A-Za-z0-9_/.=+@%~${},-])?")
_WORDS: Final = frozenset(
    {"yes", "no", "on", "off", "true", "false", "null"}
)  # that are no texts, in any case


def document(data: dict[str, Any]) -> str:
    """Return the document of a mapping of texts to JSON data, in its order."""
    return f"{_Blocks().mapping(data, 0)}\n" if data else "{}\n"


class _Blocks:
    """Writes what begins in a column, whose first line stands behind something; odd texts are written once."""

    def __init__(self) -> None:
        self._plain: dict[str, bool] = {}
        self._odd: dict[tuple[str | None, str, int], str] = {}

    def mapping(self, data: dict[str, Any], column: int) -> str:
        """Return a mapping that is not empty."""
        lines = []
        for key, value in data.items():
            if len(key) > _LONGEST_KEY or not self._is_plain(key):
                lines.append(_dumped({key: value}, column))
            elif type(value) is str and not self._is_plain(value):
                lines.append(self._by_key(key, value, column))
            elif value and type(value) is dict:
                inner = column + 2
                lines.append(f"{key}:\n{inner * ' '}{self.mapping(value, inner)}")
            elif value and type(value) is list:
                lines.append(f"{key}:\n{column * ' '}{self._items(value, column)}")
            else:
                lines.append(f"{key}: {value if type(value) is str else _short(value)}")
        return f"\n{column * ' '}".join(lines)

    def _items(self, data: list[Any], column: int) -> str:
        """Return a list that is not empty."""
        inner = column + 2
        lines = []
        for value in data:
            if type(value) is str:
                lines.append(f"- {value}" if self._is_plain(value) else self._by_key(None, value, column))
            elif value and type(value) is dict:
                lines.append(f"- {self.mapping(value, inner)}")
            elif value and type(value) is list:
                lines.append(f"- {self._items(value, inner)}")
            else:
                lines.append(f"- {_short(value)}")
        return f"\n{column * ' '}".join(lines)

    def _is_plain(self, text: str) -> bool:
        known = self._plain.get(text)
        if known is None:
            known = _PLAIN.fullmatch(text) is not None and text.lower() not in _WORDS
            self._plain[text] = known
        return known

    def _by_key(self, key: str | None, text: str, column: int) -> str:
        """Return the entry of a mapping, or the item of a list where there is no key."""
        known = (key, text, column)
        if known not in self._odd:
            self._odd[known] = _dumped([text] if key is None else {key: text}, column)
        return self._odd[known]


def _short(value: Any) -> str:  # noqa: ANN401 - JSON data that is no text, and has nothing in it
    if value is None:
        return "null"
    kind = type(value)
    if kind is bool:
        return "true" if value else "false"
    if kind is int:
        return str(value)
    if kind is float:
        return _dumped([value], 0)[2:]
    return "{}" if kind is dict else "[]"


def _dumped(data: Any, column: int) -> str:  # noqa: ANN401 - JSON data
    """Return what PyYAML writes of data that begins in a column."""
    write = _library()
    first, *more = write(data, _WIDTH - column).removesuffix("\n").split("\n")
    return "\n".join([first, *(f"{column * ' '}{line}" if line else "" for line in more)])


@cache
def _library() -> Callable[[Any, int], str]:
    """Return what writes data in lines of some width."""
    import yaml  # noqa: PLC0415 - it takes time to import, and may not be needed

    class Dumper(yaml.SafeDumper):
        """Writes texts with other line breaks than a line feed in double quotes: elsewhere YAML folds them."""

        def represent_str(self, data: str) -> yaml.ScalarNode:
            style = '"' if any(mark in data for mark in _FOLDED) else None
            return self.represent_scalar("tag:yaml.org,2002:str", data, style)

    Dumper.add_representer(str, Dumper.represent_str)

    def write(data: Any, width: int) -> str:  # noqa: ANN401 - JSON data
        text: str = yaml.dump(data, Dumper=Dumper, allow_unicode=True, sort_keys=False, width=width)
        return text

    return write
