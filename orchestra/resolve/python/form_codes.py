"""The code of a text, as what makes the codes of texts with other literals: by another one that is alike."""

from __future__ import annotations

from bisect import bisect_left
from itertools import accumulate
from operator import sub
from types import CodeType
from typing import TYPE_CHECKING, Any, Final

from orchestra.resolve.python.form_slots import Name
from orchestra.resolve.python.form_texts import taking

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Sequence

    from orchestra.resolve.python.line_tables import LineTable

_MORE_ARGUMENTS: Final = (0x04, 0x08)  # flags of codes that take any arguments, and any keywords
_VALUE, _FIXED, _CODE, _SERIES = "value", "fixed", "code", "series"
_ALIKE: Final = (
    *("co_name", "co_qualname", "co_firstlineno", "co_flags", "co_stacksize", "co_nlocals"),
    *("co_argcount", "co_posonlyargcount", "co_kwonlyargcount", "co_names", "co_cellvars"),
    *("co_freevars", "co_code", "co_exceptiontable"),
)


class Classes:
    """The values that stand in the slots of two texts, by their numbers: what differs in the codes of these."""

    def __init__(self, own: Sequence[Any], others: Sequence[Any]) -> None:
        self.count = len(own)
        self._numbers = {key: number for number, key in enumerate(own)}
        self._others = others
        self._seen: set[int] = set()

    def check(self) -> None:
        """Raise `ValueError` where a value has become no constant and no variable."""
        if len(self._seen) != self.count:
            raise ValueError("a literal has become no constant")

    def variables(self, own: CodeType, other: CodeType) -> list[tuple[int, int]]:
        """Return which variables of a code are values, and which ones.

        Raises `ValueError` where others differ, or a value is a variable of two codes.
        """
        found = []
        for index, names in enumerate(zip(own.co_varnames, other.co_varnames, strict=True)):
            number = self._number((Name, names[0]), (Name, names[1]))
            if number is not None:
                found.append((index, number))
            elif names[0] != names[1]:
                raise ValueError("a name has become another variable")
        numbers = {number for _, number in found}
        if not self._seen.isdisjoint(numbers):
            raise ValueError("a name is a variable of two codes")
        self._seen |= numbers
        return found

    def number(self, own: object, other: object) -> int | None:
        """Return the number of a constant that is a value, None for one that both codes have.

        Raises `ValueError` for what differs otherwise.
        """
        number = self._number(_key(own), _key(other))
        if number is None:
            if type(own) is not type(other) or repr(own) != repr(other):
                raise ValueError(own)
            return None
        self._seen.add(number)
        return number

    def _number(self, own: Any, other: Any) -> int | None:
        number = self._numbers.get(own)
        if number is not None and self._others[number] != other:
            raise ValueError(own)
        return number


def _key(constant: Any) -> Any:
    return constant if type(constant) is str else (type(constant), constant)


class Columns:
    """How far columns move with the literals before them on a line; literals are numbered from 1."""

    def __init__(self, parts: Sequence[str], places: Iterable[int]) -> None:
        """Take the places of literals in a text that was split, in their order."""
        # By lines: where literals begin, and the number of the one before the first of them.
        self._before: dict[int, tuple[list[int], int]] = {}
        self._begin: list[bool] = []
        text, ends = "".join(parts), list(accumulate(map(len, parts)))
        line, last = 1, 0
        for place in places:
            at = ends[2 * place]
            line += text.count("\n", last, at)
            last = at
            begins, _ = self._before.setdefault(line, ([], len(self._begin)))
            self._begin.append(not begins)
            begins.append(at - text.rfind("\n", 0, at) - 1)

    @property
    def lines(self) -> Collection[int]:
        """The lines on which a literal is."""
        return self._before.keys()

    def number(self, line: int, column: int) -> int:
        """Return the number of the last literal of a line that begins before a column, 0 for none."""
        known = self._before.get(line)
        if known is None:
            return 0
        before = bisect_left(known[0], column)
        return known[1] + before if before else 0

    def shifts(self, widths: Sequence[int], own: Sequence[int]) -> list[int] | None:
        """Return by the numbers of literals how far what follows moves with other widths; None where not."""
        if widths == own:
            return None
        found, before = [0], 0
        for moved, begins in zip(map(sub, widths, own), self._begin, strict=True):
            before = moved if begins else before + moved
            found.append(before)
        return found


class CodeForm:
    """A code with some of its constants and variables numbered: others are put in their place.

    What constants are made of is numbered: the values that differ, then what is fixed, then codes, then what holds
    some of those.
    """

    def __init__(self, code: CodeType, other: CodeType, classes: Classes, columns: Columns) -> None:
        """Take a code apart, by another one. Raises `ValueError` where they differ in more than the values of slots."""
        if any(getattr(code, name) != getattr(other, name) for name in _ALIKE):
            raise ValueError("a literal has become more than a constant")
        self._code = code
        self._columns = columns
        self._table: LineTable | None = None
        self._variables = classes.variables(code, other)
        self._fixed: list[Any] = []
        self._codes: list[CodeForm] = []
        self._series: list[list[tuple[str, int]]] = []
        places = [self._place(*pair, classes) for pair in zip(code.co_consts, other.co_consts, strict=True)]
        fixed = classes.count
        codes = fixed + len(self._fixed)
        self._begins = {_VALUE: 0, _FIXED: fixed, _CODE: codes, _SERIES: codes + len(self._codes)}
        self._taking = [taking(list(map(self._number, held))) for held in self._series]
        self._constants = taking(list(map(self._number, places)))

    def _place(self, own: Any, other: Any, classes: Classes) -> tuple[str, int]:
        """Return among what a constant is numbered, and its number there."""
        if isinstance(own, CodeType):
            self._codes.append(CodeForm(own, other, classes, self._columns))
            return _CODE, len(self._codes) - 1
        if isinstance(own, frozenset):
            raise ValueError("the order of a set depends on what is in it")  # noqa: TRY004 - no mistake of a caller
        if isinstance(own, tuple):
            held = [self._place(*pair, classes) for pair in zip(own, other, strict=True)]
            if any(among != _FIXED for among, _ in held):
                self._series.append(held)
                return _SERIES, len(self._series) - 1
        number = None if isinstance(own, tuple) else classes.number(own, other)
        if number is not None:
            return _VALUE, number
        self._fixed.append(own)
        return _FIXED, len(self._fixed) - 1

    def _number(self, place: tuple[str, int]) -> int:
        return self._begins[place[0]] + place[1]

    @property
    def fixed(self) -> set[Any]:
        """The texts and numbers among the constants that are no values, a number with its type."""
        own = set(map(_key, self._fixed))
        return own.union(*(form.fixed for form in self._codes))

    def made(self, path: str, values: list[Any], shifts: list[int] | None) -> CodeType:
        """Return the code for other values, at a path; `shifts` are those of columns, by their numbers."""
        known = values + self._fixed
        known += [form.made(path, values, shifts) for form in self._codes]
        for held in self._taking:
            known.append(held(known))
        names = self._code.co_varnames
        if self._variables:
            changed = list(names)
            for index, number in self._variables:
                changed[index] = str(values[number])
            names = tuple(changed)
        return self._code.replace(
            co_filename=path,
            co_varnames=names,
            co_consts=self._constants(known),
            co_linetable=self._code.co_linetable if shifts is None else self._lines(shifts),
        )

    def _lines(self, shifts: list[int]) -> bytes:
        if self._table is None:
            # Here, because literals are as long as those before in many trees.
            from orchestra.resolve.python.line_tables import LineTable  # noqa: PLC0415

            code, columns = self._code, self._columns
            self._table = LineTable(code.co_linetable, code.co_firstlineno, columns.lines, columns.number)
        return self._table.moved(shifts)


def variables(code: CodeType) -> set[str]:
    """Return the variables of functions that nothing else in a code knows by their names."""
    own, others = _variables(code)
    return {name for name in own if own.count(name) == 1} - others


def _variables(code: CodeType) -> tuple[list[str], set[str]]:
    """Return the variables of the functions in a code, and all other names."""
    given = (
        code.co_argcount
        + code.co_kwonlyargcount
        + sum(bool(code.co_flags & flag) for flag in _MORE_ARGUMENTS)
    )
    own = list(code.co_varnames[given:])
    others = {*code.co_varnames[:given], *code.co_names, *code.co_cellvars, *code.co_freevars}
    for item in code.co_consts:
        if isinstance(item, CodeType):
            more, known = _variables(item)
            own, others = own + more, others | known
    return own, others


def is_same(made: CodeType, other: CodeType) -> bool:
    """Return whether two codes are the same in all that the compiler says of them."""
    if len(made.co_consts) != len(other.co_consts):
        return False
    if any(
        getattr(made, name) != getattr(other, name)
        for name in (*_ALIKE, "co_varnames", "co_linetable", "co_filename")
    ):
        return False
    return all(map(_is_same_constant, made.co_consts, other.co_consts))


def _is_same_constant(made: object, other: object) -> bool:
    if isinstance(made, CodeType) and isinstance(other, CodeType):
        return is_same(made, other)
    if isinstance(made, frozenset) and isinstance(other, frozenset):
        return sorted(map(repr, made)) == sorted(map(repr, other))
    return type(made) is type(other) and repr(made) == repr(other)
