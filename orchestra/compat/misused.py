"""Things of Python that a launch file misuses without an error: what they do is something that nobody meant.

To find them takes a syntax tree, so a short look at the text says first whether there may be any.
"""

from __future__ import annotations

import re
from contextlib import suppress
from functools import cache
from types import CodeType
from typing import TYPE_CHECKING, Final

from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from collections.abc import Set as AbstractSet

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
_OTHER: Final = pattern(
    rb"(?:[=!]=|\bis(?: not)?)[ \t]*(?:True\b|False\b|\d|'[Tt]rue'|\"[Tt]rue\"|'[Ff]alse'|\"[Ff]alse\")"
)
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
_AS_TRUTH: Final = pattern(rb"(?:if|not|and|or) (?:%s)\(" % "|".join(sorted(_CONDITIONS)).encode())
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
_SIDE_BY_SIDE: Final = pattern(rb"parameters\s{0,4}=\s{0,4}\[[^\]]{0,800}\}\s{0,80},\s{0,80}\{")
_ITEMS: Final = pattern(rb"[\[,]\s{0,80}(\w+)[ \t]{0,80}(?=,|\s{0,80}\])")
_IN_WORDS: Final = pattern(
    rb"(?:cmd|arguments)\s{0,9}=\s{0,9}\[[^\]]{0,300}\[\s{0,80}['\"][^\]'\"]{0,200}['\"]\s{0,80},\s{0,80}['\"]"
)
_GOING_ON: Final = frozenset((b"[", b"(", b",", b"=", b"{", b"+", b"\\"))
_CLOSING: Final = frozenset((b")", b"]", b"}"))
_OF_TEXTS: Final = (b"['", b'["', b"('", b'("')
_IN_LISTS: Final = (b"[[", b", ['", b', ["', b", [\n")
_LONG: Final = 400
_SETTING: Final = (b"Dec", b"Set", b"App", b"Log", b"Pus")
_ACTIONS: Final = (
    *(b"Node(", b"GroupAction(", b"TimerAction(", b"DeclareLaunchArgument(", b"SetLaunchConfiguration("),
    *(
        b"ComposableNodeContainer(",
        b"IncludeLaunchDescription(",
        b"OpaqueFunction(",
        b"RegisterEventHandler(",
    ),
    *(b"LogInfo(", b"PushRosNamespace(", b"PushROSNamespace(", b"SetParameter(", b"ExecuteProcess("),
    *(b"SetRemap(", b"SetEnvironmentVariable(", b"AppendEnvironmentVariable(", b"LoadComposableNodes("),
)
# What stands behind a variable that is set, or added to.
_ONLY: Final = (b" = ", b".add_action(", b".add_entity(", b".append(", b".extend(", b".insert(")
_KEPT: Final = (b"[", b"LaunchDescription", *(name for name in _ACTIONS if name[:3] in _SETTING))


def may_be_misused(code: CodeType, source: bytes) -> bool:
    """Return whether a short look at a launch file finds something that may be; `code` is what it was compiled to.

    What no name or constant of the code can be a sign of need not be looked for in the text, which takes longer.
    """
    return any(_signs(_Words(code), source))


class _Words:
    """The names and constant texts of some code, and of what is in it; whether a function leaves a value alone."""

    def __init__(self, code: CodeType) -> None:
        self.names = set[str]()
        self.has_dots = self.has_braces = self.leaves_alone = False
        self._add(code, {*_operations()})

    def _add(self, code: CodeType, leaving: set[int]) -> None:
        self.names.update(code.co_names)
        for item in code.co_consts:
            if type(item) is CodeType:
                self.leaves_alone = self.leaves_alone or not leaving.isdisjoint(item.co_code[::2])
                self._add(item, leaving)
            elif type(item) is str:
                self._say(item)
            elif type(item) is tuple:
                for part in item:
                    if type(part) is str:
                        self._say(part)

    def _say(self, text: str) -> None:
        if "." in text:
            self.has_dots = True
        if "{" in text:
            self.has_braces = True

    def have(self, words: AbstractSet[str]) -> bool:
        """Return whether one of these is among the names."""
        return not self.names.isdisjoint(words)


@cache
def _operations() -> tuple[int, ...]:
    """Return the operations that let go of the value of a statement."""
    from opcode import opmap  # noqa: PLC0415 - once

    return (opmap["POP_TOP"],)


def _signs(words: _Words, source: bytes) -> Iterator[bool]:
    """Yield whether there is a sign of each kind of misuse."""
    yield words.have(_PERFORMING) and _asks_for_texts(source)
    yield words.have(_METHODS) and _is_uncalled(source)
    yield words.have(_CONDITIONS) and _AS_TRUTH.search(source) is not None
    yield words.has_braces and _has_braces(source)
    is_later = (b"function" in source or b"on_" in source) and (b"lambda" in source or b"  def " in source)
    yield is_later and b"for " in source
    yield words.has_dots and _DOTTED.search(source) is not None
    yield b"}, {" in source and _SIDE_BY_SIDE.search(source) is not None
    yield b"},\n" in source and b"parameters" in source and _SIDE_BY_SIDE.search(source) is not None
    has_words = b"arguments" in source or b"cmd" in source
    yield has_words and any(sign in source for sign in _IN_LISTS) and _IN_WORDS.search(source) is not None
    yield b"target_" in source and not set(_WAITED_FOR.findall(source)).isdisjoint(_DONE.findall(source))
    yield words.leaves_alone and _stands_alone(source)
    yield words.have(_CHANGING) and _takes_nothing(source)
    yield _is_left_out(source)
    yield _is_behind(source.splitlines()) or (b"for " in source and _IN_LOOP.search(source) is not None)


def _asks_for_texts(source: bytes) -> bool:
    """Return whether the text of an argument may be asked whether it is true, or compared with what it never is."""
    names = set(_SET.findall(source))
    is_asked = not names.isdisjoint(_ASKED.findall(source)) or _ASKED_AT_ONCE.search(source) is not None
    return is_asked or _OTHER.search(source) is not None or b"choices" in source


def _is_uncalled(source: bytes) -> bool:
    """Return whether one of the methods stands without brackets behind it."""
    return _UNCALLED.search(source) is not None


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


def _stands_alone(source: bytes) -> bool:
    """Return whether a line that goes on with nothing before it makes an action."""
    for name in _ACTIONS:
        at = source.find(name)
        while at >= 0:
            begin = _line(source, at)
            if (
                not source[begin:at].strip()
                and source[max(begin - _LONG, 0) : begin].rstrip()[-1:] not in _GOING_ON
            ):
                return True
            at = source.find(name, at + 1)
    return False


def _line(source: bytes, place: int) -> int:
    """Return where the line of a place begins, or the last part of a long one."""
    return max(source.rfind(b"\n", 0, place) + 1, place - _LONG)


def _is_left_out(source: bytes) -> bool:
    """Return whether a variable is only set and added to, never read, or a list of texts one item of another list."""
    kept, lists = set[bytes](), set[bytes]()
    at = source.find(b" = ")
    while at >= 0:
        name = source[_line(source, at) : at].strip()
        if source.startswith(_KEPT, at + 3):
            kept.add(name)
        if source.startswith(_OF_TEXTS, at + 3):
            lists.add(name)
        at = source.find(b" = ", at + 3)
    if lists and not lists.isdisjoint(_ITEMS.findall(source)):
        return True
    return any(_is_only_set(name, source) for name in kept)


def _is_only_set(name: bytes, source: bytes) -> bool:
    """Return whether a variable stands nowhere but where it is set and added to."""
    uses, at = 0, source.find(name)
    while at >= 0:
        end = at + len(name)
        if not (_is_of_name(source[end : end + 1]) or (at and _is_of_name(source[at - 1 : at]))):
            is_first = not source[_line(source, at) : at].strip()
            if not is_first or not source.startswith(_ONLY, end):
                return False
            uses += 1
        at = source.find(name, end)
    return uses > 0


def _is_of_name(character: bytes) -> bool:
    return character.isalnum() or character == b"_"


def _is_behind(lines: Sequence[bytes]) -> bool:
    """Return whether something stands behind a return, as far in: what is no closing bracket, and no comment."""
    far: int | None = None
    for line in lines:
        bare = line.lstrip()
        if far is None and not bare.startswith(b"return"):
            continue
        if not bare or bare[:1] == b"#":
            continue
        indent = len(line) - len(bare)
        if far is not None and indent <= far and bare[:1] not in _CLOSING:
            if indent == far:
                return True
            far = None
        if bare.startswith(b"return"):
            far = indent
    return False


def tell(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Report what a launch file misuses."""
    # Here, because only what may be a mistake needs them, and what they import.
    from orchestra.compat.late_loops import tell_late_loops  # noqa: PLC0415
    from orchestra.compat.left_out import tell_left_out  # noqa: PLC0415
    from orchestra.compat.nested_keys import tell_nested_keys  # noqa: PLC0415
    from orchestra.compat.nested_words import tell_nested_words  # noqa: PLC0415
    from orchestra.compat.returning_none import tell_returning_none  # noqa: PLC0415
    from orchestra.compat.syntax_trees import tree_of  # noqa: PLC0415
    from orchestra.compat.texts_as_truths import tell_truths  # noqa: PLC0415
    from orchestra.compat.uncalled import tell_uncalled  # noqa: PLC0415
    from orchestra.compat.unreached import tell_unreached  # noqa: PLC0415
    from orchestra.compat.waiting_in_vain import tell_waiting_in_vain  # noqa: PLC0415
    from orchestra.compat.without_f import tell_without_f  # noqa: PLC0415

    tree = tree_of(path)
    for tell_of in (
        tell_truths,
        tell_uncalled,
        tell_unreached,
        tell_without_f,
        tell_late_loops,
        tell_waiting_in_vain,
        tell_left_out,
        tell_nested_keys,
        tell_nested_words,
        tell_returning_none,
    ):
        if tree is not None:
            with suppress(RecursionError):  # what is put together of a thousand pieces is left alone
                tell_of(path, tree, problems, chain)
