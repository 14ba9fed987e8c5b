"""Whether a launch file may have certain mistakes, as a short look tells: to find them takes a syntax tree."""

from __future__ import annotations

import re
from functools import cache
from operator import ne
from types import CodeType, FunctionType
from typing import TYPE_CHECKING, Final

from orchestra.compat.idle_names import may_have_idle_actions
from orchestra.compat.signs import codes_in, goes_through, has_event_functions, has_idle_logic, sets_tuples

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    from orchestra.compat.signs import Codes
    from orchestra.errors import Problems
    from orchestra.location import Span

_PIECE: Final = 16  # names of a dictionary that are one constant, at most
_KEY: Final = re.compile(rb"""[{}]|(['"])([^'"\n\\]+)\1\s*:""")
_SIGN: Final = re.compile(rb"""oin(?:Substitution)?\((?:[^()]|\([^()]*\))*?,\s*['"]/""")
# A line outside of functions in which a dictionary may stand, or behind which a part of the same statement does.
_OUTSIDE: Final = re.compile(
    rb"\n(?!from |import |[#\s])(?:.*(?:\{|[(\[,\\][ \t\r]*$)"
    rb"|(?:async|class|el|except|finally|for|if|match|try|w[hi]))",
    re.MULTILINE,
)
# The end of a word in quotes, and the beginning of another one.
_SIDE_BY_SIDE: Final = re.compile(rb"""['"](?<=[^\s"'\\=:].)\s+['"][\w/-]""")
_ALIKE: Final = bytes.maketrans(b"\t\n\v\f\r'", b'     "')  # one blank and one quote
_ENDED: Final = b'" '


class Compiled:
    """The code of a file, its text, and what short looks at both have told: it is kept with the code.

    A look that a file's functions are needed for is longer; what is told of the code as a whole may be more than that.
    """

    __slots__ = ("code", "source", "told")

    def __init__(self, code: CodeType, source: bytes, told: dict[str, bool]) -> None:
        self.code = code
        self.source = source
        self.told = told

    @property
    def is_sound(self) -> bool:
        """Return whether each look has been taken, and none has found what may be a mistake."""
        return self.told in (_SOUND, _SOUND_AT_WORK)

    def may(self, look: str) -> bool:
        """Return what one of the `LOOKS` tells."""
        known = self.told.get(look)
        if known is None:
            known = self.told[look] = LOOKS[look](self.code, self.source)
        return known


def has_foreign(source: bytes) -> bool:
    """Return whether a substitution of another language may stand in the text of a file."""
    has_call = b"$" in source and b"$(" in source
    return has_call or b"'LaunchConfiguration(" in source or b'"LaunchConfiguration(' in source


def has_doubled_keys(module: ModuleType, source: bytes) -> bool:
    """Return whether a name may stand twice in a dictionary of a file, of which this is the text.

    The names of a short dictionary are one constant; those of a long one are added to it one after the other.
    """
    codes = (item.__code__ for item in vars(module).values() if type(item) is FunctionType)
    return _may_double([code for code in codes if code.co_filename == module.__file__], source)


def _may_double(own: list[CodeType], source: bytes) -> bool:
    known = list(map(codes_in, own))
    if any(map(_repeats, known)):
        return True
    may_stand = any(map(_lists_names, known)) or _OUTSIDE.search(b"\n" + source) is not None
    return may_stand and source.count(b"':") + source.count(b'":') > _PIECE and _doubles(source)


def _repeats(codes: Codes) -> bool:
    """Return whether a text is twice in one constant."""
    tuples = codes.tuples
    different = map(len, map(set, tuples))
    return any(map(ne, different, map(len, tuples))) and any(map(_repeats_text, tuples))


def _repeats_text(items: tuple[object, ...]) -> bool:
    """Return whether a text is twice among others, as numbers often are."""
    texts = [item for item in items if type(item) is str]
    return len(set(texts)) < len(texts)


def _lists_names(codes: Codes) -> bool:
    """Return whether a dictionary is made of names that are not one constant."""
    adding, building = _instructions()
    return adding in codes.operations or any(
        building.search(written) is not None for written in codes.written
    )


@cache
def _instructions() -> tuple[int, re.Pattern[bytes]]:
    """Return the operation that adds to a dictionary, and the instructions that make one of several names at once."""
    from opcode import opmap  # noqa: PLC0415 - once

    several = b"[" + re.escape(bytes(range(2, _PIECE))) + b"]"
    return opmap["MAP_ADD"], re.compile(re.escape(bytes((opmap["BUILD_MAP"],))) + several)


def _doubles(source: bytes) -> bool:
    """Return whether a name stands twice between the same braces, as far as a look at the text tells."""
    around: list[set[bytes]] = []
    for sign in _KEY.finditer(source):
        key = sign[2]
        if key is None:
            if sign[0] == b"{":
                around.append(set())
            elif around:
                around.pop()
        elif around:
            if key in around[-1]:
                return True
            around[-1].add(key)
    return False


def has_late_roots(source: bytes) -> bool:
    """Return whether a later part of a path may begin with a slash."""
    return _SIGN.search(source) is not None


def has_joined_words(source: bytes) -> bool:
    """Return whether a word may stand in quotes right behind another one."""
    alike = source.translate(_ALIKE)
    place = alike.find(_ENDED)
    while place >= 0:
        if _SIDE_BY_SIDE.match(source, place) is not None:
            return True
        place = alike.find(_ENDED, place + 1)
    return False


def _changes_nothing(code: CodeType, _source: bytes) -> bool:
    # Here, because it is kept with the code.
    from orchestra.witness.harmless import changes_nothing  # noqa: PLC0415

    return changes_nothing(code)


def _may_be_misused(code: CodeType, source: bytes) -> bool:
    # Here, as above.
    from orchestra.compat.misused import may_be_misused  # noqa: PLC0415

    return may_be_misused(code, source)


# Each look by its name: whether a file may change something, or have mistakes of a kind.
LOOKS: Final[dict[str, Callable[[CodeType, bytes], bool]]] = {
    "harmless": _changes_nothing,
    "idle": may_have_idle_actions,
    "foreign": lambda _, source: has_foreign(source),
    "doubled": lambda code, source: _may_double([code], source),
    "roots": lambda _, source: has_late_roots(source),
    "joined": lambda _, source: has_joined_words(source),
    "tuples": sets_tuples,
    "events": has_event_functions,
    "logic": has_idle_logic,
    "through": goes_through,
    "misused": _may_be_misused,
}
# What they tell of a file without mistakes: most of them change nothing.
_SOUND: Final = {look: look == "harmless" for look in LOOKS}
_SOUND_AT_WORK: Final = dict.fromkeys(LOOKS, False)
# By the looks that say whether a file may have such slips: the modules that tell of them.
_OF_TEXTS: Final = {
    "foreign": "foreign_substitutions",
    "roots": "late_roots",
    "joined": "joined_words",
    "tuples": "trailing_commas",
    "events": "event_functions",
    "through": "gone_through",
    "logic": "idle_logic",
}


def tell_misused(compiled: Compiled, path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of what code of a file misuses; `chain` are the includes on the way."""
    if compiled.may("misused"):
        from orchestra.compat.misused import tell  # noqa: PLC0415 - only what may be a mistake needs it

        tell(compiled.code, compiled.source, path, problems, chain)


def tell_slips(compiled: Compiled, path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of slips in the texts of a file; `chain` are the includes on the way."""
    for look, module in _OF_TEXTS.items():
        if compiled.may(look):
            from importlib import import_module  # noqa: PLC0415 - as above

            import_module(f"orchestra.compat.{module}").tell(path, problems, chain)
