"""Things of Python that a launch file misuses without an error: what they do is something that nobody meant.

To find them takes a syntax tree, so a short look at the text says first whether there may be any.
"""

from __future__ import annotations

import re
from collections import Counter
from contextlib import suppress
from typing import TYPE_CHECKING, Final

from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.errors import Problems
    from orchestra.location import Span

_PERFORMING: Final = (b".perform(", b"perform_substitution(", b"launch_configurations")
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
_METHODS: Final = (
    *(b".perform", b".evaluate", b".lower", b".upper", b".strip", b".casefold", b".exists", b".isfile"),
    *(b".isdir", b".is_file", b".is_dir", b".read", b".read_text", b".toxml", b".toprettyxml"),
)
_CONDITIONS: Final = tuple(
    b"%s %s(" % (word, name)
    for word in (b"if", b"not", b"and", b"or")
    for name in (
        b"IfCondition",
        b"UnlessCondition",
        b"LaunchConfigurationEquals",
        b"LaunchConfigurationNotEquals",
    )
)
_QUOTE: Final = pattern(rb"(?:^|[^\w{])(?:'[^'{}\\]*|\"[^\"{}\\]*)$")
_IN_LOOP: Final = pattern(
    rb"^([ \t]*)for [^\n]*:[ \t]*\n(\1[ \t]+)\S[^\n]*\n(?:\2[ \t]*\S[^\n]*\n|[ \t]*\n)*?\2return\b",
    re.MULTILINE,
)
_CHANGING: Final = (
    *(b".append(", b".extend(", b".insert(", b".update(", b".sort(", b".reverse("),
    *(b".add_action(", b".add_entity("),
)
_TAKES: Final = pattern(rb"(?:=|return|[(\[,])[ \t]*[\w.]*(?:\([^()]*\)|\[[^\[\]]*\])?$")
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
_OF_TEXTS: Final = frozenset((b"['", b'["', b"('", b'("'))
_IN_LISTS: Final = (b"[[", b", ['", b', ["', b", [\n")
_WORDS: Final = pattern(rb"\w+")
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
_ADDING: Final = (b".add_action(", b".add_entity(", b".append(", b".extend(", b".insert(")
_MADE: Final = (b"[", b"LaunchDescription", *(name for name in _ACTIONS if name[:3] in _SETTING))


def may_be_misused(source: bytes) -> bool:
    """Return whether a short look at a launch file finds something that may be."""
    return any(_signs(source))


def _signs(source: bytes) -> Iterator[bool]:
    """Yield whether there is a sign of each kind of misuse."""
    yield any(sign in source for sign in _PERFORMING) and _asks_for_texts(source)
    yield _is_uncalled(source) or any(sign in source for sign in _CONDITIONS)
    yield _has_braces(source)
    is_later = (b"function" in source or b"on_" in source) and (b"lambda" in source or b"  def " in source)
    yield is_later and b"for " in source
    yield (b": {" in source or b":{" in source) and _DOTTED.search(source) is not None
    yield b"}, {" in source and _SIDE_BY_SIDE.search(source) is not None
    yield b"},\n" in source and b"parameters" in source and _SIDE_BY_SIDE.search(source) is not None
    yield any(sign in source for sign in _IN_LISTS) and _IN_WORDS.search(source) is not None
    yield b"target_" in source and not set(_WAITED_FOR.findall(source)).isdisjoint(_DONE.findall(source))
    yield _stands_alone(source) or _takes_nothing(source)
    lines = source.splitlines()
    yield _is_left_out(source, lines)
    yield _is_behind(lines) or (b"for " in source and _IN_LOOP.search(source) is not None)


def _asks_for_texts(source: bytes) -> bool:
    """Return whether the text of an argument may be asked whether it is true, or compared with what it never is."""
    names = set(_SET.findall(source))
    is_asked = not names.isdisjoint(_ASKED.findall(source)) or _ASKED_AT_ONCE.search(source) is not None
    return is_asked or _OTHER.search(source) is not None or b"choices" in source


def _is_uncalled(source: bytes) -> bool:
    """Return whether one of the methods stands without brackets behind it."""
    for method in _METHODS:
        at = source.find(method)
        while at >= 0:
            behind = source[at + len(method) : at + len(method) + 1]
            if behind != b"(" and not behind.isalnum() and behind != b"_":
                return True
            at = source.find(method, at + 1)
    return False


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
    for method in _CHANGING:
        at = source.find(method)
        while at >= 0:
            before = source[_line(source, at) : at]
            is_alone = before.strip().replace(b"_", b"a").replace(b".", b"a").isalnum()
            if not is_alone and _TAKES.search(before):
                return True
            at = source.find(method, at + 1)
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


def _is_left_out(source: bytes, lines: Sequence[bytes]) -> bool:
    """Return whether a variable is only set and added to, never read, or a list of texts one item of another list."""
    counts: dict[bytes, int] = {}
    kept, lists = set(), set()
    for line in lines:
        name, sign, value = line.partition(b" = ")
        if sign:
            name = name.strip()
            counts[name] = counts.get(name, 0) + 1
            if value.startswith(_MADE):
                kept.add(name)
            if value[:2] in _OF_TEXTS:
                lists.add(name)
        else:
            for adding in _ADDING:
                if adding in line:
                    name = line.partition(adding)[0].strip()
                    counts[name] = counts.get(name, 0) + 1
    if lists and not lists.isdisjoint(_ITEMS.findall(source)):
        return True
    words = Counter(_WORDS.findall(source)) if kept else Counter[bytes]()
    return any(words[name] <= counts[name] for name in kept)


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
