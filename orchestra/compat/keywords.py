"""The keywords that classes of ours take, and the one that was meant by another."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any, Final

from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

_Parameter = inspect.Parameter
_SHORT: Final = 3
# Words of other languages of launch files, of former releases, and what people write for them.
_MEANINGS: Final = {
    "action": ("actions", "target_action"),
    "callback": ("function",),
    "func": ("function",),
    "on_complete": ("on_completion",),
    "args": ("arguments",),
    "command": ("cmd", "command"),
    "cmd_args": ("arguments",),
    "default": ("default_value", "default"),
    "delay": ("period",),
    "destination": ("dst",),
    "env": ("additional_env",),
    "exec": ("executable", "plugin"),
    "executable": ("plugin",),
    "file": ("launch_description_source",),
    "matcher": ("lifecycle_node_matcher", "process_matcher"),
    "message": ("msg",),
    "node": ("target_action", "target_lifecycle_node"),
    "node_executable": ("executable", "plugin"),
    "node_name": ("name",),
    "node_namespace": ("namespace",),
    "node_plugin": ("plugin",),
    "ns": ("namespace",),
    "param": ("parameters",),
    "params": ("parameters",),
    "pkg": ("package",),
    "plugin": ("executable",),
    "remap": ("remappings",),
    "source": ("src",),
    "target": ("target_action", "target_lifecycle_node", "target_container", "dst"),
    "target_action": ("target_lifecycle_node",),
    "target_lifecycle_node": ("target_action",),
    "target_node": ("target_action", "target_lifecycle_node"),
    "text": ("msg",),
    "type": ("executable", "plugin", "value_type"),
}


def keyword_meant(written: str, known: Mapping[str, inspect.Parameter], given: Iterable[str]) -> str | None:
    """Return the keyword that was probably meant: first one that the class cannot be without and that is missing."""
    have = set(given)
    for meaning in _MEANINGS.get(written, ()):
        if meaning in known and meaning not in have:
            return meaning
    longer = [name for name in known if len(written) >= _SHORT and name.startswith(written)]
    if len(longer) == 1:
        return longer[0]
    alike = [name for name in known if name.startswith("on_")] if written.startswith("on_") else []
    if len(alike) == 1:
        return alike[0]
    word = nearest(written, [word for word, meanings in _MEANINGS.items() if known.keys() & set(meanings)])
    missing = [name for name, item in known.items() if item.default is _Parameter.empty and name not in have]
    return (
        nearest(written, known)
        or nearest(written, missing)
        or next((meaning for meaning in _MEANINGS.get(word or "", ()) if meaning in known), None)
        or _only_with(written, known)
    )


def _only_with(word: str, known: Iterable[str]) -> str | None:
    """Return the only keyword of which a word is a part: `container` is one of `target_container`."""
    found = [name for name in known if word in name.split("_") and word != "delay"]
    return found[0] if len(found) == 1 and len(word) >= _SHORT else None


def shown(known: Mapping[str, inspect.Parameter]) -> str:
    """Return the first keywords as they are written."""
    return ", ".join(f"{name}=..." for name in list(known)[:2])


def parameters_of(called: Any) -> Iterator[inspect.Parameter]:
    """Yield what a function or a class takes: with `**kwargs` what the class takes that it derives from, too."""
    if not isinstance(called, type):
        yield from inspect.signature(called).parameters.values()
        return
    seen: set[str] = set()
    for kind in called.__mro__:
        constructor = vars(kind).get("__init__")
        if constructor is None:
            continue
        parameters = list(inspect.signature(constructor).parameters.values())[1:]
        open_ended = any(parameter.kind is _Parameter.VAR_KEYWORD for parameter in parameters)
        for parameter in parameters:
            named = parameter.kind not in (_Parameter.VAR_KEYWORD, _Parameter.VAR_POSITIONAL)
            given = kind is not called and parameter.name in vars(kind).get("_given_by_subclasses", ())
            if named and not given and not parameter.name.startswith("_") and parameter.name not in seen:
                seen.add(parameter.name)
                yield parameter
        yield from (
            _Parameter(key, _Parameter.KEYWORD_ONLY, default=None)
            for key in vars(kind).get("_more_keywords", ())
        )
        if not open_ended:
            return
