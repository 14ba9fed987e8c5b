"""`dataclass` as the standard library has it, without its price at import.

That one writes the text of six methods for each class and compiles them, which took half of the time until the first
process of a run was started: there are some hundred classes on the way, and few of them are ever made there. Here
`__init__` is compiled when more than a few objects are made, and the other methods are the same code for all classes.
Fields are those of the standard library, so `fields`, `replace`, `asdict` and `is_dataclass` do what they always do.

`InitVar` is not known here.
"""

from __future__ import annotations

import dataclasses
from operator import attrgetter, ge, gt, le, lt
from reprlib import recursive_repr

__all__ = ["dataclass", "maker"]

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from dataclasses import dataclass
    from typing import Any, ParamSpec, TypeVar

    P = ParamSpec("P")
    T = TypeVar("T")

else:

    def dataclass(
        *,
        frozen: bool = False,
        eq: bool = True,
        order: bool = False,
        slots: bool = False,
        kw_only: bool = False,
    ) -> Callable[[type], type]:
        """Make a class one with fields: see the standard library."""

        def made(cls: type) -> type:
            return _made(cls, frozen=frozen, eq=eq, order=order, slots=slots, kw_only=kw_only)

        return made


_UNWRITTEN = dataclasses.MISSING
_FEW = 3  # objects take less time to be made one by one than `__init__` takes to be compiled
_ORDER = {"lt": lt, "le": le, "gt": gt, "ge": ge}


def _made(cls: type, *, frozen: bool, eq: bool, order: bool, slots: bool, kw_only: bool) -> Any:
    if cls.__doc__ is None:
        cls.__doc__ = (
            cls.__name__
        )  # else the signature is looked up to make one, and `__init__` compiled for it
    made: Any = dataclasses.dataclass(init=False, repr=False, eq=False, slots=slots, kw_only=kw_only)(cls)
    own = set(vars(made))
    fields = dataclasses.fields(made)
    methods: dict[str, Any] = {"__init__": _Late(made, frozen=frozen)}
    methods["__repr__"] = _repr(tuple(field.name for field in fields if field.repr))
    if eq:
        methods["__eq__"] = _eq(_values([field.name for field in fields if field.compare]))
        # As the standard library decides: a class that says how it is compared has None here, and gets no other.
        hashed = [field.name for field in fields if (field.compare if field.hash is None else field.hash)]
        methods["__hash__"] = _hash(_values(hashed)) if frozen else None
        if vars(made).get("__hash__") is None and "__eq__" in own:
            own.discard("__hash__")
    if order:
        values = _values([field.name for field in fields if field.compare])
        methods.update((f"__{name}__", _ordered(values, compare)) for name, compare in _ORDER.items())
    if frozen:
        names = frozenset(field.name for field in fields)
        methods["__setattr__"], methods["__delattr__"] = _refusals(made, names)
        if slots:
            methods["__getstate__"], methods["__setstate__"] = _getstate, _setstate
    for name, method in methods.items():
        if name not in own:
            setattr(made, name, method)
    return made


class _Late:
    """The `__init__` of a class, which is compiled for those who make more than a few objects of it."""

    __slots__ = ("_cls", "_frozen", "_made")

    def __init__(self, cls: type, *, frozen: bool) -> None:
        self._cls = cls
        self._frozen = frozen
        self._made = 0

    def __get__(self, instance: object, owner: type | None = None) -> Any:
        self._made += 1
        if instance is None or self._made > _FEW:
            return self._compiled(instance, owner)
        return lambda *args, **named: self._fill(instance, args, named)

    def _fill(self, instance: Any, args: tuple[Any, ...], named: dict[str, Any]) -> None:
        """Set the fields one by one; arguments that do not fit are left to the compiled one, which says why."""
        values = _matched(dataclasses.fields(self._cls), args, named)
        if values is None:
            self._compiled(instance, None)(*args, **named)
            return
        for name, value in values.items():
            object.__setattr__(instance, name, value)
        if hasattr(self._cls, "__post_init__"):
            instance.__post_init__()

    def _compiled(self, instance: object, owner: type | None) -> Any:
        method = _init(self._cls, frozen=self._frozen)
        setattr(self._cls, "__init__", method)  # noqa: B010 - mypy takes the other way for a mistake
        return method.__get__(instance, owner)


def _matched(
    fields: tuple[dataclasses.Field[Any], ...], args: tuple[Any, ...], named: dict[str, Any]
) -> dict[str, Any] | None:
    """Return the value of each field; None where the arguments do not fit."""
    plain = [field.name for field in fields if field.init and not field.kw_only]
    given = {**dict(zip(plain, args, strict=False)), **named}
    if len(args) > len(plain) or len(given) < len(args) + len(named):
        return None
    values = {}
    for field in fields:
        if field.init and field.name in given:
            values[field.name] = given.pop(field.name)
        elif field.default is not _UNWRITTEN:
            values[field.name] = field.default
        elif field.default_factory is not _UNWRITTEN:
            values[field.name] = field.default_factory()
        elif field.init:
            return None
    return None if given else values


def _init(cls: Any, *, frozen: bool) -> Any:
    """Compile what takes the values of the fields."""
    fields = dataclasses.fields(cls)
    known: dict[str, Any] = {"_set": object.__setattr__, "_unwritten": _UNWRITTEN}
    plain = [_parameter(field, known) for field in fields if field.init and not field.kw_only]
    named = [_parameter(field, known) for field in fields if field.init and field.kw_only]
    words = ["self", *plain, *(["*"] if named else []), *named]
    lines = [line for field in fields if (line := _assignment(field, known, frozen=frozen))]
    if hasattr(cls, "__post_init__"):
        lines.append("self.__post_init__()")
    text = "\n ".join([f"def __init__({', '.join(words)}):", *(lines or ["pass"])])
    exec(text, known)  # noqa: S102 - names of fields, which are identifiers
    method = known["__init__"]
    method.__qualname__ = f"{cls.__qualname__}.__init__"
    method.__module__ = cls.__module__
    method.__annotations__ = {**{field.name: field.type for field in fields if field.init}, "return": None}
    return method


def _parameter(field: dataclasses.Field[Any], known: dict[str, Any]) -> str:
    if field.default is not _UNWRITTEN:
        known[f"_default_{field.name}"] = field.default
        return f"{field.name}=_default_{field.name}"
    return field.name if field.default_factory is _UNWRITTEN else f"{field.name}=_unwritten"


def _assignment(field: dataclasses.Field[Any], known: dict[str, Any], *, frozen: bool) -> str:
    name, value = field.name, field.name
    if field.default_factory is not _UNWRITTEN:
        known[f"_make_{name}"] = field.default_factory
        value = f"_make_{name}() if {name} is _unwritten else {name}" if field.init else f"_make_{name}()"
    elif not field.init:
        if field.default is _UNWRITTEN:
            return ""
        known[f"_default_{name}"] = field.default
        value = f"_default_{name}"
    return f"_set(self, {name!r}, {value})" if frozen else f"self.{name} = {value}"


def _values(names: list[str]) -> Callable[[Any], tuple[Any, ...]]:
    """Return what gives the values of these fields, always as a tuple: its comparison knows what is identical."""
    if len(names) > 1:
        return attrgetter(*names)
    return lambda record: tuple(getattr(record, name) for name in names)


def _repr(names: tuple[str, ...]) -> Any:
    @recursive_repr()
    def __repr__(self: Any) -> str:
        return f"{type(self).__qualname__}({', '.join(f'{name}={getattr(self, name)!r}' for name in names)})"

    return __repr__


def _eq(values: Callable[[Any], tuple[Any, ...]]) -> Any:
    def __eq__(self: Any, other: object) -> bool:
        return values(self) == values(other) if other.__class__ is self.__class__ else NotImplemented

    return __eq__


def _ordered(values: Callable[[Any], tuple[Any, ...]], compare: Callable[[Any, Any], bool]) -> Any:
    def ordered(self: Any, other: object) -> bool:
        return compare(values(self), values(other)) if other.__class__ is self.__class__ else NotImplemented

    return ordered


def _hash(values: Callable[[Any], tuple[Any, ...]]) -> Any:
    def __hash__(self: Any) -> int:
        return hash(values(self))

    return __hash__


def _refusals(cls: Any, names: frozenset[str]) -> tuple[Any, Any]:
    """Return what keeps values from being changed."""

    def __setattr__(self: Any, name: str, value: Any) -> None:
        if type(self) is cls or name in names:
            raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")
        super(cls, self).__setattr__(name, value)

    def __delattr__(self: Any, name: str) -> None:
        if type(self) is cls or name in names:
            raise dataclasses.FrozenInstanceError(f"cannot delete field {name!r}")
        super(cls, self).__delattr__(name)

    return __setattr__, __delattr__


def _getstate(self: Any) -> list[Any]:
    return [getattr(self, field.name) for field in dataclasses.fields(self)]


def _setstate(self: Any, state: list[Any]) -> None:
    for field, value in zip(dataclasses.fields(self), state, strict=True):
        object.__setattr__(self, field.name, value)


def maker(cls: Callable[P, T]) -> Callable[P, T]:
    """Return what makes objects of a frozen class with slots as calling it does, in a third of the time.

    Fields that nobody may change are slow to set. They are set here in an open object of the same layout, which then
    becomes one of the class. For classes of which a launch makes thousands; without `__post_init__`.
    """
    frozen: Any = cls
    slots = {"__slots__": frozen.__slots__, "__setattr__": object.__setattr__}
    known: dict[str, Any] = {"_unwritten": _UNWRITTEN, "_new": object.__new__, "_cls": cls}
    known["_open"] = type(f"_Open{frozen.__name__}", frozen.__bases__, slots)
    fields = dataclasses.fields(frozen)
    lines = ["self = _new(_open)", *(_assignment(field, known, frozen=False) for field in fields)]
    lines += ["self.__class__ = _cls", "return self"]
    words = [_parameter(field, known) for field in fields if field.init]
    exec("\n ".join([f"def make({', '.join(words)}):", *lines]), known)  # noqa: S102 - names of fields, which are identifiers
    made: Callable[P, T] = known["make"]
    return made
