"""Things of Python that a launch file misuses without an error: what they do is something that nobody meant.

To find them takes a syntax tree, so a short look at the text says first whether there may be any.
"""

from __future__ import annotations

import re
from contextlib import suppress
from functools import cache
from itertools import chain, compress
from typing import TYPE_CHECKING, Final

from orchestra.compat.signs import codes_in, gives_twice, has_text, is_behind, places_of
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterator
    from collections.abc import Set as AbstractSet
    from types import CodeType

    from orchestra.compat.signs import Codes
    from orchestra.errors import Problems
    from orchestra.location import Span

_PERFORMING: Final = frozenset({"perform", "perform_substitution", "launch_configurations"})
_SET: Final = pattern(
    rb"^[ \t]+(\w+)[ \t]*=(?!=)[^\n=]{0,160}(?:\.perform\(|perform_substitution\(|launch_configurations)",
    re.MULTILINE,
)
_ASKED: Final = pattern(
    rb"(?:\b(?:if|elif|while|not|and|or|assert)\s|\bbool\()[ \t]*\(?(?:not\s+)?(\w+)[ \t]*(?=\)|:|\n|and\b|or\b|else\b)"
)
_ASKED_AT_ONCE: Final = pattern(
    rb"(?:\b(?:if|elif|while|not|and|or|assert)\b|\bbool\()[^\n=<>]{0,120}"
    rb"(?:perform(?:_substitution)?\(|launch_configurations)[^\n=<>]{0,80}[)\]][ \t]*(?:\)|:|\n|and\b|or\b|else\b)"
)
_OTHER: Final = pattern(rb"(?:[=!]=|\bis(?: not)?)[ \t]*(?:True\b|False\b|\d)")
_TRUTH: Final = pattern(rb"""(?:[=!]=|\bis(?: not)?)[ \t]*['"](?:[Tt]rue|[Ff]alse)['"]""")
_TRUTHS: Final = pattern(rb"""['"](true|false)['"]""", re.IGNORECASE)
# Where something is compared with a text, or a text with something; and how that is mostly written.
_BESIDE_TEXT: Final = pattern(rb"""(?:[=!]=|\bis(?:\s+not)?\b)[\s(\\]*[bBfFrRuU]{0,2}['"]""")
_BEHIND_TEXT: Final = pattern(rb"""['"][\s)\\]*(?:[=!]=|\bis\b)""")
_WITH_TEXT: Final = pattern(rb"""(?:[=!]=|is(?:[ ]not)?)[ ]*(['"])([^'"\\\n]*)\1(?![\s\\]*['"])""")
_CHOICES: Final = pattern(rb"""choices[ ]*=[ ]*[\[(]((?:\s*(?:'[^'\\\n]*'|"[^"\\\n]*")\s*,?)+)\s*[\])]""")
_TEXT: Final = pattern(rb"""'([^'\n]*)'|"([^"\n]*)\"""")
_METHODS: Final = frozenset(
    {
        *("perform", "evaluate", "lower", "upper", "strip", "casefold", "exists", "isfile"),
        *("isdir", "is_file", "is_dir", "read", "read_text", "toxml", "toprettyxml"),
    }
)
_UNCALLED: Final = pattern(rb"\.(?:%s)(?![\w(])" % "|".join(sorted(_METHODS)).encode())
_CONDITIONS: Final = frozenset(
    {"IfCondition", "UnlessCondition", "LaunchConfigurationEquals", "LaunchConfigurationNotEquals"}
)
_ASKING: Final = (b"if", b"not", b"and", b"or")
_ENDING: Final = len("Condition")
_QUOTE: Final = pattern(rb"(?:^|[^\w{])(?:'[^'{}\\]*|\"[^\"{}\\]*)$")
_IN_LOOP: Final = pattern(
    rb"^([ \t]*)for [^\n]*:[ \t]*\n(\1[ \t]+)\S[^\n]*\n(?:\2[ \t]*\S[^\n]*\n|[ \t]*\n)*?\2return\b",
    re.MULTILINE,
)
_CHANGING: Final = frozenset(
    {*("append", "extend", "insert", "update", "sort", "reverse", "add_action", "add_entity")}
)
_CHANGED: Final = pattern(rb"\.(?:%s)\(" % "|".join(sorted(_CHANGING)).encode())
_TAKES: Final = pattern(rb"(?:=|return|[(\[,])[ \t]*[\w.]*(?:\([^()]*\)|\[[^\[\]]*\]|\{[^{}]*\})?$")
_WAITED_FOR: Final = pattern(rb"\b(?:target_action|target_lifecycle_node)[ \t]*=[ \t]*(\w+)")
_DONE: Final = pattern(rb"\b(?:on_\w+|entities|actions)[ \t]*=[ \t]*\[?\s{0,80}(\w+)")
_DOTTED: Final = pattern(rb"['\"]\w+(?:\.\w+)+['\"][ \t]*:")
_ENDS_DOTTED: Final = pattern(rb"\.\w+['\"][ \t]*:")
_ITEMS: Final = pattern(rb"[\[,]\s{0,80}(\w+)[ \t]{0,80}(?=,|\s{0,80}\])")
_IN_WORDS: Final = pattern(
    rb"(?:cmd|arguments)\s{0,9}=\s{0,9}\[[^\]]{0,300}\[\s{0,80}['\"][^\]'\"]{0,200}['\"]\s{0,80},\s{0,80}['\"]"
)
_GOING_ON: Final = frozenset((b"[", b"(", b",", b"=", b"{", b"+", b"\\"))
_OF_TEXTS: Final = (b"['", b'["', b"('", b'("')
_IN_LISTS: Final = (b"[[", b", ['", b', ["', b", [\n")
_LONG: Final = 400
_SETTING: Final = ("Dec", "Set", "App", "Log", "Pus")
_ACTIONS: Final = frozenset(
    {
        *("Node", "GroupAction", "TimerAction", "DeclareLaunchArgument", "SetLaunchConfiguration", "LogInfo"),
        *("ComposableNodeContainer", "IncludeLaunchDescription", "OpaqueFunction", "RegisterEventHandler"),
        *("PushRosNamespace", "PushROSNamespace", "SetParameter", "ExecuteProcess", "LoadComposableNodes"),
        *("SetRemap", "SetEnvironmentVariable", "AppendEnvironmentVariable"),
    }
)
# What a variable is set to that may be left out.
_SET_TO: Final = pattern(rb"= [\[(A-Z](?<= = .)")
# What stands behind a variable that is set, or added to.
_ONLY: Final = (b" = ", b".add_action(", b".add_entity(", b".append(", b".extend(", b".insert(")
_KEPT: Final = (
    *(b"[", b"LaunchDescription"),
    *(f"{name}(".encode() for name in sorted(_ACTIONS) if name[:3] in _SETTING),
)


# The modules that tell of each kind of misuse, with their functions.
_TELLING: Final = {"texts_as_truths": "tell_truths"} | {
    name: f"tell_{name}"
    for name in (
        *("uncalled", "unreached", "without_f", "late_loops", "waiting_in_vain"),
        *("left_out", "nested_keys", "nested_words", "returning_none"),
    )
}
# The ones that each of the `_signs` is for.
_TOLD_BY: Final = (
    *(("texts_as_truths",), ("uncalled",), ("uncalled",), ("without_f",), ("late_loops",), ("nested_keys",)),
    *(("nested_keys",), ("nested_words",), ("waiting_in_vain",), ("left_out",), ("returning_none",)),
    *(("left_out", "nested_words"), ("unreached",)),
)


def may_be_misused(code: CodeType, source: bytes) -> bool:
    """Return whether a short look at a launch file finds something that may be; `code` is what it was compiled to.

    What no name or constant of the code can be a sign of need not be looked for in the text, which takes longer.
    """
    return any(_signs(codes_in(code), source))


def _left_alone(codes: Codes) -> Iterator[set[str]]:
    """Yield the names of each function that lets go of the value of a statement."""
    leaving = _leaving()
    for item, written in zip(codes.every[1:], codes.written[1:], strict=True):
        if leaving in written[::2]:
            yield {*item.co_names, *item.co_varnames, *item.co_freevars, *item.co_cellvars}


@cache
def _leaving() -> int:
    """Return the operation that lets go of the value of a statement."""
    from opcode import opmap  # noqa: PLC0415 - once

    return opmap["POP_TOP"]


def _signs(codes: Codes, source: bytes) -> Iterator[bool]:
    """Yield whether there is a sign of each kind of misuse."""
    names = codes.names
    has_dots, has_braces = has_text(codes, ".", "{")
    yield bool(names & _PERFORMING) and _asks_for_texts(source)
    yield bool(names & _METHODS) and _UNCALLED.search(source) is not None
    yield _is_asked_for(names & _CONDITIONS, source)
    yield has_braces and _has_braces(source)
    has_loop = b"for " in source
    is_later = has_loop and (b"lambda" in source or b"  def " in source)
    yield is_later and (b"function" in source or b"on_" in source)
    has_keys = has_dots and _ENDS_DOTTED.search(source) is not None
    yield has_keys and _DOTTED.search(source) is not None
    yield gives_twice(source)
    places = [at for word in (b"arguments", b"cmd") for at in places_of(word, source)]
    has_list = any(_holds_list(source, at) and _IN_WORDS.match(source, at) for at in places)
    yield has_list and any(sign in source for sign in _IN_LISTS)
    yield b"target_" in source and not set(_WAITED_FOR.findall(source)).isdisjoint(_DONE.findall(source))
    yield _stands_alone(_ACTIONS & set[str]().union(*_left_alone(codes)), source)
    yield bool(names & _CHANGING) and _takes_nothing(source)
    yield _is_left_out(source)
    yield is_behind(source) or (has_loop and _IN_LOOP.search(source) is not None)


def _holds_list(source: bytes, at: int) -> bool:
    """Return whether a bracket is opened inside of the first one behind a place, before one is closed."""
    begin = source.find(b"[", at) + 1
    return source.find(b"[", begin, source.find(b"]", begin)) >= 0


def _is_asked_for(conditions: AbstractSet[str], source: bytes) -> bool:
    """Return whether one of some conditions is asked whether it is true where it is made."""
    made: dict[bytes, tuple[bytes, ...]] = {}
    for name in conditions:  # several end alike, and are looked for at once
        begin, end = name[:-_ENDING].encode(), name[-_ENDING:].encode()
        made[end] = (*made.get(end, ()), *[b"%b %b" % (asking, begin) for asking in _ASKING])
    return any(
        piece.endswith(asked) for end, asked in made.items() for piece in source.split(end + b"(")[:-1]
    )


def _asks_for_texts(source: bytes) -> bool:
    """Return whether the text of an argument may be asked whether it is true, or compared with what it never is."""
    names = set(_SET.findall(source))
    is_asked = not names.isdisjoint(_ASKED.findall(source)) or _ASKED_AT_ONCE.search(source) is not None
    if is_asked or _OTHER.search(source) is not None:
        return True
    has_choices, has_truths = b"choices" in source, _TRUTH.search(source) is not None
    if (has_choices or has_truths) and _ASKED.search(source) is not None:
        return True
    return (has_choices and _compares(source)) or (has_truths and _is_written_apart(source))


def _is_written_apart(source: bytes) -> bool:
    """Return whether `true` or `false` stand in texts with other letters as well."""
    written = {*_TRUTHS.findall(source)}
    return len(written) > len({word.lower() for word in written})


def _compares(source: bytes) -> bool:
    """Return whether something is compared with a text that is not among all choices, as far as that is plain."""
    if _BEHIND_TEXT.search(source) is not None:
        return True
    compared = set[bytes]()
    for beside in _BESIDE_TEXT.finditer(source):
        text = _WITH_TEXT.match(source, beside.start())
        if text is None:
            return True
        compared.add(text[2])
    choices = [{*chain(*_TEXT.findall(listed))} for listed in _CHOICES.findall(source)]
    if not compared:
        return False
    return len(choices) < source.count(b"choices") or any(not compared <= known for known in choices)


def _has_braces(source: bytes) -> bool:
    """Return whether a name stands in braces in a text without an f before it."""
    at = source.find(b"{")
    while at >= 0:
        end = source.find(b"}", at)
        is_name = source[at + 1 : end].replace(b"_", b"a").isalnum()
        if is_name and _QUOTE.search(source[_line(source, at) : at]):
            return True
        at = source.find(b"{", at + 1)
    return False


def _takes_nothing(source: bytes) -> bool:
    """Return whether the value of a call is taken that returns nothing."""
    for found in _CHANGED.finditer(source):
        at = found.start()
        before = source[_line(source, at) : at]
        is_alone = before.strip().replace(b"_", b"a").replace(b".", b"a").isalnum()
        if not is_alone and _TAKES.search(before):
            return True
    return False


def _stands_alone(actions: AbstractSet[str], source: bytes) -> bool:
    """Return whether a line that goes on with nothing before it makes one of some actions."""
    for at in (at for name in actions for at in places_of(f"{name}(".encode(), source)):
        begin = _line(source, at)
        is_first = not source[begin:at].strip()
        if is_first and source[max(begin - _LONG, 0) : begin].rstrip()[-1:] not in _GOING_ON:
            return True
    return False


def _line(source: bytes, place: int) -> int:
    """Return where the line of a place begins, or the last part of a long one."""
    return max(source.rfind(b"\n", 0, place) + 1, place - _LONG)


def _is_left_out(source: bytes) -> bool:
    """Return whether a variable is only set and added to, never read, or a list of texts one item of another list."""
    kept, lists = set[bytes](), set[bytes]()
    for found in _SET_TO.finditer(source):
        at = found.start() - 1
        if source.startswith(_KEPT, at + 3):
            kept.add(source[_line(source, at) : at].strip())
        if source.startswith(_OF_TEXTS, at + 3):
            lists.add(source[_line(source, at) : at].strip())
    if lists and not lists.isdisjoint(_ITEMS.findall(source)):
        return True
    return any(_is_only_set(name, source) for name in kept)


def _is_only_set(name: bytes, source: bytes) -> bool:
    """Return whether a variable stands nowhere but where it is set and added to."""
    uses = 0
    for at in chain((source.rfind(name),), places_of(name, source)):  # most are read at last
        end = at + len(name)
        if not (_is_of_name(source[end : end + 1]) or (at and _is_of_name(source[at - 1 : at]))):
            is_first = not source[_line(source, at) : at].strip()
            if not is_first or not source.startswith(_ONLY, end):
                return False
            uses += 1
    return uses > 0


def _is_of_name(character: bytes) -> bool:
    return character.isalnum() or character == b"_"


def tell(code: CodeType, source: bytes, path: str, problems: Problems, includes: tuple[Span, ...]) -> None:
    """Report what a launch file misuses: what there is a sign of is looked for."""
    # Here, because only what may be a mistake needs them, and what they import.
    from importlib import import_module  # noqa: PLC0415

    from orchestra.compat.syntax_trees import tree_of  # noqa: PLC0415

    found = {*chain.from_iterable(compress(_TOLD_BY, _signs(codes_in(code), source)))}
    tree = tree_of(path) if found else None
    for module, name in _TELLING.items():
        if tree is not None and module in found:
            with suppress(RecursionError):  # what is put together of a thousand pieces is left alone
                getattr(import_module(f"orchestra.compat.{module}"), name)(path, tree, problems, includes)
