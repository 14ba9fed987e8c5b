"""What unknown substitutions mean: slips, words of other languages, programs whose output is wanted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.substitutions import ELSEWHERE, SIGNATURES
from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.load.unquoted import in_quotes
from orchestra.load.words import snake
from orchestra.nearest import is_slip, nearest
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.text import Call, Template
    from orchestra.errors import Problems
    from orchestra.location import Span

_WORD: Final = pattern(r"[A-Za-z_]\w*")
# A name and its arguments that something else than a blank keeps apart.
_GLUED: Final = pattern(r"([A-Za-z][A-Za-z_-]*)[^\w ()'\"$-]+([A-Za-z_]\w*(?:/\S*)?)")
_SUM: Final = pattern(r"\([\w\s.+*/%()-]+\)")
_INNER: Final = pattern(r"\$\([^()]*\)")
# Programs whose output people want in a description.
_PROGRAMS: Final = frozenset(
    {
        *(
            "awk",
            "basename",
            "cat",
            "curl",
            "date",
            "dirname",
            "echo",
            "envsubst",
            "erb",
            "gz",
            "git",
            "grep",
        ),
        *("head", "hostname", "id", "ign", "jq", "ls", "nproc", "printf", "readlink", "realpath", "ros2"),
        *("rospack", "sed", "seq", "stat", "sudo", "tail", "tr", "uname", "uuidgen", "wc", "whoami", "xacro"),
        *("yq",),
    }
)
_SHELLS: Final = frozenset({"bash", "sh"})
# What asks for a package or a program, and the substitution that does.
_ASKING: Final = {
    ("ament_index", "get"): "find-pkg-share",
    ("colcon", "find"): "find-pkg-share",
    ("ros2", "pkg", "prefix", "--share"): "find-pkg-share",
    ("ros2", "pkg", "prefix"): "find-pkg-prefix",
    ("roscd",): "find-pkg-share",
    ("rospack", "find"): "find-pkg-share",
    ("which",): "find-exec",
}


def tell_unknown(call: Call, name: Span, end: Span, problems: Problems) -> None:
    """Report a substitution that there is not, at its name, and at its arguments where those are written otherwise."""
    told = f"there is no substitution $({call.name})"
    instead, span = _asked_for(call) or _run(call, name), name
    if instead is not None:
        span = replace(name, end_line=end.line, end_column=end.column)
        told = f"{told}: write $({instead})"
    else:
        instead = _meant(call.name, [argument.raw for argument in call.arguments])
    problems.error(Code.UNKNOWN_SUBSTITUTION, told, span, suggestion=instead)


def misnamed(written: str) -> tuple[str, str | None]:
    """Return what is told of the name of a substitution that is none, as `var:name` and `(1 + 2)`; what is meant."""
    told = f"{written!r} is not the name of a substitution"
    if _SUM.fullmatch(written):
        return told, f"eval '{written[1:-1]}'"
    glued = _GLUED.fullmatch(written)
    if glued is None:
        return told, None
    name = glued[1] if glued[1] in SIGNATURES else _meant(glued[1], [glued[2]])
    return told, None if name is None else f"{name} {glued[2]}"


def _asked_for(call: Call) -> str | None:
    """Return the substitution that does what a program is asked for."""
    words = (call.name, *(argument.raw for argument in call.arguments))
    for asking, name in _ASKING.items():
        if words[: len(asking)] == asking and len(words) == len(asking) + 1:
            return f"{name} {words[-1]}"
    return None


def _run(call: Call, at: Span) -> str | None:
    """Return the command that runs a program with these arguments, or that is in these words."""
    runs = call.name in _PROGRAMS
    is_command = ELSEWHERE.get(snake(call.name)) == "command" or call.name in ("exec", "execute")
    words = [_as_word(argument) for argument in call.arguments]
    if call.name in _SHELLS and words[:1] == ["-c"]:
        return None
    if not runs and not (is_command and len(words) > 1):
        return None
    command = in_quotes(" ".join([call.name, *words] if runs else words), at.file)
    return None if command is None else f"command {command}"


def _as_word(argument: Template) -> str:
    """Return an argument as a word of a command: one with blanks keeps quotes."""
    return f'"{argument.raw}"' if argument.quoted and " " in _INNER.sub("", argument.raw) else argument.raw


def _meant(name: str, arguments: Sequence[str]) -> str | None:
    """Return the substitution that an unknown name probably means, told by it and by the arguments as written.

    One without any is rather the name of a variable; of a single word there is nothing to evaluate.
    """
    if other := ELSEWHERE.get(snake(name)):
        return other
    near = nearest(name, SIGNATURES)
    if near == "eval" and len(arguments) == 1 and _WORD.fullmatch(arguments[0]):
        near = nearest(name, SIGNATURES.keys() - {"eval"}) or near
    if (
        near is None
        and (alias := nearest(snake(name), ELSEWHERE)) is not None
        and is_slip(snake(name), alias)
    ):
        return ELSEWHERE[alias]
    if near is not None or arguments:
        return near
    return f"{'env' if name.isupper() else 'var'} {name}"
