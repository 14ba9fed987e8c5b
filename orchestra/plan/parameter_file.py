"""The parameter file that carries a process's effective parameters to its node.

rcl's C parser gives a scalar its type by rules of its own, so every value is written in the one form that it reads
back as the same type and value: texts in double quotes, floats with a point and digits on both sides, lists in flow
style (measured: `tests/data/rcl-probes.jsonl`; tested against it).
"""

from __future__ import annotations

import math
import re
import sys
from typing import TYPE_CHECKING

from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from orchestra.plan.model import Process
    from orchestra.values import ParameterValue, Scalar

FOLDER = "${run}/params"

_INTEGERS = range(-(2**63), 2**63)
_LONGEST_SIMPLE_KEY = 1000  # libyaml looks ahead 1024 characters for the colon
_PLAIN_PATTERN = pattern(r"/[A-Za-z0-9_/*]*")
_PLAIN_NAME = pattern(r"(?!(?i:y|n|yes|no|on|off|true|false|null)\Z)[A-Za-z_][A-Za-z0-9_./]*")
_UNFIT = pattern(r"[^A-Za-z0-9_#-]")
_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}
# All that may not or should not stand for itself in double quotes: control characters, line breaks beyond ASCII,
# byte order marks, noncharacters, and the two characters of the notation.
_ESCAPED = pattern('["\\\\\x00-\x1f\x7f-\x9f\u2028\u2029\ufeff\ufffe\uffff]')


def render(process: Process) -> str:
    """Return the text of the parameter file of a process.

    It is keyed by the node's full name; by `/**` where name or namespace are not known before the node runs. Raises
    `ValueError` where rcl has no way to say a value or a name: an empty or mixed list, an integer beyond 64 bits, a
    text with NUL or a lone surrogate, an empty name.
    """
    if process.name is None or process.namespace is None:
        return rendered("/**", process.parameters)
    return rendered(f"{process.namespace.rstrip('/')}/{process.name}", process.parameters)


def rendered(node: str, parameters: Mapping[str, ParameterValue]) -> str:
    """Return the text of a parameter file with one section. Raises like `render`."""
    return with_lines(node, [line(name, value) for name, value in parameters.items()])


def with_lines(node: str, parameters: Sequence[str]) -> str:
    """Return the text of a parameter file with one section, of the lines of its parameters. Raises like `render`."""
    head = (f"{_key(node, _PLAIN_PATTERN)}:", f"  ros__parameters:{'' if parameters else ' {}'}")
    return "\n".join([*head, *parameters, ""])


def contents(process: Process) -> dict[str, str]:
    """Return the files that a process needs, by path as in its plan.

    What is passed on for other nodes in the process stands before the section of the node itself, which thus wins.
    Where the node's full name is not known, what is passed on is everything. Raises like `render`.
    """
    texts: dict[str, str] = {}
    for file in process.parameter_files:
        texts[file.path] = texts.get(file.path, "") + file.content
    own = path(process)
    named = process.name is not None and process.namespace is not None
    if process.parameters and (named or own not in texts) and own in process.command:
        texts[own] = texts.get(own, "") + render(process)
    return texts


def file_name(process: Process) -> str:
    """Return the name of the parameter file: `robot1.ekf.yaml` for `/robot1/ekf`; other ids give other names."""
    return path(process).rpartition("/")[2]


def path(process: Process) -> str:
    """Return where the file lies in a plan, below the symbolic run directory."""
    return path_of(process.id)


def path_of(identity: str) -> str:
    """Return where the parameter file of the process with an id lies in a plan."""
    name = identity.strip("/")
    if _UNFIT.search(name.replace("/", "_")) is not None:
        return f"{FOLDER}/{'.'.join(_UNFIT.sub(_percent, part) for part in name.split('/'))}.yaml"
    return f"{FOLDER}/{name.replace('/', '.')}.yaml"


def _percent(found: re.Match[str]) -> str:
    return "".join(f"%{byte:02X}" for byte in found[0].encode())


def line(name: str, value: ParameterValue) -> str:
    """Return what the file says of one parameter. Raises like `render`."""
    try:
        key, text = _key(name, _PLAIN_NAME), _value(value)
    except ValueError as error:
        raise ValueError(f"parameter {name!r}: {error}") from None
    if len(key) > _LONGEST_SIMPLE_KEY:
        return f"    ? {key}\n    : {text}"
    return f"    {key}: {text}"


def _key(name: str, plain: re.Pattern[str]) -> str:
    if not name:
        raise ValueError("a name must not be empty")
    return name if plain.fullmatch(name) else _quoted(name)


def _value(value: ParameterValue) -> str:
    if not isinstance(value, tuple):
        return _scalar(value)
    if not value:
        raise ValueError("an empty list has no type")
    if len({type(item) for item in value}) > 1:
        raise ValueError("a list must hold values of one type")
    return f"[{', '.join(map(_scalar, value))}]"


def _scalar(value: Scalar) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        if value not in _INTEGERS:
            raise ValueError(f"{value} does not fit into 64 bits")
        return str(value)
    return _float(value) if isinstance(value, float) else _quoted(value)


def _float(value: float) -> str:
    if math.isnan(value):
        return ".nan"
    if math.isinf(value):
        return ".inf" if value > 0 else "-.inf"
    if 0 < abs(value) < sys.float_info.min:
        return value.hex()  # an inexact subnormal is a range error to strtod, and then a string to rcl
    mantissa, exponent, power = repr(value).partition("e")
    return f"{mantissa}{'' if '.' in mantissa else '.0'}{exponent}{power}"


def _quoted(text: str) -> str:
    if text.isascii() and text.isprintable() and '"' not in text and "\\" not in text:
        return f'"{text}"'
    if "\0" in text:
        raise ValueError("a text must not hold NUL")
    if re.search("[\ud800-\udfff]", text):
        raise ValueError("a text must not hold a lone surrogate")
    return f'"{_ESCAPED.sub(_escape, text)}"'


def _escape(found: re.Match[str]) -> str:
    character = found[0]
    code = ord(character)
    return _ESCAPES.get(character) or (f"\\x{code:02X}" if code <= 0xFF else f"\\u{code:04X}")  # noqa: PLR2004
