"""One description as data, written in YAML and in XML."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping

Actions = list[dict[str, Any]]

_ESCAPES = {'"': "&quot;", "\n": "&#10;", "\t": "&#9;", "\r": "&#13;"}
_SEPARATORS = (",", ";", ", ", "|", " and ", "\ue000")
# Where a text that stands in quotes in YAML is one, whatever it looks like; in a list of any parameter too.
_TEXTS = {"param", "parameter"}
_LISTS_OF_TEXTS = {"param", "parameter", "set_parameter"}


def as_yaml(actions: Actions) -> str:
    """Return a launch file in YAML, in the flow style that JSON shares with it."""
    return json.dumps({"launch": actions}, ensure_ascii=False)


def as_xml(actions: Actions) -> str:
    """Return the same launch file in XML."""
    return f"<launch>{''.join(_actions(actions))}</launch>"


WRITERS: Mapping[str, Callable[[Actions], str]] = {"xml": as_xml, "yaml": as_yaml}


def attribute(text: str) -> str:
    """Return a text as it stands between the double quotes of an attribute."""
    return escape(text, _ESCAPES)


def _actions(actions: Actions) -> Iterator[str]:
    for action in actions:
        for name, content in action.items():
            yield _element(name, content or {})


def _element(name: str, content: Mapping[str, Any]) -> str:
    attributes: list[str] = []
    inside: list[str] = []
    for key, value in content.items():
        if key == "children":
            inside += _actions(value)
        elif isinstance(value, dict):
            inside.append(_element(key, value))
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            inside += [_element(key, item) for item in value]
        elif value != []:
            quoting = _LISTS_OF_TEXTS if isinstance(value, list) else _TEXTS
            typed = name in quoting and key == "value" and "type" not in content
            attributes += _attributes(key, value, typed=typed)
    start = " ".join((name, *attributes))
    return f"<{start}>{''.join(inside)}</{name}>" if inside else f"<{start}/>"


def _attributes(key: str, value: Any, *, typed: bool) -> Iterator[str]:
    if not isinstance(value, list):
        yield f'{key}="{attribute(_text(value, typed=typed))}"'
        return
    texts = [_text(item, typed=typed) for item in value]
    separator = _separator(texts)
    yield f'{key}="{attribute(separator.join(texts))}"'
    yield f'{key}-sep="{attribute(separator)}"'


def _separator(texts: Iterable[str]) -> str:
    return next(one for one in _SEPARATORS if not any(one in text for text in texts))


def _text(value: Any, *, typed: bool) -> str:
    """Return a scalar as text; a string that would look like something else in quotes of its own."""
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'" if typed and "$(" not in value else value
    return json.dumps(value)
