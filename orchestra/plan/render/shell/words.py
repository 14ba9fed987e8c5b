"""Words and texts as bash reads them back, byte for byte.

Single quotes keep everything but themselves, so nothing in a word is ever expanded but the run directory, which is
named `${run}` in a plan.
"""

from __future__ import annotations

import base64
import re
import shlex

_RUN = "${run}"
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_COMMENT = re.compile(r"[^\x20-\x7e\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
# What has a meaning in a text behind `<<END`, whose variables are filled in.
_EXPANDED = re.compile(r"[\\$`]")


def word(text: str) -> str:
    """Return a text as one word, with the run directory filled in."""
    return '"$run"'.join(shlex.quote(piece) if piece else "" for piece in text.split(_RUN)) or "''"


def words(texts: tuple[str, ...] | list[str]) -> str:
    """Return several texts as words."""
    return " ".join(map(word, texts))


def is_name(name: str) -> bool:
    """Return whether a shell can set a variable of this name."""
    return _NAME.fullmatch(name) is not None


def comment(text: str) -> str:
    """Return a text as one line behind `#`."""
    return f"# {_COMMENT.sub(' ', text)}".rstrip()


def written(path: str, text: str) -> list[str]:
    """Return the lines that write a text to a file, with the run directory filled in."""
    if not text.endswith("\n") or "\0" in text or "\r" in text:
        return written_bytes(path, text.encode(errors="surrogateescape"))
    end = _end(text)
    if _RUN not in text:
        return [f"cat >{word(path)} <<'{end}'", *text[:-1].split("\n"), end]
    pieces = (_EXPANDED.sub(r"\\\g<0>", piece) for piece in text[:-1].split(_RUN))
    return [f"cat >{word(path)} <<{end}", *"$run".join(pieces).split("\n"), end]


def written_bytes(path: str, content: bytes) -> list[str]:
    """Return the lines that write any bytes to a file."""
    lines = base64.encodebytes(content).decode().splitlines()
    return [f"base64 -d >{word(path)} <<'END'", *lines, "END"]


def _end(text: str) -> str:
    """Return a word that is no line of the text."""
    lines, end = frozenset(text.split("\n")), "END"
    while end in lines:
        end += "_"
    return end
