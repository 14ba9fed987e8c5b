"""The code of a long Python file is made of that of a short one, where most of it is one item after the other.

A file of a thousand nodes takes as long to compile as all else that is done to read it. Where its text between
literals repeats itself, all but some of that is left out, what is left is compiled, and the code of one of its items
(`run_codes`) is put in for each that was left out, with the literals of that. Literals differ on the terms of forms
(`form_slots`). More than thirty items are left, since the compiler makes other code of shorter lists and calls.

Wherever there is a doubt the whole file is compiled.
"""

from __future__ import annotations

import warnings
from contextlib import suppress
from typing import TYPE_CHECKING, Final

from orchestra.resolve.python.form_slots import plain, split
from orchestra.resolve.python.run_codes import lengthened
from orchestra.resolve.python.run_texts import Run, repeated

if TYPE_CHECKING:
    from types import CodeType

_MANY: Final = 34  # repetitions that are left: from 31 items on the compiler adds each to a list
_FEW: Final = 8  # repetitions that are left where each is long, so that they may be several items
_LONG: Final = 24  # literals


def code_of(path: str, source: bytes) -> CodeType | None:
    """Return the code of a file; None where it does not repeat itself enough, or there is a doubt."""
    text = plain(source)
    parts = [] if text is None else split(text)
    found = repeated(parts[::2])
    if found is None:
        return None
    for kept in (_FEW, _MANY) if found.period >= _LONG else (_MANY,):
        if found.times >= 2 * kept:
            with suppress(Exception):  # whatever stands against it
                run = Run(parts, found, kept)
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    code = compile(run.shorter, path, "exec", dont_inherit=True)
                return lengthened(code, run)
    return None
