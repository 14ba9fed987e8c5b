"""What code of a Python launch file has computed, turned back into what it was computed from.

`os.path.join(get_package_share_directory('p'), 'x')` is a text of this machine: it becomes `$(find-pkg-share p)/x`.
"""

from __future__ import annotations

import ast
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.compat.place import span_in
from orchestra.convert.mapped import mapped, with_parts
from orchestra.description.actions.set_env import SetEnv
from orchestra.description.actions.unset_env import UnsetEnv
from orchestra.description.text import Call, Constant, Template, Words
from orchestra.location import point

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from orchestra.convert.original import Original
    from orchestra.convert.remarks import Remarks
    from orchestra.description.entity import Action
    from orchestra.location import Span

_SURROUNDINGS = {
    ("os", "environ"),
    ("os", "getenv"),
    ("sys", "argv"),
    ("platform", "node"),
    ("socket", "gethostname"),
}
_FOLDER_OF_FILE = re.compile(r"\b__file__\b")


def recovered(actions: tuple[Action, ...], original: Original, remarks: Remarks) -> tuple[Action, ...]:
    """Return the actions of a Python file with calls in place of the folders that its code has asked for."""
    places = dict(original.places)
    if _FOLDER_OF_FILE.search(original.text):
        folder = str(Path(original.path).parent)
        places.setdefault(original.path, ("filename", ""))
        places.setdefault(folder, ("dirname", ""))
    _warn_of_surroundings(original, remarks)
    recovery = _Recovery(places, original.text, remarks)
    return tuple(mapped(action, recovery.of) for action in (*_environment(original), *actions))


def _environment(original: Original) -> Iterator[Action]:
    """Yield the actions that say what code has made of the environment before anything else."""
    at = point(original.file)
    for name, value in original.environment.items():
        template = Template((Words(name, at),), name, at)
        if value is None:
            yield UnsetEnv.at(at, name=template)
        else:
            yield SetEnv.at(at, name=template, value=Template((Words(value, at),), "", at))


class _Recovery:
    """Finds folders in texts."""

    def __init__(self, places: Mapping[str, tuple[str, str]], source: str, remarks: Remarks) -> None:
        self._places = places
        self._source = source
        self._remarks = remarks
        self._environment = frozenset(os.environ.values())
        longest_first = sorted(places, key=len, reverse=True)
        found = f"({'|'.join(map(re.escape, longest_first))})(?![\\w.-])"
        self._pattern = re.compile(found) if places else None

    def of(self, value: Template | Constant) -> Template | Constant | tuple[Template | Constant, ...]:
        """Return a value with calls for the folders in it."""
        if isinstance(value, Template):
            return with_parts(value, lambda part: tuple(self._parts(part)))
        if isinstance(value.value, tuple):
            items = tuple(self._constant(Constant(item, value.span)) for item in value.value)
            return items if any(isinstance(item, Template) for item in items) else value
        return self._constant(value)

    def _constant(self, constant: Constant) -> Template | Constant:
        if not isinstance(constant.value, str):
            return constant
        parts = tuple(self._parts(Words(constant.value, constant.span)))
        if len(parts) == 1 and isinstance(parts[0], Words):
            return constant
        return Template(parts, constant.value, constant.span)

    def _parts(self, part: Any) -> Iterator[Any]:  # noqa: ANN401 - a part of a description, whatever it is
        if not isinstance(part, Words):
            yield part
            return
        pieces = [part.text] if self._pattern is None else self._pattern.split(part.text)
        for index, piece in enumerate(pieces):
            if index % 2:
                name, package = self._places[piece]
                argument = Template((Words(package, part.span),), package, part.span)
                yield Call(name, (argument,) if package else (), part.span)
            elif piece:
                self._look_at(piece, part.span, alone=len(pieces) == 1)
                yield Words(piece, part.span)

    def _look_at(self, text: str, span: Span, *, alone: bool) -> None:
        """Tell of a path of this machine that the file does not spell out."""
        path = Path(text)
        known = text in self._source or text in self._environment
        if alone and path.is_absolute() and len(text) > 1 and not known and _is_there(path):
            self._remarks.warn(f"code has come to the path {text}: the result has it as it is here", span)


def _warn_of_surroundings(original: Original, remarks: Remarks) -> None:
    """Tell of code that reads the environment or the command line: the result has what these come to here and now."""
    for node in ast.walk(ast.parse(original.text)):
        match node:
            case ast.Attribute(value=ast.Name(id=module), attr=name) if (module, name) in _SURROUNDINGS:
                told = f"{module}.{name} is read when the file is converted: the result has what it is then"
                positions = (node.lineno, node.end_lineno, node.col_offset, node.end_col_offset)
                remarks.warn(told, span_in(original.path, positions))


def _is_there(path: Path) -> bool:
    """Return whether something is at a path; one that the system refuses is not."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False
