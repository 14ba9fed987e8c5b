"""Keywords of actions that start a process."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.extensions import RUNNING
from orchestra.convert.kinds import Kind, kind_of, short_key
from orchestra.convert.python.code import Bracket, Code, Element, a_list, call
from orchestra.convert.remarks import UnsayableError
from orchestra.convert.words import ordered
from orchestra.description.entity import Entity
from orchestra.description.text import Template, Words

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.convert.python.parts import Parts
    from orchestra.description.components import ComposableNode
    from orchestra.description.running import Running

    Write = Callable[[Parts, Any], Code]

_EXTENSIONS: Final = frozenset({*RUNNING, "lifecycle", "params_schema"})


def keywords(action: Running | ComposableNode, parts: Parts) -> Iterator[Element]:
    """Yield the keywords of an action in its own order."""
    for field in ordered(action):
        value = getattr(action, field)
        if value is None or value == ():
            continue
        notes = parts.comments.of(action, field)
        if field in ("if_", "unless"):
            continue
        if field in _EXTENSIONS:
            code, name = _extension(action, field, value, parts), field
        else:
            name = _NAMES.get(field, field)
            code = _WRITERS.get(field, _text)(parts, value)
        yield Element(code, f"{name}=", notes)
    yield from parts.condition(action)


def _extension(action: Entity, field: str, value: Any, parts: Parts) -> Code:  # noqa: ANN401 - a part of a description, whatever it is
    model = type(action)
    if isinstance(value, Entity):
        return parts.keyed(value, short_key(model, field))
    return parts.extension(value, kind_of(model, field))


def _text(parts: Parts, template: Template) -> Code:
    return parts.texts.of(template)


def _prefix(parts: Parts, prefix: Template | tuple[Template, ...]) -> Code:
    """Return a command as one text: Python takes no list. Raises `UnsayableError` for one with substitutions."""
    if isinstance(prefix, Template):
        return parts.texts.of(prefix)
    words = [word.constant for word in prefix]
    known = [word for word in words if word is not None]
    if len(known) < len(words):
        raise UnsayableError("in Python a prefix is split into words when it is known", prefix[0].span)
    text = shlex.join(known)
    return parts.texts.of(Template((Words(text, prefix[0].span),), "", prefix[0].span))


def _output(parts: Parts, output: Template | dict[str, tuple[Template, ...]]) -> Code:
    if isinstance(output, Template):
        return parts.texts.of(output)
    return parts.extension(output, Kind.WORD)


def _ending(parts: Parts, word: Template) -> Code:
    if word.constant is None:
        raise UnsayableError("in Python it is fixed what is done at an exit", word.span)
    return call(parts.texts.name("Shutdown"), ())


def _component(parts: Parts, component: ComposableNode) -> Code:
    name = "ComposableNode" if component.autostart is None else "ComposableLifecycleNode"
    return call(parts.texts.name(name), keywords(component, parts))


def components(parts: Parts, components: tuple[ComposableNode, ...]) -> Code:
    """Return a list of components."""
    elements = (Element(_component(parts, item), "", parts.comments.of(item)) for item in components)
    return Bracket("[", tuple(elements), "]")


def _extra(parts: Parts, params: Any) -> Code:  # noqa: ANN401 - a part of a description, whatever it is
    return a_list(parts.dictionaries(params, quotes=False))


_NAMES: Final = {
    "args": "arguments",
    "composable_node": "composable_node_descriptions",
    "env": "additional_env",
    "env_only": "env",
    "exec": "executable",
    "extra_arg": "extra_arguments",
    "launch_prefix": "prefix",
    "param": "parameters",
    "pkg": "package",
    "remap": "remappings",
    "ros_args": "ros_arguments",
}
_WRITERS: Final[dict[str, Write]] = {
    "args": lambda parts, value: parts.words(value),
    "autostart": lambda parts, value: parts.flag(value),
    "cmd": lambda parts, value: parts.words(value),
    "composable_node": components,
    "emulate_tty": lambda parts, value: parts.flag(value),
    "env": lambda parts, value: parts.pairs(value),
    "env_only": lambda parts, value: parts.pairs(value),
    "extra_arg": _extra,
    "launch_prefix": _prefix,
    "on_exit": _ending,
    "output": _output,
    "param": lambda parts, value: parts.parameters(value),
    "remap": lambda parts, value: parts.rules(value),
    "respawn": lambda parts, value: parts.flag(value),
    "respawn_delay": lambda parts, value: parts.plain(value),
    "respawn_max_retries": lambda parts, value: parts.plain(value),
    "ros_args": lambda parts, value: parts.words(value),
    "shell": lambda parts, value: parts.flag(value),
    "sigkill_timeout": _text,
    "sigterm_timeout": _text,
}
