"""A glance at a launch file in YAML."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.cli.glance.model import Glance, SeenArgument, SeenInclude
from orchestra.cli.glance.texts import constant_text
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    from orchestra.cli.glance.model import Places

# Only texts, lists and mappings come out of it.
_Loader: Any = getattr(yaml, "CBaseLoader", yaml.BaseLoader)


def glance(text: str, places: Places) -> Glance:
    """Return what the text shows. Raises `ValueError`."""
    try:
        tree = yaml.load(text, _Loader)
    except yaml.YAMLError as error:
        raise ValueError(str(error)) from error
    found = _Found(places)
    found.actions(tree.get("launch") if isinstance(tree, dict) else None, conditional=False)
    return Glance(tuple(found.arguments), tuple(found.includes))


class _Found:
    """Collects what a visit of the actions comes upon."""

    def __init__(self, places: Places) -> None:
        self.arguments: list[SeenArgument] = []
        self.includes: list[SeenInclude] = []
        self._places = places

    def actions(self, actions: object, *, conditional: bool) -> None:
        """Visit a list of actions, each a mapping with one key."""
        for action in actions if isinstance(actions, list) else ():
            for name, body in action.items() if isinstance(action, dict) else ():
                self._action(name, body, conditional=conditional)

    def _action(self, name: str, body: object, *, conditional: bool) -> None:
        if isinstance(body, list):  # of a group, whose condition is one of its actions
            inner = any(isinstance(item, dict) and not item.keys().isdisjoint(_CONDITIONS) for item in body)
            self.actions(body, conditional=conditional or inner)
        if not isinstance(body, dict):
            return
        conditional |= not body.keys().isdisjoint(_CONDITIONS)
        if name == "arg":
            self._argument(body, conditional=conditional)
        elif name == "include":
            self._include(body, conditional=conditional)
        else:
            for value in body.values():
                self.actions(value, conditional=conditional)

    def _argument(self, body: dict[str, Any], *, conditional: bool) -> None:
        name, default, description = (body.get(key) for key in ("name", "default", "description"))
        if not isinstance(name, str):
            return
        self.arguments.append(
            SeenArgument(
                name,
                default if isinstance(default, str) else None,
                isinstance(default, str) and "$(" not in default,
                (*_texts(body.get("choices"), None), *_texts(body.get("choice"), "value")),
                description if isinstance(description, str) else None,
                conditional,
            )
        )

    def _include(self, body: dict[str, Any], *, conditional: bool) -> None:
        file = body.get("file")
        path = constant_text(file, self._places) if isinstance(file, str) else None
        if path is not None:
            given = (*_texts(body.get("arg"), "name"), *_texts(body.get("let"), "name"))
            self.includes.append(SeenInclude(path, frozenset(given), conditional))


_CONDITIONS = frozenset({"if", "unless"})


def _texts(items: object, key: str | None) -> tuple[str, ...]:
    """Return the texts of a list, or those under a key of its mappings."""
    values = items if isinstance(items, list) else ()
    if key is not None:
        values = [item.get(key) for item in values if isinstance(item, dict)]
    return tuple(value for value in values if isinstance(value, str))
