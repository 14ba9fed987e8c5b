"""The fields of classes that `orchestra.dataclass` makes.

To the standard library these classes have the same fields as its own, so its `fields`, `replace`, `asdict` and
`is_dataclass` do what they always do. Those here do the same for these classes alone, without that library.
"""

from __future__ import annotations

from operator import attrgetter
from reprlib import recursive_repr
from types import MemberDescriptorType

__all__ = ["field", "fields", "is_dataclass", "replace"]

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from dataclasses import field, fields, is_dataclass, replace
    from typing import Any

else:

    def field(**options: Any) -> Any:
        """Say how a field is made: see the standard library."""
        return Field(**options)

    def fields(record: Any) -> tuple[Any, ...]:
        """Return the fields of a class, or of an object of one; of each name, type, defaults and what it counts for."""
        return record.__record_fields__

    def is_dataclass(record: Any) -> bool:
        """Tell whether it is such a class, or an object of one."""
        return hasattr(record, "__record_fields__")

    def replace(record: Any, /, **changes: Any) -> Any:
        """Return an object like another one, with other values for some fields."""
        key = record.__class__, *changes
        known = _TAKEN.get(key)
        if known is None:  # what is changed is not asked for: it may be worked out when it is
            names = [item.name for item in record.__record_fields__ if item.init and item.name not in changes]
            known = _TAKEN[key] = names, values_of(names)
        return key[0](**dict(zip(known[0], known[1](record), strict=True)), **changes)


# By class and what is changed: what else a class is made from, with what gives that of an object.
_TAKEN: dict[tuple[Any, ...], tuple[list[str], Callable[[Any], tuple[Any, ...]]]] = {}
UNWRITTEN = type("Unwritten", (), {})()
_OPTIONS = ("init", "repr", "hash", "compare", "kw_only")


class Field:
    """One field; `hash` is None where it counts for the hash as it does for comparisons."""

    __slots__ = ("compare", "default", "default_factory", "hash", "init", "kw_only", "name", "repr", "type")

    def __init__(
        self,
        *,
        default: Any = UNWRITTEN,
        default_factory: Any = UNWRITTEN,
        init: bool = True,
        repr: bool = True,  # noqa: A002 - the standard library's words
        hash: bool | None = None,  # noqa: A002
        compare: bool = True,
        kw_only: bool | None = None,
    ) -> None:
        self.name, self.type = "", ""
        self.default, self.default_factory = default, default_factory
        self.init, self.repr, self.hash, self.compare = init, repr, hash, compare
        self.kw_only = kw_only


def own_fields(cls: type, *, kw_only: bool) -> list[Field]:
    """Return the fields that a class itself declares, and leave their defaults in it."""
    found = []
    for name, kind in cls.__annotations__.items():
        if "ClassVar[" in str(kind):
            continue
        written = vars(cls).get(name, UNWRITTEN)
        item = _read(written)
        item.name, item.type = name, kind
        item.kw_only = kw_only if item.kw_only is None else item.kw_only
        if item.default is not UNWRITTEN and type(item.default).__hash__ is None:
            raise ValueError(f"the default of {name} can change: use default_factory")
        if item.default is not UNWRITTEN:
            setattr(cls, name, item.default)
        elif written is not UNWRITTEN and not isinstance(written, MemberDescriptorType):
            delattr(cls, name)
        found.append(item)
    return found


def _read(written: Any) -> Field:
    """Return the field that stands in a class: a default, or what `field` has given, or the standard library's."""
    if isinstance(written, Field):
        return written
    if isinstance(written, MemberDescriptorType):  # it has a slot already, and no default
        return Field()
    if type(written).__module__ != "dataclasses":
        return Field(default=written)
    import dataclasses  # noqa: PLC0415 - whoever wrote it has imported it

    if not isinstance(written, dataclasses.Field):
        return Field(default=written)
    said = {name: getattr(written, name) for name in (*_OPTIONS, "default", "default_factory")}
    return Field(**{name: value for name, value in said.items() if value is not dataclasses.MISSING})


class ForLibrary:
    """What the standard library looks for in a class, made when it does."""

    __slots__ = ("_cls", "_name")

    def __init__(self, cls: type, name: str) -> None:
        self._cls = cls
        self._name = name

    def __get__(self, instance: object, owner: type | None = None) -> Any:
        import dataclasses  # noqa: PLC0415 - as above

        declared = []
        for item in self._cls.__record_fields__:  # type: ignore[attr-defined]
            said = {name: getattr(item, name) for name in (*_OPTIONS, "default", "default_factory")}
            made: Any = dataclasses.field
            options = {name: value for name, value in said.items() if value is not UNWRITTEN}
            declared.append((item.name, item.type, made(**options)))
        twin: Any = dataclasses.make_dataclass(self._cls.__name__, declared, init=False, repr=False, eq=False)
        for name in ("__dataclass_fields__", "__dataclass_params__"):
            setattr(self._cls, name, getattr(twin, name))
        return getattr(twin, self._name)


def refusals(cls: Any, names: frozenset[str]) -> tuple[Any, Any]:
    """Return what keeps values from being changed."""

    def __setattr__(self: Any, name: str, value: Any) -> None:
        if type(self) is cls or name in names:
            raise _frozen(f"cannot assign to field {name!r}")
        super(cls, self).__setattr__(name, value)

    def __delattr__(self: Any, name: str) -> None:
        if type(self) is cls or name in names:
            raise _frozen(f"cannot delete field {name!r}")
        super(cls, self).__delattr__(name)

    return __setattr__, __delattr__


def _frozen(message: str) -> AttributeError:
    from dataclasses import FrozenInstanceError  # noqa: PLC0415 - nobody should ever see it

    return FrozenInstanceError(message)


def getstate(self: Any) -> list[Any]:
    """Return the values of an object whose class has slots, to be copied."""
    return [getattr(self, item.name) for item in fields(self)]


def setstate(self: Any, state: list[Any]) -> None:
    """Set the values of an object whose class has slots."""
    for item, value in zip(fields(self), state, strict=True):
        object.__setattr__(self, item.name, value)


def values_of(names: list[str]) -> Callable[[Any], tuple[Any, ...]]:
    """Return what gives the values of these fields, always as a tuple: its comparison knows what is identical."""
    if len(names) > 1:
        return attrgetter(*names)
    return lambda record: tuple(getattr(record, name) for name in names)


def repr_of(names: tuple[str, ...]) -> Any:
    @recursive_repr()
    def __repr__(self: Any) -> str:
        return f"{type(self).__qualname__}({', '.join(f'{name}={getattr(self, name)!r}' for name in names)})"

    return __repr__


def equality(values: Callable[[Any], tuple[Any, ...]]) -> Any:
    def __eq__(self: Any, other: object) -> bool:
        return values(self) == values(other) if other.__class__ is self.__class__ else NotImplemented

    return __eq__


def ordering(values: Callable[[Any], tuple[Any, ...]], compare: Callable[[Any, Any], bool]) -> Any:
    def ordered(self: Any, other: object) -> bool:
        return compare(values(self), values(other)) if other.__class__ is self.__class__ else NotImplemented

    return ordered


def hashing(values: Callable[[Any], tuple[Any, ...]]) -> Any:
    def __hash__(self: Any) -> int:
        return hash(values(self))

    return __hash__
