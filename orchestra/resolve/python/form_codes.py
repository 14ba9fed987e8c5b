"""The code of a text in which marks stand for literals, as what makes the codes of texts with other literals."""

from __future__ import annotations

from operator import sub
from types import CodeType
from typing import TYPE_CHECKING, Any, Final

from orchestra.resolve.python.form_slots import Name

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence

    from orchestra.resolve.python.line_tables import LineTable

MARK: Final = "qzMarkOfAForm"
_NUMBER: Final = 731_935_000_000
_DIGITS: Final = "731935"
_MORE_ARGUMENTS: Final = (0x04, 0x08)  # flags of codes that take any arguments, and any keywords
_ALIKE: Final = (
    *("co_name", "co_qualname", "co_firstlineno", "co_flags", "co_stacksize", "co_nlocals"),
    *("co_argcount", "co_posonlyargcount", "co_kwonlyargcount", "co_names", "co_cellvars"),
    *("co_freevars", "co_code", "co_exceptiontable"),
)


class Marks:
    """What stands for literals, by its number, in a text in which it is not: it is as long as none of them."""

    def __init__(self, values: Sequence[object]) -> None:
        self.values: list[Any] = [_mark(value, number) for number, value in enumerate(values)]
        self.seen: set[int] = set()
        self._numbers = {
            mark: number for number, mark in enumerate(self.values) if not isinstance(mark, Name)
        }
        self._names = {str(mark): number for number, mark in enumerate(self.values) if isinstance(mark, Name)}
        self._own = values

    def variables(self, marked: CodeType, code: CodeType) -> list[tuple[int, int]]:
        """Return which variables of a code are marks, and which ones.

        Raises `ValueError` where others are not those of the code without marks, or a mark is one of two codes.
        """
        found = [
            (index, self._names[name]) for index, name in enumerate(marked.co_varnames) if name in self._names
        ]
        names = list(marked.co_varnames)
        for index, number in found:
            names[index] = str(self._own[number])
        if tuple(names) != code.co_varnames or not self.seen.isdisjoint(number for _, number in found):
            raise ValueError("a name has become another variable")
        self.seen.update(number for _, number in found)
        return found

    def number(self, constant: object) -> int | None:
        """Return the number of a mark, None for another constant. Raises `ValueError` for what was made of one."""
        kind = type(constant)
        if kind in (str, int, float):
            number = self._numbers.get(constant)
            if number is not None:
                self.seen.add(number)
                return number
            if kind is str and MARK not in constant:  # type: ignore[operator] # it is a text
                return None
        if may_be_marked(repr(constant)):
            raise ValueError(constant)
        return None


def _mark(value: object, number: int) -> Any:
    if isinstance(value, Name):
        end = f"{_DIGITS}{number:06}"
        before = value.rstrip("0123456789")
        return Name(before + (end if len(before + end) != len(value) else f"{end}0"))
    if isinstance(value, str):
        mark = f"{MARK}{number}"
        return mark if len(mark) != len(value) else f"{mark}_"
    marked = _NUMBER + number
    if isinstance(value, float):
        return marked + 0.5 if len(f"{marked}.5") != len(repr(value)) else marked + 0.25
    return marked if len(str(marked)) != len(str(value)) else 10 * marked


def may_be_marked(text: str) -> bool:
    """Return whether a text has in it what marks are told by."""
    return MARK in text or _DIGITS in text


class Columns:
    """How far columns move with the literals before them on a line; literals are numbered from 1."""

    def __init__(self, parts: Sequence[str], places: Collection[int]) -> None:
        """Take the places of literals in a text that was split."""
        self._before: dict[int, list[tuple[int, int]]] = {}
        self._widths: list[int] = []
        self._begin: list[bool] = []
        self.to_marks: list[int] = []
        line, column = 1, 0
        for index, part in enumerate(parts):
            if index & 1 and index // 2 in places:
                self._begin.append(line not in self._before)
                self._widths.append(len(part))
                self._before.setdefault(line, []).append((column, len(self._widths)))
            lines = part.count("\n")
            line += lines
            column = len(part) - part.rfind("\n") - 1 if lines else column + len(part)

    def number(self, line: int, column: int) -> int:
        """Return the number of the last literal of a line that begins before a column, 0 for none."""
        found = 0
        for begin, number in self._before.get(line, ()):
            if begin >= column:
                break
            found = number
        return found

    def shifts(self, literals: Sequence[str]) -> list[int] | None:
        """Return by the numbers of literals how far what follows moves with others in their place; None where not."""
        widths = list(map(len, literals))
        if widths == self._widths:
            return None
        found, before = [0], 0
        for moved, begins in zip(map(sub, widths, self._widths), self._begin, strict=True):
            before = moved if begins else before + moved
            found.append(before)
        return found


class CodeForm:
    """A code whose constants are marks, or hold some: others are put in their place.

    What constants are made of is numbered: the values of marks, then what is fixed, then codes, then what holds some of
    those.
    """

    def __init__(self, code: CodeType, marked: CodeType, marks: Marks, columns: Columns) -> None:
        """Take a code apart, by that of its text with marks. Raises `ValueError` where a mark is part of a constant."""
        if any(getattr(code, name) != getattr(marked, name) for name in _ALIKE):
            raise ValueError("a mark has become more than a constant")
        self._code = code
        self._marked = marked
        self._columns = columns
        self._table: LineTable | None = None
        self._variables = marks.variables(marked, code)
        constants = marked.co_consts
        self._fixed = [item for constant in constants for item in _fixed(constant, marks)]
        pairs = zip(code.co_consts, constants, strict=True)
        self._codes = [
            CodeForm(own, item, marks, columns) for own, item in pairs if isinstance(item, CodeType)
        ]
        self._series: list[list[int]] = []
        first = len(marks.values)
        codes = first + len(self._fixed)
        self._behind = codes + len(self._codes)
        numbers = iter(range(first, codes)), iter(range(codes, self._behind))
        self._order = [self._number(item, marks, *numbers) for item in constants]

    def _number(self, constant: object, marks: Marks, fixed: Iterator[int], codes: Iterator[int]) -> int:
        if isinstance(constant, CodeType):
            return next(codes)
        if not isinstance(constant, tuple):  # the order of a set depends on what is in it
            number = marks.number(constant)
            return next(fixed) if number is None else number
        held = [self._number(item, marks, fixed, codes) for item in constant]
        self._series.append(held)
        return self._behind + len(self._series) - 1

    @property
    def fixed(self) -> set[Any]:
        """The texts and numbers among the constants that are no marks, a number with its type."""
        own = {item if type(item) is str else (type(item), item) for item in self._fixed}
        return own.union(*(form.fixed for form in self._codes))

    def made(self, path: str, values: list[Any], shifts: list[int] | None) -> CodeType:
        """Return the code for other values, at a path; `shifts` are those of columns, by their numbers.

        Raises `ValueError` where the compiler's way to write positions is not known.
        """
        known = values + self._fixed
        known += [form.made(path, values, shifts) for form in self._codes]
        for held in self._series:
            known.append(tuple(map(known.__getitem__, held)))
        names = self._code.co_varnames
        if self._variables:
            changed = list(names)
            for index, number in self._variables:
                changed[index] = str(values[number])
            names = tuple(changed)
        return self._code.replace(
            co_filename=path,
            co_varnames=names,
            co_consts=tuple(map(known.__getitem__, self._order)),
            co_linetable=self._code.co_linetable if shifts is None else self._lines(shifts),
        )

    def _lines(self, shifts: list[int]) -> bytes:
        if self._table is None:
            # Here, because literals are as long as those before in many trees.
            from orchestra.resolve.python.line_tables import LineTable  # noqa: PLC0415

            code, columns = self._code, self._columns
            table = LineTable(code.co_linetable, code.co_firstlineno, columns.number)
            if table.moved(columns.to_marks) != self._marked.co_linetable:
                raise ValueError("positions are written in another way")
            self._table = table
        return self._table.moved(shifts)


def _fixed(constant: object, marks: Marks) -> Iterator[Any]:
    if isinstance(constant, tuple):
        for item in constant:
            yield from _fixed(item, marks)
    elif not isinstance(constant, CodeType) and marks.number(constant) is None:
        yield constant


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
