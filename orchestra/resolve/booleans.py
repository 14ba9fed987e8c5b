"""How text is read as a boolean."""

from __future__ import annotations

from typing import Final

from orchestra.description.fields import FALSE_WORDS, TRUE_WORDS

# What upstream takes for a condition, in lower case.
CONDITION_WORDS: Final = frozenset({"true", "false", "1", "0"})
# Those, and what expressions of Python give.
PLAIN_CONDITIONS: Final = CONDITION_WORDS | {"True", "False"}


def boolean(text: str) -> bool | None:
    """Read `1`, `0` or a YAML 1.1 boolean in any case, spaces around it ignored; None for anything else.

    Upstream reads conditions and boolean substitutions by two rules. This is the union of both, for every place.
    """
    word = text.strip().lower()
    if word in TRUE_WORDS:
        return True
    return False if word in FALSE_WORDS else None
