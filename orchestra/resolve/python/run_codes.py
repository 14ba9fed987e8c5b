"""The code of a text that repeats itself, made of that of one in which most repetitions have been left out.

Of each repetition the compiler makes the same instructions, but for the numbers of constants: an item of a list, or
statements, which leave nothing on the stack. Constants are numbered as they are first used; an instruction for one
whose number takes two bytes is longer. So the instructions of one repetition are written again with the constants of
others, and what comes behind is numbered anew.
"""

from __future__ import annotations

from itertools import repeat
from opcode import EXTENDED_ARG, HAVE_ARGUMENT, hasjabs, hasjrel, opmap, opname, stack_effect
from operator import sub
from types import CodeType
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from orchestra.resolve.python.form_slots import key_of as literal_key
from orchestra.resolve.python.line_tables import NOWHERE, Place, places_of
from orchestra.resolve.python.run_constants import CONSTANTS, Numbers, as_written, built, key_of, leaves_of
from orchestra.resolve.python.run_tables import Entry, Pattern, Table, moved

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.resolve.python.run_texts import Run

# What an item of a list, or a statement, ends with.
_ENDING: Final = {
    opmap[name] for name in ("LIST_APPEND", "POP_TOP", "STORE_FAST", "STORE_GLOBAL", "STORE_NAME")
}
_JUMPING: Final = {*hasjrel, *hasjabs}
_OF_LINES: Final = "__firstlineno__"


def lengthened(code: CodeType, run: Run) -> CodeType:
    """Return the code of a whole text. Raises `ValueError` where something stands against it."""
    made, found = _moved(code, run)
    if found != 1:  # the items of a list of literals are no instructions, but one constant
        raise ValueError("what repeats itself is not in the instructions of one code")
    return made


def _moved(code: CodeType, run: Run) -> tuple[CodeType, int]:
    """Return a code as it is in the whole text, and of how many in it the instructions repeat themselves."""
    if _OF_LINES in code.co_names:
        raise ValueError("a constant is the number of a line")
    inner = {index: _moved(item, run) for index, item in enumerate(code.co_consts) if type(item) is CodeType}
    found = sum(count for _, count in inner.values())
    consts = tuple(inner[index][0] if index in inner else item for index, item in enumerate(code.co_consts))
    if code.co_firstlineno >= run.line:
        return code.replace(co_firstlineno=code.co_firstlineno + run.moved, co_consts=consts), found
    if any(run.line - run.lines <= (line or 0) < run.line for _, _, line in code.co_lines()):
        return _Lengthened(code, consts, run).code(), found + 1
    entries = places_of(code.co_linetable, code.co_firstlineno)
    return code.replace(co_linetable=b"".join(moved(entries, run, run.line)), co_consts=consts), found


class _Instruction(NamedTuple):
    """An instruction with what extends it, and with its room for the interpreter's notes: from a byte to another."""

    op: int
    arg: int
    begin: int
    end: int
    place: Place


def _instructions(code: CodeType) -> Iterator[_Instruction]:
    written = code.co_code
    places = list[Place]()
    for _, count, place in places_of(code.co_linetable, code.co_firstlineno):
        places += [place] * count
    at = begin = arg = 0
    while at < len(written):
        op, arg = written[at], arg << 8 | written[at + 1]
        at += 2
        if op == EXTENDED_ARG:
            continue
        while at < len(written) and written[at] == 0:
            at += 2
        yield _Instruction(op, arg, begin, at, places[begin >> 1])
        begin, arg = at, 0


class _Lengthened:
    """The code in which a text repeats itself; `_begin` is where the last repetition is before what was left out."""

    def __init__(self, code: CodeType, consts: tuple[Any, ...], run: Run) -> None:
        self._code = code
        self._consts = consts
        self._run = run
        self._found = list(_instructions(code))
        firsts = [self._first(run.line - times * run.lines) for times in (3, 2, 1, 0)]
        sizes = set(map(sub, firsts[1:], firsts))
        if len(sizes) > 1:
            raise ValueError("repetitions are of several sizes")
        self._size = sizes.pop()
        self._begin = 1 + max(
            index for index in range(firsts[1], firsts[2]) if self._found[index].op in _ENDING
        )
        self._check()
        self._used: list[int] = []
        self._slots = self._differing()
        if len(set(self._used)) != len(self._used) or len(self._used) != run.differing:
            raise ValueError("a literal has become no constant, or several")
        self._used.sort()

    def _first(self, line: int) -> int:
        return next(index for index, item in enumerate(self._found) if item.place.line >= line)

    def _repetition(self, number: int) -> list[_Instruction]:
        begin = self._begin + number * self._size
        return self._found[begin : begin + self._size]

    def _check(self) -> None:
        """Raise `ValueError` where more than constants and lines differs, or their number decides something."""
        own = self._repetition(0)
        if sum(stack_effect(op, arg if op >= HAVE_ARGUMENT else None) for op, arg, *_ in own):
            raise ValueError("something is left on the stack")
        for number in (-1, 1, 2):
            others = self._repetition(number)
            if [item.op for item in others] != [item.op for item in own]:
                raise ValueError("other instructions")
            lines = number * self._run.lines
            for item, other in zip(own, others, strict=True):
                self._check_place(item.place, other.place, lines)
                if item.op not in CONSTANTS and item.arg != other.arg:
                    raise ValueError("another argument")
        at = own[0].begin >> 1
        for index, (op, arg, _, end, _) in enumerate(self._found):
            is_before = index < self._begin and ("BACKWARD" in opname[op] or (end >> 1) + arg <= at)
            if op in _JUMPING and not is_before:
                raise ValueError("a jump may be of another length")
        if self._code.co_exceptiontable:
            raise ValueError("there are handlers")
        used = [arg for op, arg, *_ in self._found if op in CONSTANTS]
        if list(dict.fromkeys([0, *used])) != list(range(len(self._consts))):
            raise ValueError("constants are numbered in another order")

    def _check_place(self, own: Place, other: Place, lines: int) -> None:
        run = self._run
        if own is NOWHERE or own.column < 0 or own.end < 0:
            raise ValueError("an instruction without a place")
        if own == other:
            if run.line <= own.last < run.line + run.lines or own.line >= run.line:
                raise ValueError("what is around a repetition ends in one")
        elif (own.line + lines, own.last + lines) != other[:2] or own.last >= run.line + run.lines:
            raise ValueError("a repetition on other lines")

    def _differing(self) -> list[tuple[int, list[Any]]]:
        """Return which instructions of a repetition are for constants that differ, and the values of these."""
        others = self._repetition(-1), self._repetition(1), self._repetition(2)
        found = []
        for index, item in enumerate(self._repetition(0)):
            if item.op not in CONSTANTS:
                continue
            values = self._values(self._consts[item.arg], item.place)
            if values is None:
                if any(other[index].arg != item.arg for other in others):
                    raise ValueError("another constant")
                continue
            known = [self._consts[other[index].arg] for other in (others[0], others[2])]
            if list(map(key_of, known)) != [key_of(values[0]), key_of(values[self._run.left_out + 3])]:
                raise ValueError("a constant is another one than the literal")
            found.append((index, values[2 : self._run.left_out + 3]))
        return found

    def _values(self, constant: Any, place: Place) -> list[Any] | None:
        """Return the values of a constant in the repetition before, here and in all further ones; None for the same."""
        run = self._run
        inside = [
            (line, line, begin, end, literal)
            for line, begin, end, literal in run.places
            if place[::2] <= (line, begin) and (line, end) <= place[1::2] and run.text(literal)[0] != "#"
        ]
        literals = [literal for *_, literal in inside]
        differing = [literal for literal in literals if run.differs(literal)]
        leaves = list(leaves_of(constant))
        if not differing or [literal_key(run.text(literal)) for literal in literals] != list(
            map(as_written, leaves)
        ):
            return None
        if type(constant) is not tuple and inside[0][:4] != place:
            return None
        self._used += differing
        columns = iter(
            [
                run.values(literal) if literal in differing else repeat(leaf)
                for literal, leaf in zip(literals, leaves, strict=True)
            ]
        )
        return list(built(constant, columns))

    def code(self) -> CodeType:
        """Return the code of the whole text. Raises `ValueError` where something stands against it."""
        run, begin, size = self._run, self._begin, self._size
        own, written = self._repetition(0), self._code.co_code
        numbers = Numbers(
            self._consts, [item.arg for item in self._found[: begin + size] if item.op in CONSTANTS]
        )
        end = own[-1].end
        found, table = [written[:end]], Table(self._code, end >> 1, own[-1].place.line, run)
        pattern = self._pattern()
        pieces = self._pieces(own)
        operations = [own[index].op for index, _ in self._slots]
        rows = zip(*(values for _, values in self._slots), strict=True)
        widths = zip(*(run.widths(literal)[2:] for literal in self._used), strict=True)
        for times in range(1, run.left_out + 2):
            loads = numbers.loads(operations, next(rows, ()))
            found.append(pieces[0])
            for load, piece in zip(loads, pieces[1:], strict=True):
                found += load, piece
            table.repeat(pattern, times, tuple(map(len, loads)), next(widths, ()))
        for item in self._found[begin + 2 * size :]:
            load = written[item.begin : item.end]
            if item.op in CONSTANTS:
                (load,) = numbers.loads((item.op,), (self._consts[item.arg],))
            found.append(load)
            table.add(len(load) >> 1, item.place)
        return self._code.replace(
            co_code=b"".join(found), co_consts=tuple(numbers.consts), co_linetable=table.written()
        )

    def _pieces(self, own: Sequence[_Instruction]) -> list[bytes]:
        """Return what stands between the constants that differ."""
        written, found, at = self._code.co_code, [], own[0].begin
        for index, _ in self._slots:
            found.append(written[at : own[index].begin])
            at = own[index].end
        return [*found, written[at : own[-1].end]]

    def _pattern(self) -> Pattern:
        """Return how a repetition is written in the table. Raises `ValueError` where another one is not like that."""
        run, own = self._run, self._repetition(0)
        slots = {index: number for number, (index, _) in enumerate(self._slots)}
        before, behind = self._repetition(-1), self._repetition(2)
        entries = [
            Entry(
                (item.end - item.begin) >> 1, slots.get(index), item.place, item.place == before[index].place
            )
            for index, item in enumerate(own)
        ]
        at = {literal: (line, column) for line, column, _, literal in run.places}
        widths = [run.widths(literal) for literal in self._used]
        pattern = Pattern(
            entries, [at[literal] for literal in self._used], [known[1] for known in widths], run
        )
        for others, number in ((before, 0), (behind, run.left_out + 3)):
            moved = pattern.places([known[number] for known in widths])
            if [place[2:] for place in moved] != [item.place[2:] for item in others]:
                raise ValueError("other columns")
        return pattern
