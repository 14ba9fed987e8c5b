"""Classes with fields behave as those of the standard library do."""

from __future__ import annotations

import ast
import copy
import dataclasses
import inspect
import pickle
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.dataclass import dataclass, maker
from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Callable

_ROOT = Path(__file__).parents[1]
_OF_THEIR_OWN = {"orchestra/dataclass.py"}


@dataclass(frozen=True, slots=True)
class Frozen:
    """A record."""

    name: str
    many: tuple[int, ...] = ()
    made: list[int] = dataclasses.field(default_factory=list, compare=False)
    hidden: int = dataclasses.field(default=7, repr=False, init=False)


@dataclass(frozen=True, slots=True)
class Inherited(Frozen):
    """One more field."""

    more: str = "more"

    def __post_init__(self) -> None:
        object.__setattr__(self, "more", self.more.upper())


@dataclass(slots=True)
class Plain:
    """Changes."""

    count: int
    names: set[str] = dataclasses.field(default_factory=set)


@dataclass(frozen=True, slots=True, eq=False)
class Itself:
    """Is equal to itself alone."""

    value: int


@dataclass(frozen=True, order=True)
class Ordered:
    """Has an order."""

    first: int
    second: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Named:
    """Is made by names."""

    value: int
    other: int = 2


@dataclass(frozen=True, slots=True)
class Compared:
    """Says itself what it is equal to."""

    value: int

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Compared)

    def __hash__(self) -> int:
        return 1


_CLASSES: list[type[Any]] = [Frozen, Inherited, Plain, Itself, Ordered, Named, Compared]
_OPTIONS: dict[type[Any], dict[str, Any]] = {
    Frozen: {"frozen": True, "slots": True},
    Plain: {"slots": True},
    Itself: {"frozen": True, "slots": True, "eq": False},
    Ordered: {"frozen": True, "order": True},
    Named: {"frozen": True, "slots": True, "kw_only": True},
}


def _standard(cls: type[Any]) -> Any:
    """Return what the standard library makes of the same fields."""
    written = [
        (
            item.name,
            item.type,
            dataclasses.field(
                default=item.default,
                default_factory=item.default_factory,
                init=item.init,
                repr=item.repr,
                compare=item.compare,
            ),
        )
        for item in dataclasses.fields(cls)
    ]
    return dataclasses.make_dataclass(cls.__name__, written, **_OPTIONS[cls])


_CALLS: list[tuple[type[Any], tuple[Any, ...], dict[str, Any]]] = [
    (Frozen, ("a",), {}),
    (Frozen, ("a", (1, 2)), {"made": [3]}),
    (Frozen, (), {"name": "a", "many": (1,)}),
    (Plain, (1,), {}),
    (Plain, (1, {"x"}), {}),
    (Ordered, (1, 2), {}),
    (Named, (), {"value": 1}),
    (Named, (), {"value": 1, "other": 3}),
    # Wrongly made.
    (Frozen, (), {}),
    (Frozen, ("a",), {"hidden": 1}),
    (Frozen, ("a",), {"other": 1}),
    (Ordered, (1,), {}),
    (Ordered, (1, 2, 3), {}),
    (Named, (1,), {}),
]


def _told(call: Callable[[], object]) -> str:
    try:
        return str(call()).replace("types.", "")
    except TypeError as error:
        return str(error)


@pytest.mark.parametrize(("cls", "words", "named"), _CALLS)
def test_they_are_made_shown_and_refused_in_the_same_words(
    cls: type[Any], words: tuple[Any, ...], named: dict[str, Any]
) -> None:
    assert _told(lambda: cls(*words, **named)) == _told(lambda: _standard(cls)(*words, **named))


@pytest.mark.parametrize("cls", list(_OPTIONS))
def test_their_signatures_are_the_same(cls: type[Any]) -> None:
    wanted = inspect.signature(_standard(cls))
    assert list(inspect.signature(cls).parameters) == list(wanted.parameters)
    assert [item.kind for item in inspect.signature(cls).parameters.values()] == [
        item.kind for item in wanted.parameters.values()
    ]


def test_they_are_equal_by_the_fields_that_count() -> None:
    assert Frozen("a", (1,), [1]) == Frozen("a", (1,), [2])
    assert hash(Frozen("a", (1,), [1])) == hash(Frozen("a", (1,), [2]))
    assert hash(Frozen("a", (1,))) == hash(_standard(Frozen)("a", (1,)))
    assert Frozen("a") != Frozen("b")
    assert Frozen("a") != Inherited("a")
    assert Plain(1) == Plain(1)
    assert Itself(1) != Itself(1)
    assert Compared(1) == Compared(2)
    assert hash(Compared(1)) == 1
    nan = float("nan")
    assert Frozen("a", nan) == Frozen("a", nan)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="unhashable"):
        hash(Plain(1))


def test_they_have_an_order_where_it_is_asked_for() -> None:
    assert sorted([Ordered(2, 1), Ordered(1, 2), Ordered(1, 1)]) == [
        Ordered(1, 1),
        Ordered(1, 2),
        Ordered(2, 1),
    ]
    assert Ordered(1, 1) <= Ordered(1, 1) >= Ordered(1, 0)
    with pytest.raises(TypeError):
        Plain(1) < Plain(2)  # type: ignore[operator] # noqa: B015


@pytest.mark.parametrize("record", [Frozen("a"), Inherited("a"), Ordered(1, 2)])
def test_what_is_frozen_stays(record: Any) -> None:
    name = dataclasses.fields(record)[0].name
    with pytest.raises(dataclasses.FrozenInstanceError, match=f"cannot assign to field '{name}'"):
        setattr(record, name, "b")
    with pytest.raises(dataclasses.FrozenInstanceError, match=f"cannot delete field '{name}'"):
        delattr(record, name)


@pytest.mark.parametrize("record", [Frozen("a", (1,)), Inherited("a"), Plain(1, {"x"}), Ordered(1, 2)])
def test_they_are_copied_pickled_and_replaced(record: Any) -> None:
    assert copy.copy(record) == record
    assert copy.deepcopy(record) == record
    assert pickle.loads(pickle.dumps(record)) == record  # noqa: S301 - made on the same line
    assert dataclasses.replace(record) == record
    assert dataclasses.is_dataclass(record)
    shown: Any = dataclasses.asdict
    assert shown(record) == {item.name: getattr(record, item.name) for item in dataclasses.fields(record)}


def test_they_inherit() -> None:
    assert (Inherited("a", more="B").more, Inherited("a").hidden) == ("B", 7)
    assert str(Inherited("a")) == "Inherited(name='a', many=(), made=[], more='MORE')"
    match Frozen("a", (1,)):
        case Frozen(name, many):
            assert (name, many) == ("a", (1,))


def test_nothing_is_compiled_before_some_are_made() -> None:
    @dataclass(frozen=True, slots=True)
    class Fresh:
        value: int

    first = [Fresh(number) for number in range(3)]
    assert type(vars(Fresh)["__init__"]).__name__ == "_Late"
    more = [Fresh(number) for number in range(3)]
    assert inspect.isfunction(vars(Fresh)["__init__"])
    assert first == more


@pytest.mark.parametrize(("cls", "words", "named"), _CALLS)
def test_the_first_are_made_as_the_later_ones(
    cls: type[Any], words: tuple[Any, ...], named: dict[str, Any]
) -> None:
    """Each class is made anew, so that nothing is compiled yet."""
    written = [
        (item.name, item.type, dataclasses.field(default=item.default, default_factory=item.default_factory))
        for item in dataclasses.fields(cls)
        if item.init
    ]
    namespace = {"__annotations__": {name: kind for name, kind, _ in written}, "__module__": __name__}
    fresh: Any = dataclass(**_OPTIONS[cls])(
        type(
            cls.__name__, (), {**namespace, **{name: item for name, _, item in written if _has_default(item)}}
        )
    )
    told = [_told(lambda: fresh(*words, **named)) for _ in range(6)]
    assert len(set(told)) == 1


def test_what_is_replaced_is_not_asked_for() -> None:
    """It may be worked out only when somebody does."""
    halfway = object.__new__(Ordered)
    first, *others = dataclasses.fields(Ordered)
    for item in others:
        object.__setattr__(halfway, item.name, 2)
    replaced = replace(halfway, **{first.name: 1})
    assert [getattr(replaced, item.name) for item in (first, *others)] == [1, *[2] * len(others)]
    with pytest.raises(AttributeError):
        replace(halfway)


def _has_default(item: Any) -> bool:
    return item.default is not dataclasses.MISSING or item.default_factory is not dataclasses.MISSING


def test_everything_of_ours_is_made_so() -> None:
    wrong = [
        str(path.relative_to(_ROOT))
        for path in sorted((_ROOT / "orchestra").glob("**/*.py"))
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.ImportFrom)
        and node.module == "dataclasses"
        and "dataclass" in [alias.name for alias in node.names]
    ]
    assert set(wrong) <= _OF_THEIR_OWN


@dataclass(frozen=True, slots=True)
class Made:
    """Has a maker."""

    name: str
    many: tuple[int, ...] = ()
    made: list[int] = dataclasses.field(default_factory=list, compare=False)
    hidden: int = dataclasses.field(default=7, repr=False, init=False)


@dataclass(frozen=True, slots=True)
class MadeToo(Made):
    """One more field."""

    more: str = "more"


_make, _make_too = maker(Made), maker(MadeToo)


def test_what_a_maker_makes_is_what_the_class_makes() -> None:
    for _ in range(5):  # the first few are made by the class
        assert _make("a", (1,)) == Made("a", (1,))
        assert _make_too("a", more="B") == MadeToo("a", more="B")
    assert _make_too("a", more="B") == dataclasses.replace(_make_too("a"), more="B") == MadeToo("a", more="B")
    assert (type(_make_too("a")), _make_too("a").hidden) == (MadeToo, 7)
    assert (hash(_make("a")), repr(_make("a"))) == (hash(Made("a")), repr(Made("a")))
    assert pickle.loads(pickle.dumps(_make("a"))) == copy.copy(_make("a")) == Made("a")  # noqa: S301 - just made
    assert _make("a") != _make_too("a")
    _make("a").made.append(1)
    assert not _make("a").made
    with pytest.raises(TypeError):
        _make()  # type: ignore[call-arg] # refused at run time too


def test_what_makes_objects_quickly_is_made_where_their_class_is() -> None:
    """It decides for everybody whether fields are refused at run time, whatever else is imported."""
    elsewhere = []
    for path in sorted((_ROOT / "orchestra").glob("**/*.py")):
        nodes = list(ast.walk(ast.parse(path.read_text("utf-8"))))
        imported = [node for node in nodes if isinstance(node, ast.ImportFrom)]
        if not any(node.module == "orchestra.dataclass" and "maker" in _names(node) for node in imported):
            continue
        classes = {node.name for node in nodes if isinstance(node, ast.ClassDef)}
        made = {
            ast.unparse(node.args[0])
            for node in nodes
            if isinstance(node, ast.Call) and ast.unparse(node.func) == "maker"
        }
        elsewhere += [f"{path.stem}: {name}" for name in made - classes]
    assert elsewhere == []


def _names(node: ast.ImportFrom) -> list[str]:
    return [alias.name for alias in node.names]
