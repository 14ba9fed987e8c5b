"""Code that is written for the form of a call: what is looked at, what is taken from it, and what is made of that."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.text import is_changed

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.compat.place import Arguments


class Form:
    """What calls of one form have in common.

    `take` returns what one may differ in from others, None for one of another form; `make` the fields, of that: None
    where code has put something else in the place of what performs substitutions since.
    """

    __slots__ = ("_skeleton", "make", "take")

    def __init__(
        self,
        take: Callable[[dict[str, Any], Arguments], tuple[Any, ...] | None],
        make: Callable[[tuple[Any, ...], Arguments], dict[str, Any] | None],
        skeleton: dict[str, Any],
    ) -> None:
        self.take = take
        self.make = make
        self._skeleton = skeleton

    def given(self, leaves: tuple[Any, ...]) -> dict[str, Any]:
        """Return the keywords that were taken apart, with lists and dictionaries of their own."""
        made: dict[str, Any] = _filled(self._skeleton, leaves)
        return made


class Leaf(int):
    """Where something that may differ stands among all of that."""


def _filled(skeleton: Any, leaves: tuple[Any, ...]) -> Any:
    kind = type(skeleton)
    if kind is Leaf:
        return leaves[skeleton]
    if kind is dict:
        return {name: _filled(item, leaves) for name, item in skeleton.items()}
    return kind(_filled(item, leaves) for item in skeleton) if kind in _SERIES else skeleton


class Level:
    """What is looked at together: types first, then what is inside of it is taken out.

    `other` are the expressions that are true for calls of other forms.
    """

    def __init__(self) -> None:
        self.other: list[str] = []
        self.opened: list[str] = []


class Code:
    """The code for calls of one form while it is written, by the names that it has for what is outside of it.

    `texts` are what must be texts with nothing to look at in them, `needed` those of them that must not be empty;
    `variables` are the lines that take variables of launch files, `others` those that read what has to be read each
    time.
    """

    def __init__(self, known: dict[str, Any]) -> None:
        self.texts: list[str] = []
        self.needed: list[str] = []
        self.variables: list[str] = []
        self.others: list[str] = []
        self._known = known | {"is_changed": is_changed}
        self._levels: list[Level] = []
        self._leaves: list[str] = []
        self._names = 0

    def items(self, level: int, var: str, value: Sequence[Any]) -> list[tuple[str, Any]]:
        """Have the items of a list or a tuple taken out; return them, each with its variable."""
        self.exactly(level, var, type(value))
        names = self.new(len(value))
        self.level(level).opened.append(f"{targets(names)} = {var}" if names else f"() = {var}")
        return list(zip(names, value, strict=True))

    def exactly(self, level: int, var: str, kind: type[Any]) -> None:
        """Have only calls taken in which something is of this type."""
        if kind is type(None):
            other = f"{var} is not None"
        else:  # one by one, which is done sooner than a list of types is made and compared
            other = f"type({var}) is not {kind.__name__ if kind in _BUILT_IN else self.constant(kind)}"
        self.level(level).other.append(other)

    def scalar(self, level: int, var: str) -> None:
        """Have only calls taken in which something is a scalar."""
        self.level(level).other.append(f"type({var}) not in scalars")

    def entries(self, level: int, var: str, value: dict[str, Any]) -> list[tuple[str, str, Any]]:
        """Have the values of a dictionary with such keys taken out; return of each its variable, its key and itself."""
        self.exactly(level, var, dict)
        if not value:
            self.level(level).opened.append(f"if {var}: return None")
            return []
        keys, values = self.new(len(value)), self.new(len(value))
        others = []
        for key, name in zip(keys, map(self.constant, value), strict=True):
            others.append(f"({key} is not {name} and (type({key}) is not str or {key} != {name}))")
        self.level(level).opened += [
            f"{targets(keys)} = {var}",
            f"if {' or '.join(others)}: return None",
            f"{targets(values)} = {var}.values()",
        ]
        return list(zip(values, value, value.values(), strict=True))

    def level(self, level: int) -> Level:
        """Return what is looked at so deep inside of the call."""
        while len(self._levels) <= level:
            self._levels.append(Level())
        return self._levels[level]

    def leaf(self, var: str) -> Leaf:
        """Have something taken that may differ."""
        self._leaves.append(var)
        return Leaf(len(self._leaves) - 1)

    def new(self, count: int) -> list[str]:
        """Return names that nothing has yet."""
        self._names += count
        return [f"x{number}" for number in range(self._names - count, self._names)]

    def constant(self, value: Any) -> str:
        """Return the name of something that all calls of the form have."""
        if value is None or value == ():
            return repr(value)
        name = f"k{len(self._known)}"
        self._known[name] = value
        return name

    def compiled(self, first: str, fields: list[str], skeleton: dict[str, Any]) -> Form:
        """Compile all that has been written."""
        lines = [first]
        for level in self._levels:
            if level.other:
                lines.append(f"if {' or '.join(level.other)}: return None")
            lines += level.opened
        if self.texts:
            lines.append(f'text = f"{{{"}{".join(self.texts)}}}"')
            lines.append('if "$" in text or "\\\\" in text: return None')
        if self.needed:
            lines.append(f"if not ({' and '.join(self.needed)}): return None")
        if self.variables:
            lines.append("if LaunchConfiguration.perform is not perform: return None")
        lines += self.variables
        lines += self.others
        taking = "\n  ".join(lines)
        leaves = targets(self._leaves)
        making = "\n ".join([*self._asked_again(), f"{leaves} = leaves" if leaves else "", *fields])
        text = (
            f"def take(given, call):\n try:\n  {taking}\n except unusual: return None\n return ({leaves})\n"
            f"def make(leaves, call):\n fields = nothing.copy()\n {making}\n return fields\n"
        )
        exec(compile(text, _WRITTEN, "exec"), self._known)  # noqa: S102 - names that are made here
        return Form(self._known["take"], self._known["make"], skeleton)

    def _asked_again(self) -> list[str]:
        """Return what is asked once more when fields are made, which is later."""
        if self.others:
            return ["if is_changed(): return None"]
        return ["if LaunchConfiguration.perform is not perform: return None"] if self.variables else []


def targets(names: Sequence[str]) -> str:
    """Return variables as what a series is assigned to."""
    return "".join(f"{name}, " for name in names).rstrip()


_SERIES: Final = frozenset({list, tuple})
_BUILT_IN: Final = frozenset({str, list, tuple, dict})
# The file of code that is written here: who watches what code does knows by it that it is ours.
_WRITTEN: Final = f"{__file__}: written"
