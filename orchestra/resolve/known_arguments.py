"""What can be told of the arguments of well-known programs, which end at once where they cannot read them.

`static_transform_publisher` of tf2_ros takes options, or as before Humble eight words or nine, with a quaternion; the
period that ROS 1 had behind them is none of them. The spawner of controller_manager takes options, of which the
shortest beginning that is clear will do. Source: the code of both, Humble to Jazzy. Everything is a warning: another
version may take more.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.nearest import is_slip, nearest
from orchestra.patterns import pattern
from orchestra.resolve.ros_rules import is_written

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.errors import Problems
    from orchestra.location import Location
    from orchestra.resolve.context import Value

_NUMBER: Final = pattern(r"\s*[-+]?(?:[0-9]|\.[0-9]|inf|nan)", re.IGNORECASE)
_NUMBERS: Final = ("--x", "--y", "--z", "--qx", "--qy", "--qz", "--qw", "--roll", "--pitch", "--yaw")
_FRAMES: Final = ("--frame-id", "--child-frame-id")
_EULER: Final = 8
_QUATERNION: Final = 9
_SPAWNER: Final = (
    *("--activate-as-group", "--controller-manager", "--controller-manager-timeout", "--controller-ros-args"),
    *("--controller-type", "--fallback_controllers", "--help", "--inactive", "--load-only", "--namespace"),
    *("--param-file", "--service-call-timeout", "--stopped", "--switch-asap", "--switch-timeout"),
    "--unload-on-kill",
)


def check_arguments(package: str, executable: str, words: Sequence[Value], problems: Problems) -> None:
    """Report what a program that is known cannot read among its words; those behind `--ros-args` are left alone."""
    check = _CHECKS.get((package, executable))
    said = [word.text for word in words]
    if check is not None and words:
        check(words[: said.index("--ros-args")] if "--ros-args" in said else words, problems)


def _check_transform(words: Sequence[Value], problems: Problems) -> None:
    if any(word.text.startswith("--") for word in words):
        _check_options(words, problems)
    elif words:
        _check_positions(words, problems)


def _check_options(words: Sequence[Value], problems: Problems) -> None:
    """Report options that there are not, values that are none, and frames that are not given."""
    known = (*_NUMBERS, *_FRAMES)
    at, given = 0, set[str]()
    while at < len(words):
        option, value = words[at], words[at + 1] if at + 1 < len(words) else None
        if option.text == "--help":
            return
        if not option.text.startswith("--"):
            return  # something before it is no word of its own, which is told
        if option.text not in known:
            told = f"static_transform_publisher has no option '{option.text}'"
            _tell(option, told, problems, nearest(option.text, known))
            return
        if value is None or value.text.startswith("--"):
            _tell(option, f"'{option.text}' is given no value", problems)
            return
        if option.text in _NUMBERS and not _is_number(value.text):
            _tell(value, f"'{value.text}' is no number, as {option.text} takes it", problems)
            return
        given.add(option.text)
        at += 2
    lacking = [name for name in _FRAMES if name not in given]
    if lacking:
        _tell(words[0], f"static_transform_publisher needs {' and '.join(lacking)}", problems)


def _check_positions(words: Sequence[Value], problems: Problems) -> None:
    """Report a wrong number of words, and what is no number of those that have to be."""
    numbers = {_EULER: 6, _QUATERNION: 7}.get(len(words))
    texts = [word.text for word in words]
    if any(" " in text for text in texts):
        return  # told to be several words
    if len(words) == _QUATERNION and _is_number(texts[-1]) and not _is_number(texts[6]):
        _tell(words[-1], "this is one too many: the period of ROS 1 is no argument any more", problems)
    elif numbers is None:
        told = f"static_transform_publisher takes 8 words (x y z yaw pitch roll frame child) or 9, not {len(words)}"
        problems.warning(Code.BAD_VALUE, told, _whole(words))
    else:
        for word in words[:numbers]:
            if not _is_number(word.text):
                _tell(word, f"'{word.text}' stands where a number is expected", problems)
                return


def _check_spawner(words: Sequence[Value], problems: Problems) -> None:
    for word in words:
        text = word.text.partition("=")[0]
        if not text.startswith("--") or any(option.startswith(text) for option in _SPAWNER):
            continue
        meant = nearest(text, _SPAWNER)
        if meant is not None and is_slip(text, meant):
            _tell(word, f"the spawner has no option '{text}'", problems, word.text.replace(text, meant, 1))


def _tell(word: Value, told: str, problems: Problems, meant: str | None = None) -> None:
    suggestion = meant if is_written(word) else None
    problems.warning(Code.BAD_VALUE, told, word.location, suggestion=suggestion)


def _whole(words: Sequence[Value]) -> Location:
    """Return the place of all words that stand in one line; else that of the first."""
    first, last = words[0].location, words[-1].location
    if first.span.line != last.span.end_line or first.span.file != last.span.file:
        return first
    return replace(first, span=replace(first.span, end_column=last.span.end_column))


def _is_number(text: str) -> bool:
    """Return whether a text begins with a number: more of it is not looked at (`std::stod`)."""
    return not text or _NUMBER.match(text) is not None


_CHECKS: Final[dict[tuple[str, str], Callable[[Sequence[Value], Problems], None]]] = {
    ("tf2_ros", "static_transform_publisher"): _check_transform,
    ("controller_manager", "spawner"): _check_spawner,
}
