"""`launch_yaml.Entity`: a mapping, or a list of actions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.frontend.entity import Entity as BaseEntity
from orchestra.compat.launch.frontend.entity import key_of
from orchestra.description.source import Keyed, Listed, Written

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.location import Span

_CHILDREN = "children"


class Entity(BaseEntity):
    """What stands behind the name of an action, or an item of a list of parts."""

    def __init__(
        self,
        element: Any,
        type_name: str | None = None,
        *,
        parent: Entity | None = None,
    ) -> None:
        self.__head = element if type_name is None else None
        if type_name is None:
            type_name, element = _only(element)
        if isinstance(element, Written) and element.null:
            element = {}
        self.__type_name = type_name
        self.__element = element
        self.__parent = parent
        self.__read: set[str] = set()

    @property
    def type_name(self) -> str:
        """The name of the action."""
        return self.__type_name

    @property
    def parent(self) -> Entity | None:
        """The entity around this one."""
        return self.__parent

    @property
    def children(self) -> list[BaseEntity]:
        """The actions of a list, or of a mapping's `children`. Raises `ValueError` where there are none."""
        items = self.__element
        if isinstance(items, dict):
            self.__read.add(_CHILDREN)
            items = items.get(_CHILDREN)
        if not isinstance(items, list):
            raise ValueError(  # noqa: TRY004 - as upstream
                f"'{self.type_name}' has a list of actions, or a mapping with one behind '{_CHILDREN}'"
            )
        return [Entity(item, parent=self) for item in items]

    def _entities(self, name: str) -> list[BaseEntity] | None:
        items = self._raw(name)
        if items is None or items == []:
            return None
        if not isinstance(items, list) or not all(isinstance(item, dict) for item in items):
            raise TypeError(f"Attribute '{name}' of '{self.type_name}' is a list of mappings")
        return [Entity(item, name, parent=self) for item in items]

    def _raw(self, name: str) -> Any:
        key = key_of(name, self.__element) if isinstance(self.__element, dict) else None
        if key is None:
            return None
        self.__read.add(key)
        return self.__element[key]

    def _unread(self) -> Iterator[str]:
        if isinstance(self.__element, dict):
            yield from (name for name in self.__element if name not in self.__read)

    def _texts(self) -> Iterator[Written]:
        return _texts(self.__element)

    @property
    def _span(self) -> Span | None:
        for tree in (self.__head, self.__element):
            if isinstance(tree, Keyed):
                return next(iter(tree.keys_at.values()), tree.head)
        return self.__element.span if isinstance(self.__element, Listed) else None


def _only(element: Any) -> tuple[str, Any]:
    if not isinstance(element, dict) or len(element) != 1:
        raise RuntimeError(f"an action is a mapping with one key, its name, not {element!r}")
    name, content = next(iter(element.items()))
    return str(name), content


def _texts(tree: Any) -> Iterator[Written]:
    if isinstance(tree, Written):
        yield tree
    elif isinstance(tree, dict | list):
        for item in tree.values() if isinstance(tree, dict) else tree:
            yield from _texts(item)
