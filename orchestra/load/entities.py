"""From the tree of a launch file, whatever its format, to the models of its actions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeVar

from orchestra.dataclass import dataclass
from orchestra.description.actions import model_of
from orchestra.description.core import ValidationError
from orchestra.description.launch import Description, Launch
from orchestra.description.source import Keyed, Listed, Written, kind_of, texts_in
from orchestra.errors import HERE, Code
from orchestra.fields import field
from orchestra.load.elements import Tagged, beginning_of, emptied, place_of
from orchestra.load.exposed import ADDED_BY, exposed_action, exposes_action
from orchestra.load.keys import action_meant, as_written, spelled
from orchestra.load.pairs import written_mapping
from orchestra.load.reader import Reader

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.entity import Action, Entity
    from orchestra.location import Span

PARAMETERS: Final = "this is a parameter file, not a launch file"
_NODE: Final = frozenset({"pkg", "exec"})
_SECTION: Final = "ros__parameters"
_OF_LYRICAL: Final = frozenset({"log_debug", "log_error", "log_info", "log_warning"})
_EntityT = TypeVar("_EntityT", bound="Entity")


def describe(tree: Any, path: str, file: str, reader: Reader) -> Description | None:  # noqa: ANN401 - a tree
    """Return the description that a tree holds, None where it is no launch description at all."""
    if not isinstance(tree, Keyed):
        message = "a launch file is a mapping with the key 'launch'"
        reader.error(Code.WRONG_TYPE, message, beginning_of(tree, tree.span))
        return None
    if "launch" not in tree and any(map(_has_parameters, tree.values())):
        reader.error(Code.MISSING_KEY, PARAMETERS, beginning_of(tree, tree.span))
        return None
    root = reader.keys(frozenset({"launch"}), tree, frozenset({"launch"}))
    if "launch" not in root:
        if not root.lossy:
            reader.error(Code.MISSING_KEY, "the key 'launch' is missing", tree.span)
        return None
    builder = _Builder(reader)
    launch = builder.entity(Launch, builder.content(root["launch"], root.keys_at["launch"], Launch))
    if launch is None:
        return Description(path, file, (), lost=frozenset(texts_in(tree)))
    return Description(path, file, launch.children, launch.deprecated, frozenset(builder.lost))


def action_in(item: Any, reader: Reader) -> Action | None:  # noqa: ANN401 - a tree
    """Return the one action that an item of a list of actions holds; None where there is none, or there are more."""
    items = Listed(item.span)
    items.append(item)
    actions = _Builder(reader).actions(items, item.span)
    return actions[0] if len(actions) == 1 else None


@dataclass(slots=True)
class _Builder:
    """Builds the actions of one file; remembers every scalar of those that cannot be built."""

    reader: Reader
    lost: set[str] = field(default_factory=set)

    def actions(
        self,
        items: Any,  # noqa: ANN401 - a tree
        head: Span,
        around: frozenset[str] = frozenset(),
    ) -> tuple[Action, ...]:
        """Return the actions of a list; `around` are the keys that may stand beside it."""
        if not isinstance(items, Listed):
            self._wrong(f"expected a list of actions, found {kind_of(items)}", place_of(items, head))
            return ()
        built = []
        for item in self._apart(items):
            action = self._action(item, around)
            if action is None or action.faulty:
                self.lost.update(texts_in(item))
                self.lost.update(_repeated_for(item))
            if action is not None:
                built.append(action)
        return tuple(built)

    def content(self, content: Any, at: Span, model: type[Entity]) -> Any:  # noqa: ANN401 - a tree
        """Return what stands behind a key as a mapping: nothing at all and a bare list of actions are mappings too."""
        nested = "children" in model.known_keys()
        if isinstance(content, Written) and content.null and model.required_keys() != {"children"}:
            return Keyed(at, at)
        if isinstance(content, Listed) and nested:
            keyed = Keyed(content.span, at)
            keyed.put("children", content, at)
            content = keyed
        if not isinstance(content, Keyed):
            self._no_mapping(content, at, model)
            return None
        if nested and "children" not in content:
            content = self._listed(content, model.known_keys())
        content = self.reader.keys(model.known_keys(), content, model.required_beside(content))
        if nested and "children" in content:
            children = self.actions(content["children"], content.keys_at["children"], model.known_keys())
            content = _with_children(content, children)
        return content

    def entity(self, model: type[_EntityT], content: Any) -> _EntityT | None:  # noqa: ANN401 - a tree
        """Return an entity, None where too little of it is sound."""
        if content is None:
            return None
        try:
            return model.model_validate(content, context=self.reader)
        except ValidationError:  # every fault has been reported through the reader
            return None

    def _action(self, item: Any, around: frozenset[str]) -> Action | None:  # noqa: ANN401 - a tree
        if not isinstance(item, Keyed):
            found = kind_of(item)
            self._wrong(
                f"expected an action (one key: its name), found {found}", beginning_of(item, item.span)
            )
            return None
        name, content = self._named(item)
        if name is None:
            return None
        at = item.keys_at[name]
        if name == "executable" and isinstance(content, Keyed) and content.keys() >= _NODE:
            self.reader.error(
                Code.UNKNOWN_ACTION, "what has 'pkg' and 'exec' is a node", at, suggestion="node"
            )
            name = "node"
        if model_of(spelled(name)) is None and exposes_action(name):
            return exposed_action(name, content, at, self.reader.problems, self.reader.included_from)
        model, certain = self._model(name, at, around)
        if model is None:
            return None
        content = self.content(content, at, model)
        if content is not None and not certain:
            content.meant |= model.required_keys()  # what a guess lacks is not told
        return self.entity(model, content)

    def _apart(self, items: Listed) -> Iterator[Any]:
        """Yield the items of a list; of several actions in one item, for want of a '- ', each by itself."""
        for item in items:
            for name, content, at in item.again if isinstance(item, Keyed) else ():
                yield _alone(name, content, at)
            if not isinstance(item, Keyed) or len(item) <= 1 or not all(map(_is_action, item)):
                yield item
                continue
            first = next(iter(item))
            if isinstance(item[first], Written) or any(map(_keys_of(first).__contains__, item)):
                yield item
                continue
            for name, content in item.items():
                if name != first:
                    self._without_dash(name, item.keys_at[name])
                yield _alone(name, content, item.keys_at[name])

    def _listed(self, content: Keyed, known: frozenset[str]) -> Keyed:
        """Return a mapping with the actions in it as its children, where they stand as keys; the first is told."""
        names = [key for key in content if spelled(key) not in known and _is_action(key)]
        if not names or isinstance(content, Tagged):
            return content
        self._without_dash(names[0], content.keys_at[names[0]])
        read = emptied(content)
        read.lossy, read.meant = True, content.meant
        children = Listed(content.span)
        children.extend(_alone(name, content[name], content.keys_at[name]) for name in names)
        for key, value in content.items():
            if key not in names:
                read.put(key, value, content.keys_at[key])
        read.put("children", children, content.head)
        return read

    def _without_dash(self, name: str, at: Span) -> None:
        message = f"'{name}' is an action: a '- ' is missing before it"
        self.reader.error(Code.WRONG_TYPE, message, at, suggestion=f"- {name}")

    def _named(self, item: Keyed) -> tuple[str | None, Any]:
        """Return the name of an action and what stands behind it.

        Where the keys of an action stand beside its name, which is a matter of indentation, they are taken as its own.
        """
        if len(item) == 1:
            return next(iter(item.items()))
        name = _name_among(item)
        if name is None:
            keys = ", ".join(f"'{key}'" for key in item)
            found = f"{len(item)} keys: {keys}" if item else "none"
            self._wrong(f"expected an action (one key: its name), found {found}", item.head)
            return None, None
        content, inside = Keyed(item.span, item.keys_at[name]), item[name]
        beside = [key for key in item if key != name]
        if isinstance(inside, Keyed):
            content.update(inside)
            content.keys_at.update(inside.keys_at)
        for key in beside:
            content.put(key, item[key], item.keys_at[key])
        self._wrong(
            f"the keys of '{name}' stand beside it: indent them more than its name", item.keys_at[beside[0]]
        )
        return name, content

    def _model(self, name: str, at: Span, around: frozenset[str]) -> tuple[type[Action] | None, bool]:
        """Return the model of an action, and whether it is certain to be meant."""
        model = model_of(spelled(name))
        if model is not None:
            return model, True
        if spelled(name) in ADDED_BY:
            message = (
                f"the package '{ADDED_BY[spelled(name)]}', which adds the action '{name}', is not {HERE}"
            )
            self.reader.error(Code.UNKNOWN_ACTION, message, at)
            return None, False
        if spelled(name) in around:
            message = (
                f"'{name}' is a key, not an action: it stands beside 'children', the list of the actions"
            )
            self.reader.error(Code.UNKNOWN_ACTION, message, at)
            return None, False
        near, slip = action_meant(name)
        instead = as_written(near, name) if near is not None and slip else near
        newer = ": it came with ROS 2 Lyrical" if spelled(name) in _OF_LYRICAL else ""
        instead = "log" if newer else instead
        self.reader.error(Code.UNKNOWN_ACTION, f"unknown action '{name}'{newer}", at, suggestion=instead)
        return (model_of(near) if near is not None and slip else None), False

    def _no_mapping(self, content: Any, at: Span, model: type[Entity]) -> None:  # noqa: ANN401 - a tree
        nested, instead = "children" in model.known_keys(), None
        if isinstance(content, Written) and not content.null and not nested:
            instead = written_mapping(model.known_keys(), model.required_keys(), content)
        wanted = "a list of actions" if nested else "a mapping"
        told = f"expected {wanted}, found {kind_of(content)}"
        self._wrong(told, place_of(content, at), instead)

    def _wrong(self, message: str, span: Span, instead: str | None = None) -> None:
        self.reader.error(Code.WRONG_TYPE, message, span, suggestion=instead)


def _with_children(content: Keyed, children: tuple[Action, ...]) -> Keyed:
    """Return the mapping with its actions built; the tree stays as it is, for it may be searched for what was lost."""
    built = emptied(content)
    built.update(content)
    built.keys_at, built.lossy, built.meant = content.keys_at, content.lossy, content.meant
    built["children"] = children
    return built


def _has_parameters(content: Any, deep: int = 3) -> bool:  # noqa: ANN401 - a tree
    """Return whether a mapping is that of a node in a parameter file, or of namespaces so deep at most."""
    if not isinstance(content, Keyed):
        return False
    return _SECTION in content or (
        deep > 0 and any(_has_parameters(inner, deep - 1) for inner in content.values())
    )


def _is_action(name: str) -> bool:
    return model_of(spelled(name)) is not None


def _keys_of(name: str) -> frozenset[str]:
    """Return the keys that an action knows, none for what is no action."""
    model = model_of(spelled(name))
    return frozenset() if model is None else model.known_keys()


def _name_among(item: Keyed) -> str | None:
    """Return the key that is the name of an action whose own keys stand beside it, None where no key is."""
    names = [key for key in item if _is_action(key)]
    bare = next((name for name in names if isinstance(item[name], Written) and item[name].null), None)
    if bare is not None:
        return bare
    first = next((name for name in names if isinstance(item[name], Keyed)), None)
    if first is None:
        return None
    others = [spelled(key) for key in item if key != first]
    fits = all(key in _keys_of(first) and key not in item[first] for key in others)
    return first if fits else None


def _alone(name: str, content: Any, at: Span) -> Keyed:  # noqa: ANN401 - a tree
    """Return an item that is nothing but one action."""
    item = Keyed(at, at)
    item.put(name, content, at)
    return item


def _repeated_for(item: Any) -> Iterator[str]:  # noqa: ANN401 - a tree
    """Yield the variables that an action is repeated for."""
    for content in item.values() if isinstance(item, Keyed) else ():
        repeated = content.get("for_each") if isinstance(content, Keyed) else None
        yield from repeated if isinstance(repeated, Keyed) else ()
