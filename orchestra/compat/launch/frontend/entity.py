"""`launch.frontend.Entity`: an element of an XML file or a mapping of a YAML file, for those who parse actions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, get_args, get_origin

from orchestra.compat.launch.frontend.values import typed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.source import Written
    from orchestra.location import Span


class Entity:
    """The base of the entities of both languages, which say where attributes and nested entities come from."""

    @property
    def type_name(self) -> str:
        """The tag."""
        raise NotImplementedError

    @property
    def parent(self) -> Entity | None:
        """The entity that this one is nested in, None where that is not known."""
        raise NotImplementedError

    @property
    def children(self) -> list[Entity]:
        """The nested entities."""
        raise NotImplementedError

    def get_attr(
        self,
        name: str,
        *,
        data_type: Any = str,
        optional: bool = False,
        can_be_str: bool = True,
    ) -> Any:
        """Return an attribute, or the nested entities of that name for a `data_type` of `List[Entity]`.

        `data_type` is `int`, `float`, `bool`, `str`, a list of these, or None: by YAML's rules. With `can_be_str` a
        text that is not of the type is returned as it is. Hyphens and underscores in names are alike.

        Raises `AttributeError` where it is missing unless it is `optional`, `TypeError` where it has another type.
        """
        if is_list_of_entities(data_type):
            found: Any = self._entities(name)
        else:
            raw = self._raw(name)
            found = None if raw is None else self._typed(name, raw, data_type, can_be_str=can_be_str)
        if found is None and not optional:
            raise AttributeError(f"'{self.type_name}' lacks '{name}'")
        return found

    def assert_entity_completely_parsed(self) -> None:
        """Raise `ValueError` where somebody has written what nobody has read."""
        unread = list(self._unread())
        if unread:
            names = ", ".join(f"`{name}`" for name in unread)
            raise ValueError(f"Unexpected in `{self.type_name}`: {names}")

    def _entities(self, name: str) -> list[Entity] | None:
        """Return the nested entities of a name, None where there are none."""
        raise NotImplementedError

    def _raw(self, name: str) -> Any:
        """Return an attribute as written: a `Written`, a list of them, or plain Python values; None: absent."""
        raise NotImplementedError

    def _unread(self) -> Iterator[str]:
        """Return the names that nobody has asked for."""
        raise NotImplementedError

    def _texts(self) -> Iterator[Written]:
        """Return the scalars with their places, of nested entities too."""
        return iter(())

    @property
    def _span(self) -> Span | None:
        """Where the entity stands, None where that is not known."""
        return None

    def _typed(self, name: str, raw: Any, data_type: Any, *, can_be_str: bool) -> Any:
        try:
            return self._coerced(raw, data_type, can_be_str=can_be_str)
        except (ValueError, TypeError) as error:
            raise TypeError(f"Attribute '{name}' of '{self.type_name}': {error}") from error

    def _coerced(self, raw: Any, data_type: Any, *, can_be_str: bool) -> Any:
        """Return a value as a type. Raises `ValueError` or `TypeError` where it is none."""
        return typed(raw, data_type, can_be_str=can_be_str)


def is_list_of_entities(data_type: Any) -> bool:
    """Return whether a type is a list of entities."""
    if get_origin(data_type) is not list:
        return False
    item = get_args(data_type)[0]
    return isinstance(item, type) and issubclass(item, Entity)


def key_of(name: str, keys: Any) -> str | None:
    """Return the key that a name stands for: itself, else the one that has hyphens for underscores or so."""
    if name in keys:
        return name
    spelled = name.replace("-", "_")
    return next((key for key in keys if key.replace("-", "_") == spelled), None)
