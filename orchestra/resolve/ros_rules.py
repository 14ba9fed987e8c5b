"""Rules among the arguments of a node that rcl cannot read, so that the node ends at once: `-r chatter=talk`.

And rules in vain, which stand where rcl does not look: `-p rate:=5` without `--ros-args` before it. Remaps it takes
there too, with a warning of its own.

Source: rcl, `_rcl_parse_remap_rule` and `_rcl_parse_param_rule`: a rule is in two parts with `:=` between them; what
stands outside of `--ros-args` is measured with rclpy.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.nearest import nearest
from orchestra.patterns import pattern
from orchestra.resolve.log_levels import LEVELS

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.errors import Problems
    from orchestra.resolve.context import Value

OPTIONS: Final = {
    **dict.fromkeys(("-r", "--remap"), "FROM:=TO"),
    **dict.fromkeys(("-p", "--param"), "NAME:=VALUE"),
}
_TAKING: Final = frozenset(
    {*OPTIONS, "--params-file", "--log-level", "--log-config-file", "--log-file-name", "-e", "--enclave"}
)
_LOGS: Final = ("stdout-logs", "rosout-logs", "external-lib-logs")
_SWITCHES: Final = frozenset(f"--{how}able-{logs}" for how in ("en", "dis") for logs in _LOGS)
_JOINED: Final = pattern(r"([\w/~.]+)(?:=|:)([^=:\s]+)")
_FOR_ROS: Final = "--ros-args"
_ALIKE: Final = pattern(r"-{0,2}ros[-_]?args?:?")
_PARAMETERS: Final = ("-p", "--param")
_FILE: Final = "--params-file"
_ENDINGS: Final = (".yaml", ".yml")
_RULE: Final = pattern(r"[\w/~.]+:=.*")
_OF_ROS_1: Final = pattern(r"_(_params|_log_level|[A-Za-z]\w*):=(.+)")
_SEVERAL: Final = pattern(r"""--?[A-Za-z][\w-]*\s[^"'{]*|(?:-?\d[\d.]*\s+){3}[^"'{]*""")
_PASSED_ON: Final = pattern(
    r"(?:(?!--ros-args$)--?|.*[\w/]--(?!ros-args$))[\w-]*(?:arg|argument|param|parameter|opt|option|flag|command|cmd|prefix)s?"
    r"|-[ce]"
)
_OPTIONS: Final = {"_params": "--params-file", "_log_level": "--log-level"}


def check_rules(words: Sequence[Value], problems: Problems, *, for_ros: bool) -> None:
    """Report rules without a `:=` where they stand; `for_ros` tells that all words are for rcl."""
    if not for_ros:
        _check_in_vain(words, problems)
    _check_joined(words, problems, for_ros=for_ros)
    _check_unknown(words, problems, for_ros=for_ros)
    for option, word in _rules(words, for_ros=for_ros):
        if ":=" in word.text:
            continue
        joined = _JOINED.fullmatch(word.text) if is_written(word) else None
        message = f"'{word.text}' is no rule: behind {option} stands {OPTIONS[option]}"
        instead = f"{joined[1]}:={joined[2]}" if joined is not None else None
        problems.error(Code.BAD_VALUE, message, word.location, suggestion=instead)


def are_known(said: Sequence[str], *, for_ros: bool) -> bool:
    """Return whether words without blanks are plainly sound: what ROS knows, behind `--ros-args` alone."""
    reads, option = for_ros, ""
    for text in said:
        if option:
            if text[:1] == "-" or not _fits(text, option):
                return False
            option = ""
        elif not reads:
            reads = text == _FOR_ROS
            if not reads and (text in ("--", _FILE) or ":=" in text or "ros" in text):
                return False
        elif text in _TAKING:
            option = text
        elif text not in _SWITCHES:
            return False
    return True


def _fits(text: str, option: str) -> bool:
    """Return whether a word is what an option takes."""
    if option == "--log-level":
        return text.lower() in LEVELS
    return option not in OPTIONS or ":=" in text


def _check_in_vain(words: Sequence[Value], problems: Problems) -> None:
    """Report what is meant for rcl, which does not see it: the first of that, for what is behind it follows."""
    if not any(":=" in word.text or "ros" in word.text or word.text == _FILE for word in words):
        return
    for index, word in enumerate(words):
        if word.text in (_FOR_ROS, "--"):
            return
        following = words[index + 1].text if index + 1 < len(words) else ""
        if _ALIKE.fullmatch(word.text) and following.startswith("-"):
            told = f"'{word.text}' is not {_FOR_ROS}: what follows is not for ROS"
            problems.warning(Code.BAD_VALUE, told, word.location, suggestion=_FOR_ROS)
            return
        instead = _for_ros(word.text, following)
        if instead is not None:
            told = f"'{word.text}' is read by ROS only behind {_FOR_ROS}"
            whole = is_written(word) and not is_python(word.location)
            problems.warning(Code.BAD_VALUE, told, word.location, suggestion=instead if whole else None)
            return


def _check_unknown(words: Sequence[Value], problems: Problems, *, for_ros: bool) -> None:
    """Report the first word behind `--ros-args` that rcl does not know: the node ends at once (UnknownROSArgsError)."""
    reads, taken = for_ros, False
    for word in words:
        text = word.text
        if text in (_FOR_ROS, "--"):
            reads, taken = text == _FOR_ROS, False
        elif taken or not reads or text in _TAKING | _SWITCHES:
            taken = reads and not taken and text in _TAKING
        elif is_python(word.location) and _SEVERAL.fullmatch(text):
            return  # told as one word that is several
        else:
            rule = f"-r {text}" if _RULE.fullmatch(text) else None
            instead = rule or (nearest(text, _TAKING | _SWITCHES) if text[:1] == "-" else None)
            told = f"'{text}' is nothing that ROS knows behind {_FOR_ROS}: the node ends at once"
            whole = is_written(word) and not (rule and is_python(word.location))
            problems.error(Code.BAD_VALUE, told, word.location, suggestion=instead if whole else None)
            return


def _check_joined(words: Sequence[Value], problems: Problems, *, for_ros: bool) -> None:
    """Report options and what belongs to them in one word of a list, which nothing takes apart: `['-d a.rviz']`.

    What an option for further arguments takes is one word: `['--controller-ros-args', '-r a:=b']`. So it is where the
    comma before the option is missing, which is told: `['/manager' '--controller-ros-args', '-r a:=b']`.
    """
    if not words or not is_python(words[0].location):  # all of them stand in one file
        return
    before, reads = "", for_ros
    for word in words:
        passed_on, before = _PASSED_ON.fullmatch(before), word.text
        reads = word.text == _FOR_ROS if word.text in (_FOR_ROS, "--") else reads
        if _SEVERAL.fullmatch(word.text) and not passed_on:
            # Here, because only mistakes need it.
            from orchestra.compat.rewritten import Rewritten  # noqa: PLC0415

            told = f"'{word.text}' is one word for the program: a list has each word apart"
            apart = Rewritten(", ".join(map(repr, word.text.split()))) if word.verbatim else None
            tell = problems.error if reads else problems.warning  # of what ROS reads the node ends
            tell(Code.BAD_VALUE, told, word.location, suggestion=apart)


def _for_ros(text: str, following: str) -> str | None:
    """Return how a word is written that ROS is to read, None for one that it is not meant for."""
    if text in _PARAMETERS and _RULE.fullmatch(following):
        return f"{_FOR_ROS} {text}"
    if text == _FILE and following.endswith(_ENDINGS):
        return f"{_FOR_ROS} {text}"
    found = _OF_ROS_1.fullmatch(text)
    if found is None:
        return None
    option = _OPTIONS.get(found[1])
    return f"{_FOR_ROS} {option} {found[2]}" if option else f"{_FOR_ROS} -p {found[1]}:={found[2]}"


def is_written(word: Value) -> bool:
    """Return whether a word stands at its place as it is."""
    span = word.location.span
    width = span.end_column - span.column
    return word.verbatim or (span.line == span.end_line and width == len(word.text))


def _rules(words: Sequence[Value], *, for_ros: bool) -> Iterator[tuple[str, Value]]:
    """Yield the options with what follows them among the words that rcl reads."""
    reads = for_ros
    for word, following in pairwise(words):
        if word.text in ("--ros-args", "--"):
            reads = word.text == "--ros-args"
        elif reads and word.text in OPTIONS:
            yield word.text, following
