"""Texts without a comma between them, which Python makes one: `['-topic' '-z']`, `['amcl' 'planner_server']`."""

from __future__ import annotations

import ast
import re
from itertools import pairwise
from typing import TYPE_CHECKING, Final

from orchestra.compat.rewritten import Rewritten
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code, Severity
from orchestra.fields import replace
from orchestra.location import Location, is_within

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problem, Problems
    from orchestra.location import Span

_TEXT: Final = re.compile(r"""(["'])([^"'\\\n]*)\1(\s*)""")
# What is part of a name ends so, and goes on so; an option, or a topic among topics, begins a word of its own.
_ENDING: Final = re.compile(r"[^\s=:]$")
_WORD: Final = re.compile(r"[A-Za-z0-9]$")
_GOING_ON: Final = re.compile(r"[A-Za-z0-9]")
_OPTION: Final = re.compile(r"--?[a-zA-Z]|-\d")
# What nobody gives a name like: parts of keys, sums and serial numbers in hexadecimal digits, and of keys in base64.
_HEXADECIMAL: Final = re.compile(r"(?=.*[0-9])[0-9a-f]{8,}|(?=.*[0-9])[0-9A-F]{8,}")
_BASE64: Final = re.compile(r"(?=.*[0-9])(?=.*[a-z])(?=.*[A-Z])[0-9A-Za-z+/]{16,}")
_SHORTEST: Final = 2  # letters: one may be anything
_LONGEST: Final = 40  # characters: what is longer may be in two parts for the length of the line
_LISTS: Final = frozenset({"arguments", "cmd", "ros_arguments"})
# What reads a list as one text, in which anything may stand beside anything.
_OF_TEXTS: Final = frozenset(
    {"Command", "LogInfo", "PythonExpression", "StringJoinSubstitution", "TextSubstitution"}
)
_LACKS: Final = "a comma is missing between "


def tell(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of words of a list, or parts of a path, that are part of the one before them for want of a comma."""
    tree = tree_of(path)
    for word, beside, is_command in () if tree is None else _words(tree):
        span = node_span(path, word, quotes=True)
        texts = _side_by_side(text_at(path, span))
        first = next((pair for pair in pairwise(texts) if _is_apart(*pair, beside, is_command)), None)
        if first is not None:
            message = f"{_LACKS}'{first[0]}' and '{first[1]}': they are one word"
            meant = Rewritten(_with_commas(text_at(path, span), texts, beside, is_command=is_command))
            problems.warning(Code.BAD_VALUE, message, Location(span, chain), suggestion=meant)


def without_what_is_joined(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out problems that such a word causes; what is told instead is as grave."""
    joined = {id(problem): problem for problem in problems if problem.message.startswith(_LACKS)}
    caused: dict[int, int] = {}
    for problem in problems if joined else ():
        for number, cause in joined.items():
            if id(problem) not in joined and _causes(cause, problem):
                caused[id(problem)] = number
    grave = {caused[id(item)] for item in problems if id(item) in caused and item.severity is Severity.ERROR}

    def kept(problem: Problem) -> Problem | None:
        if id(problem) in caused:
            return None
        return replace(problem, severity=Severity.ERROR) if id(problem) in grave else problem

    return kept


def _causes(cause: Problem, problem: Problem) -> bool:
    if cause.span is None or problem.span is None or cause.span.file != problem.span.file:
        return False
    _, first, _, second, _ = cause.message.split("'")
    return is_within(problem.span, cause.span) or f"{first}{second}" in problem.message


def _words(tree: Tree) -> Iterator[tuple[ast.Constant, list[str], bool]]:
    """Yield texts that are items of lists, or parts of paths, with all that are there; and whether it is a command."""
    commands, apart = _lists(tree)
    for node in tree.nodes:
        match node:
            case ast.List(elts=items) | ast.Tuple(elts=items) | ast.Set(elts=items) if id(node) not in apart:
                pass
            case ast.Call(func=ast.Attribute(attr="join"), args=items) if len(items) > 1:
                pass
            case _:
                continue
        texts = [item for item in items if isinstance(item, ast.Constant) and isinstance(item.value, str)]
        for text in texts:
            yield text, [str(item.value) for item in texts if item is not text], id(node) in commands


def _lists(tree: Tree) -> tuple[set[int], set[int]]:
    """Return the lists that are command lines, and those that are read as one text."""
    commands, apart = set[int](), set[int]()
    for node in tree.nodes:
        if isinstance(node, ast.Call):
            commands |= {id(tree.meaning(item.value)) for item in node.keywords if item.arg in _LISTS}
            if called_by(node) in _OF_TEXTS:
                given = (*node.args, *(item.value for item in node.keywords))
                apart |= {id(inner) for item in given for inner in ast.walk(tree.meaning(item))}
    return commands, apart


def _side_by_side(written: str) -> list[str]:
    """Return the texts that stand side by side; none where they are not all plain."""
    found = list(_TEXT.finditer(written))
    is_plain = "".join(item[0] for item in found) == written
    return [item[2] for item in found] if is_plain else []


def _is_apart(one: str, other: str, beside: Sequence[str], is_command: bool) -> bool:
    """Return whether two texts are surely words of their own."""
    if is_command and _ENDING.search(one) and (_OPTION.match(other) or _is_path_of(one, other)):
        return True
    if other.startswith("/"):
        is_topic = "@" in one and "@" in other
        are_names = one.startswith("/") and any(item.startswith("/") for item in beside)
        return _ENDING.search(one) is not None and (is_topic or are_names) and not one.endswith("/")
    if any(blank in one + other for blank in " \t") or max(len(one), len(other)) > _LONGEST:
        return False
    if min(len(one), len(other)) < _SHORTEST and not (one + other).isdigit():
        return False
    if _are_of_a_key(one, other) and not any(len(item) in (len(one), len(other)) for item in beside):
        return False
    return _WORD.search(one) is not None and _GOING_ON.match(other) is not None


def _are_of_a_key(one: str, other: str) -> bool:
    is_number = (one + other).isdigit()  # two of them are rather two serial numbers
    return not is_number and any(
        kind.fullmatch(one) and kind.fullmatch(other) for kind in (_HEXADECIMAL, _BASE64)
    )


def _is_path_of(one: str, other: str) -> bool:
    return _OPTION.match(one) is not None and "/" not in one and other.startswith(("/", "~/", "./", "../"))


def _with_commas(written: str, texts: Sequence[str], beside: Sequence[str], *, is_command: bool) -> str:
    """Return texts that stand side by side with commas between those that are words of their own."""
    found, pieces = list(_TEXT.finditer(written)), list[str]()
    for number, item in enumerate(found):
        is_last = number + 1 == len(found)
        needs = not is_last and _is_apart(texts[number], texts[number + 1], beside, is_command)
        quoted = item[0][: len(item[0]) - len(item[3])]
        pieces.append(f"{quoted}, " if needs else quoted if is_last else f"{quoted} ")
    return "".join(pieces)
