"""What matters of one process, a line each: a word that says what it is, then its value."""

from __future__ import annotations

import json
import shlex
from json.encoder import encode_basestring
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Final

from orchestra.plan.json_text import number

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from orchestra.plan.model import Process
    from orchestra.values import ParameterValue

_WIDTH: Final = 12
_BESIDE: Final = _WIDTH * " "
# Characters of a value: the description of a robot has thousands, and JSON shows all of them.
_LONGEST: Final = 400
_encoded: Final = json.JSONEncoder(ensure_ascii=False).encode
_path: Final = attrgetter("path")
# What many processes have, and then what few have, asked for in one call.
_frequent: Final = attrgetter(
    *("command", "shell", "parameters", "parameter_files", "remappings"),
    *("environment", "inherit_environment"),
    *("depends_on", "ready", "alive", "restart", "stop", "limits", "stdin", "lifecycle"),
)


class Details:
    """Tells what matters of processes, one after the other; words that many of them have are quoted once."""

    def __init__(self) -> None:
        self._word = _Quoted().__getitem__

    def of(self, process: Process, margin: str) -> str:
        """Return the lines, each behind the margin; a setting that has nothing to say has no line."""
        words, shell, values, files, rules, environment, inherits, *others = _frequent(process)
        beside = f"\n{margin}{_BESIDE}"
        command = f"sh: {' '.join(words)}" if shell else " ".join(map(self._word, words))
        told = command.replace("\n", beside) if "\n" in command else command
        text = f"{margin}command     {told}\n"
        if process.cwd:
            text += labelled("folder", [process.cwd], margin)
        if environment or not inherits:
            text += labelled("environment", _environment(process), margin)
        if values:
            text += f"{margin}parameters  {beside.join(_parameters(values))}\n"
        if files:
            text += f"{margin}files       {beside.join(map(_path, files))}\n"
        if rules:
            text += f"{margin}remaps      {beside.join(map(' -> '.join, rules))}\n"
        if process.output:
            text += labelled("output", [_output(process.output)], margin)
        if any(others):
            from orchestra.plan.render.conduct import conduct  # noqa: PLC0415 - as few plans need it

            text += "".join(labelled(label, values, margin) for label, values in conduct(process))
        return f"{text}{margin}required    the run ends with it\n" if process.required else text


def _parameters(values: dict[str, ParameterValue]) -> list[str]:
    """Return a line for each parameter."""
    write = _WRITE.get
    lines = [f"{name}: {(write(type(value)) or _encoded)(value)}" for name, value in values.items()]
    if max(map(len, lines)) <= _LONGEST:
        return lines
    return [
        f"{name}: {told if len(told := scalar(value)) <= _LONGEST else _shortened(told)}"
        for name, value in values.items()
    ]


class _Quoted(dict[str, str]):
    """Words as a shell reads them back."""

    def __missing__(self, word: str) -> str:
        self[word] = quoted = shlex.quote(word)
        return quoted


def process_kind(process: Process) -> str:
    """Return what a process is: its kind, and where its program is from."""
    described = process.kind.replace("_", " ")
    return f"{described} {process.package}/{process.executable}" if process.package else described


def scalar(value: ParameterValue | None) -> str:
    """Return a parameter value so that its type can be seen: text in quotes, lists in brackets."""
    return (_WRITE.get(type(value)) or _encoded)(value)


def _listed(values: Sequence[ParameterValue]) -> str:
    return f"[{', '.join(map(scalar, values))}]"


_WRITE: Final[Mapping[type, Callable[[Any], str]]] = {
    str: encode_basestring,
    float: number,
    int: int.__repr__,
    bool: {True: "true", False: "false"}.__getitem__,
    tuple: _listed,
    list: _listed,
}


def _shortened(value: str) -> str:
    return f"{value[:_LONGEST]} ... ({len(value) - _LONGEST} more characters, see --format json)"


def labelled(label: str, values: Iterable[str], margin: str) -> str:
    """Return values below each other, each on a line of its own behind a margin, the label before the first."""
    told = f"\n{margin}{_BESIDE}".join(values)
    return f"{margin}{label.ljust(_WIDTH)}{told}\n" if told else ""


def _output(output: str | dict[str, tuple[str, ...]]) -> str:
    if isinstance(output, str):
        return output
    return ", ".join(f"{stream} to {' and '.join(places)}" for stream, places in output.items())


def _environment(process: Process) -> Iterator[str]:
    if not process.inherit_environment:
        yield "nothing but"
    for name, value in process.environment.items():
        yield f"{name} unset" if value is None else f"{name}={shlex.quote(value)}"
