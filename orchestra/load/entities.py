"""From the tree of a launch file, whatever its format, to the models of its actions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from orchestra.description.actions import ACTIONS, model_of
from orchestra.description.launch import Description
from orchestra.description.source import Keyed, Listed, Written, kind_of
from orchestra.errors import Code
from orchestra.load.reader import Reader
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from orchestra.description.entity import Action
    from orchestra.location import Span

_ROOT_KEYS = frozenset({"deprecated", "children"})


@dataclass(slots=True)
class _Builder:
    reader: Reader
    incomplete: bool = False

    def actions(self, items: Any, head: Span) -> tuple[Action, ...]:  # noqa: ANN401 - a tree
        if not isinstance(items, Listed):
            self._wrong(f"expected a list of actions, found {kind_of(items)}", _span(items, head))
            return ()
        built = [self._action(item) for item in items]
        return tuple(action for action in built if action is not None)

    def _action(self, item: Any) -> Action | None:  # noqa: ANN401 - a tree
        if not isinstance(item, Keyed) or len(item) != 1:
            span = item.head if isinstance(item, Keyed) else item.span
            self._wrong(f"expected an action (one key: its name), found {_found(item)}", span)
            return None
        name, content = next(iter(item.items()))
        at = item.keys_at[name]
        model = model_of(name)
        if model is None:
            self.incomplete = True
            suggestion = nearest(name, ACTIONS)
            self.reader.error(Code.UNKNOWN_ACTION, f"unknown action '{name}'", at, suggestion=suggestion)
            return None
        return self._validated(model, self._content(content, at, model))

    def _content(self, content: Any, at: Span, model: type[Action]) -> Any:  # noqa: ANN401 - a tree
        """Return the mapping of an action: nothing at all and a bare list of children are mappings too."""
        if isinstance(content, Written) and content.null:
            return Keyed(at, at)
        if isinstance(content, Listed) and "children" in model.known_keys():
            keyed = Keyed(content.span, at)
            keyed["children"], keyed.keys_at["children"] = content, at
            content = keyed
        if isinstance(content, Keyed) and "children" in model.known_keys() and "children" in content:
            content["children"] = self.actions(content["children"], content.keys_at["children"])
        if not isinstance(content, Keyed):
            self._wrong(f"expected a mapping, found {kind_of(content)}", _span(content, at))
        return content

    def _validated(self, model: type[Action], content: Any) -> Action | None:  # noqa: ANN401 - a tree
        if not isinstance(content, Keyed):
            return None
        try:
            action = model.model_validate(content, context=self.reader)
        except ValidationError:  # every fault has been reported through the reader
            self.incomplete = True
            return None
        self.incomplete |= action.faulty
        return action

    def _wrong(self, message: str, span: Span) -> None:
        self.incomplete = True
        self.reader.error(Code.WRONG_TYPE, message, span)


def describe(tree: Any, path: str, file: str, reader: Reader) -> Description | None:  # noqa: ANN401 - a tree
    """Return the description that a tree holds, None where it is no launch description at all."""
    builder = _Builder(reader)
    if not isinstance(tree, Keyed):
        reader.error(Code.WRONG_TYPE, "a launch file is a mapping with the key 'launch'", tree.span)
        return None
    for key, at in tree.keys_at.items():
        if key != "launch":
            suggestion = nearest(key, ["launch"])
            reader.error(Code.UNKNOWN_KEY, f"unknown key '{key}' beside 'launch'", at, suggestion=suggestion)
    if "launch" not in tree:
        if not tree:
            reader.error(Code.MISSING_KEY, "the key 'launch' is missing", tree.span)
        return None
    root, head = tree["launch"], tree.keys_at["launch"]
    deprecated = None
    if isinstance(root, Keyed):
        for key in root.keys() - _ROOT_KEYS:
            reader.unknown_key(_ROOT_KEYS, root, key)
        deprecated = getattr(root.get("deprecated"), "text", None)
        root = root.get("children", Listed(root.span))
    actions = builder.actions(root, head)
    return Description(path, file, actions, deprecated, builder.incomplete)


def _span(value: Any, head: Span) -> Span:  # noqa: ANN401 - a tree
    if isinstance(value, Written) and value.null:
        return head
    span: Span = value.head if isinstance(value, Keyed) else value.span
    return span


def _found(item: Any) -> str:  # noqa: ANN401 - a tree
    if isinstance(item, Keyed) and item:
        return f"{len(item)} keys: " + ", ".join(f"'{key}'" for key in item)
    return kind_of(item)
