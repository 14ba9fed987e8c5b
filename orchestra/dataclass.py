"""`dataclass` as the standard library has it, without its price at import.

That one writes the text of six methods for each class and compiles them, which took half of the time until the first
process of a run was started: there are some hundred classes on the way, and few of them are ever made there. Here
`__init__` is compiled when more than a few objects are made, and the other methods are the same code for all classes.
The library itself, and what it needs to write code, is imported only where somebody uses it (`orchestra.fields`).

`InitVar` and fields in an order by name alone (`KW_ONLY`) are not known here.
"""

from __future__ import annotations

from operator import ge, gt, le, lt

from orchestra.fields import (
    UNWRITTEN,
    ForLibrary,
    equality,
    fields,
    getstate,
    hashing,
    ordering,
    own_fields,
    refusals,
    repr_of,
    setstate,
    values_of,
)

__all__ = ["dataclass", "leave_open", "maker"]

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from dataclasses import dataclass
    from typing import Any, ParamSpec, TypeVar

    from orchestra.fields import Field

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


_FEW = 3  # objects take less time to be made one by one than `__init__` takes to be compiled
_ORDER = {"lt": lt, "le": le, "gt": gt, "ge": ge}
# The file of code that is written here: who watches what code does knows by it that it is ours.
_MADE = f"{__file__}: written"


def _with_slots(cls: type, names: list[str]) -> type:
    """Return the class anew, with slots for its own fields."""
    inherited = {slot for base in cls.__mro__[1:-1] for slot in vars(base).get("__slots__", ())}
    content = {name: value for name, value in vars(cls).items() if name not in names}
    content.pop("__dict__", None)
    content.pop("__weakref__", None)
    content["__slots__"] = tuple(name for name in names if name not in inherited)
    made = type(cls)(cls.__name__, cls.__bases__, content)
    made.__qualname__ = cls.__qualname__
    return made


def _made(cls: type, *, frozen: bool, eq: bool, order: bool, slots: bool, kw_only: bool) -> Any:
    known: dict[str, Field] = {}
    for base in cls.__mro__[-1:0:-1]:
        known.update((item.name, item) for item in vars(base).get("__record_fields__", ()))
    known.update((item.name, item) for item in own_fields(cls, kw_only=kw_only))
    items = tuple(known.values())
    if cls.__doc__ is None:
        cls.__doc__ = cls.__name__
    own = set(vars(cls))
    made: Any = _with_slots(cls, list(known)) if slots else cls
    made.__record_fields__ = items
    methods: dict[str, Any] = {"__init__": _Late(made, frozen=frozen)}
    methods["__match_args__"] = tuple(item.name for item in items if item.init and not item.kw_only)
    methods["__repr__"] = repr_of(tuple(item.name for item in items if item.repr))
    methods["__dataclass_fields__"] = ForLibrary(made, "__dataclass_fields__")
    methods["__dataclass_params__"] = ForLibrary(made, "__dataclass_params__")
    if eq:
        methods["__eq__"] = equality(values_of([item.name for item in items if item.compare]))
        # As the standard library decides: a class that says how it is compared has None here, and gets no other.
        hashed = [item.name for item in items if (item.compare if item.hash is None else item.hash)]
        methods["__hash__"] = hashing(values_of(hashed)) if frozen else None
        if vars(made).get("__hash__") is None and "__eq__" in own:
            own.discard("__hash__")
    if order:
        values = values_of([item.name for item in items if item.compare])
        methods.update((f"__{name}__", ordering(values, compare)) for name, compare in _ORDER.items())
    if frozen:
        methods["__setattr__"], methods["__delattr__"] = refusals(made, frozenset(known))
        if slots:
            methods["__getstate__"], methods["__setstate__"] = getstate, setstate
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
        # Whoever asks for a signature gives the class itself (Python 3.13).
        if instance is None or instance is self._cls or self._made > _FEW:
            return self._compiled(instance, owner)
        return lambda *args, **named: self.fill(instance, args, named)

    def fill(self, instance: Any, args: tuple[Any, ...], named: dict[str, Any]) -> None:
        """Set the fields one by one; arguments that do not fit are left to the compiled one, which says why."""
        values = _matched(fields(self._cls), args, named)
        if values is None:
            self._compiled(instance, None)(*args, **named)
            return
        for name, value in values.items():
            object.__setattr__(instance, name, value)
        if hasattr(self._cls, "__post_init__"):
            instance.__post_init__()

    def _compiled(self, instance: object, owner: type | None) -> Any:
        method = _init(self._cls, frozen=self._frozen and not _is_open(self._cls))
        setattr(self._cls, "__init__", method)  # noqa: B010 - mypy takes the other way for a mistake
        return method.__get__(instance, owner)


def _matched(items: tuple[Any, ...], args: tuple[Any, ...], named: dict[str, Any]) -> dict[str, Any] | None:
    """Return the value of each field; None where the arguments do not fit."""
    plain = [item.name for item in items if item.init and not item.kw_only]
    given = {**dict(zip(plain, args, strict=False)), **named}
    if len(args) > len(plain) or len(given) < len(args) + len(named):
        return None
    values = {}
    for item in items:
        if item.init and item.name in given:
            values[item.name] = given.pop(item.name)
        elif item.default is not UNWRITTEN:
            values[item.name] = item.default
        elif item.default_factory is not UNWRITTEN:
            values[item.name] = item.default_factory()
        elif item.init:
            return None
    return None if given else values


def _init(cls: Any, *, frozen: bool) -> Any:
    """Compile what takes the values of the fields."""
    items: Any = fields(cls)
    known: dict[str, Any] = {"_set": object.__setattr__, "_unwritten": UNWRITTEN}
    plain = [_parameter(item, known) for item in items if item.init and not item.kw_only]
    named = [_parameter(item, known) for item in items if item.init and item.kw_only]
    words = ["self", *plain, *(["*"] if named else []), *named]
    lines = [line for item in items if (line := _assignment(item, known, frozen=frozen))]
    if hasattr(cls, "__post_init__"):
        lines.append("self.__post_init__()")
    text = "\n ".join([f"def __init__({', '.join(words)}):", *(lines or ["pass"])])
    exec(compile(text, _MADE, "exec"), known)  # noqa: S102 - names of fields, which are identifiers
    method = known["__init__"]
    method.__qualname__ = f"{cls.__qualname__}.__init__"
    method.__module__ = cls.__module__
    method.__annotations__ = {**{item.name: item.type for item in items if item.init}, "return": None}
    return method


def _parameter(item: Field, known: dict[str, Any]) -> str:
    if item.default is not UNWRITTEN:
        known[f"_default_{item.name}"] = item.default
        return f"{item.name}=_default_{item.name}"
    return item.name if item.default_factory is UNWRITTEN else f"{item.name}=_unwritten"


def _assignment(item: Field, known: dict[str, Any], *, frozen: bool) -> str:
    name, value = item.name, item.name
    if item.default_factory is not UNWRITTEN:
        known[f"_make_{name}"] = item.default_factory
        value = f"_make_{name}() if {name} is _unwritten else {name}" if item.init else f"_make_{name}()"
    elif not item.init:
        if item.default is UNWRITTEN:
            return ""
        known[f"_default_{name}"] = item.default
        value = f"_default_{name}"
    return f"_set(self, {name!r}, {value})" if frozen else f"self.{name} = {value}"


def maker(cls: Callable[P, T]) -> Callable[P, T]:
    """Return what makes objects of a frozen class with slots as calling it does, in a third of the time.

    For classes of which a launch makes thousands; without `__post_init__`. To refuse that fields are set takes time
    where they are set first: of such a class it is left to type checkers. So the module of the class makes its maker.
    """
    leave_open(cls)
    made: Callable[P, T] = _Maker(cls).made
    return made


class _Maker:
    """Has the code of a maker compiled for those who make more than a few objects; until then it calls the class."""

    __slots__ = ("_cls", "_known", "_left", "made")

    def __init__(self, cls: Any) -> None:
        self._cls = cls
        self._left = _FEW
        self._known: dict[str, Any] = {"_maker": self}
        copy: Any = type(_called)
        self.made: Any = copy(_called.__code__, self._known, "make")

    def make(self, *args: Any, **named: Any) -> Any:
        self._left -= 1
        late = vars(self._cls).get("__init__")
        if self._left >= 0 and type(late) is not _Late:
            return self._cls(*args, **named)
        if self._left >= 0:  # by themselves they are too few for it to be compiled, too
            made = object.__new__(self._cls)
            late.fill(made, args, named)
            return made
        self._compile()
        return self.made(*args, **named)

    def _compile(self) -> None:
        known = self._known
        items: Any = fields(self._cls)
        known.update(_unwritten=UNWRITTEN, _new=object.__new__, _cls=self._cls)
        lines = ["self = _new(_cls)", *(_assignment(item, known, frozen=False) for item in items)]
        lines.append("return self")
        words = [_parameter(item, known) for item in items if item.init]
        text = "\n ".join([f"def make({', '.join(words)}):", *lines])
        exec(compile(text, _MADE, "exec"), known)  # noqa: S102 - names of fields, which are identifiers
        compiled = known["make"]
        self.made.__code__, self.made.__defaults__ = compiled.__code__, compiled.__defaults__


def _called(*args: Any, **named: Any) -> Any:
    """Call the maker that stands among the names of this function: each is a copy with names of its own."""
    return globals()["_maker"].make(*args, **named)


# Both make up one slot of a type, which is quick only where neither is one of Python code.
_OPEN = {"__setattr__": object.__setattr__, "__delattr__": object.__delattr__}


def _is_open(cls: Any) -> bool:
    """Tell whether a class refuses nothing."""
    set_field: object = cls.__setattr__
    return set_field is object.__setattr__


def leave_open(cls: Any) -> None:
    """Have a class refuse nothing any more: that its fields are set is left to type checkers to refuse."""
    for name, method in _OPEN.items():
        setattr(cls, name, method)
