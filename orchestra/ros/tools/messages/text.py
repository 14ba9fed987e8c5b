"""Plain data as the text that ROS users know: the YAML of PyYAML, the mapping in the order of the definition.

A message is written straight away, in a tenth of the time that PyYAML takes: a scan of 360 rays at 100 Hz is to be
shown as it comes. Texts that are not plain words, and whatever is to be in flow style, PyYAML writes. Flow style is
that of rosidl_runtime_py's `message_to_yaml`: lists stand in one line, the fields of a message in a line each.
"""

from __future__ import annotations

import re
import sys
from functools import cache, lru_cache
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

# What YAML 1.1 reads as this very text, wherever it stands.
_WORD: Final = re.compile(r"[A-Za-z_/](?:[A-Za-z0-9_/.-]|[ ](?=[A-Za-z0-9_/.]))*", re.ASCII)
_NO_TEXT: Final = frozenset({"null", "true", "false", "yes", "no", "on", "off", "y", "n"})


class _Unwritten(Exception):  # noqa: N818 - no error: somebody else writes it
    """A value that is PyYAML's to write, with all that it stands in."""


def yaml_text(value: Any, *, flow: bool = False) -> str:  # noqa: ANN401 - plain data of any shape
    """Return plain data as YAML, ending with a line break."""
    if not flow and isinstance(value, dict) and value:
        try:
            return "".join(_mapping(value, ""))
        except _Unwritten:
            pass
    import yaml  # noqa: PLC0415 - most messages do without

    text: str = yaml.dump(
        value,
        Dumper=_dumper(),
        allow_unicode=True,
        width=sys.maxsize,
        default_flow_style=flow,
        sort_keys=False,
    )
    return text.removesuffix("...\n") if not isinstance(value, dict | list) else text


@cache
def _dumper() -> Any:  # noqa: ANN401 - a class of PyYAML
    """Return PyYAML's writer, for which a mapping is in one line only where it stands in a list that is."""
    import yaml  # noqa: PLC0415 - as above

    def represented(dumper: Any, data: dict[str, Any]) -> Any:  # noqa: ANN401 - as above
        pairs = [(dumper.represent_data(key), dumper.represent_data(value)) for key, value in data.items()]
        return yaml.MappingNode("tag:yaml.org,2002:map", pairs)

    class Dumper(yaml.SafeDumper):
        pass

    Dumper.add_representer(dict, represented)
    return Dumper


def _mapping(fields: dict[str, Any], indent: str) -> Iterator[str]:
    for name, value in fields.items():
        if not _is_word(name):
            raise _Unwritten  # no name of a field
        yield f"{indent}{name}:"
        if isinstance(value, dict) and value:
            yield "\n"
            yield from _mapping(value, indent + "  ")
        elif isinstance(value, list) and value:
            yield "\n"
            yield from _items(value, indent)
        else:
            yield f" {_scalar(value)}\n"


def _items(items: list[Any], indent: str) -> Iterator[str]:
    if all(type(item) is float or type(item) is int for item in items):
        yield "".join([f"{indent}- {_number(item)}\n" for item in items])
        return
    for item in items:
        if isinstance(item, dict) and item:
            lines = "".join(_mapping(item, indent + "  "))
            yield f"{indent}- {lines[len(indent) + 2 :]}"
        elif isinstance(item, list) and item:
            lines = "".join(_items(item, indent + "  "))
            yield f"{indent}- {lines[len(indent) + 2 :]}"
        else:
            yield f"{indent}- {_scalar(item)}\n"


def _scalar(value: Any) -> str:  # noqa: ANN401 - as above
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return _number(value)
    if isinstance(value, str):
        return value if _is_word(value) else _quoted(value)
    if isinstance(value, dict | list):
        return "{}" if isinstance(value, dict) else "[]"
    raise _Unwritten


def _is_word(text: Any) -> bool:  # noqa: ANN401 - keys of any kind
    return isinstance(text, str) and _WORD.fullmatch(text) is not None and text.lower() not in _NO_TEXT


@lru_cache
def _quoted(text: str) -> str:
    """Return what PyYAML makes of a text; where it may take several lines, they depend on all around it."""
    if not text.isprintable():
        raise _Unwritten
    import yaml  # noqa: PLC0415 - most messages do without

    written: str = yaml.safe_dump(text, allow_unicode=True, width=sys.maxsize)
    return written.removesuffix("\n").removesuffix("\n...")


def _number(value: float) -> str:
    """Return a number as PyYAML writes it, whose floats have a point before their exponent."""
    if value != value:  # noqa: PLR0124 - not a number
        return ".nan"
    if value in (_ENDLESS, -_ENDLESS):
        return ".inf" if value > 0 else "-.inf"
    text = repr(value)
    return text.replace("e", ".0e", 1) if "e" in text and "." not in text else text


_ENDLESS: Final = float("inf")
