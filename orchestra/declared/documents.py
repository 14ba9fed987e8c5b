"""Files that hold a declaration: their content, and where each part of it stands."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.errors import Code
from orchestra.location import Location, Span, displayed, point
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    from orchestra.errors import Problems

# The way to a part of a document: keys of mappings, indices of lists.
Way: TypeAlias = "tuple[str | int, ...]"

_LOADER: Final = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
# No declaration is as long, in characters, has as many parts or is as deep.
_MOST = 4_000_000
_MOST_PARTS = 200_000
_DEEPEST = 60


@dataclass(frozen=True, slots=True)
class Document:
    """A file as data. `included_from` is where a launch file, and its includers, name it."""

    path: str
    text: str
    data: Any
    included_from: tuple[Span, ...] = ()

    def at(self, way: Way = (), *, key: bool = False) -> Location:
        """Return the place of a part, or of the key it stands behind; as far as the way can be followed."""
        file = displayed(self.path)
        try:
            node = yaml.compose(self.text, Loader=_LOADER)
        except yaml.YAMLError:  # JSON that is no YAML
            node = None
        return Location(_span(file, node, way, key=key), self.included_from)


def read_document(path: str, named_at: Location | None, problems: Problems) -> Document | None:
    """Return a JSON or YAML file as data, None where it is neither (which is reported)."""
    chain = () if named_at is None else (named_at.span, *named_at.included_from)
    file = displayed(path)
    try:
        text = Path(path).read_bytes().decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        at = named_at or Location(point(file))
        problems.error(Code.UNREADABLE_FILE, f"cannot read {file}: {error}", at)
        return None
    if len(text) > _MOST:
        problems.error(Code.BROKEN_DECLARATION, f"{file} is too long for a declaration", named_at)
        return None
    try:
        data = json.loads(text) if path.endswith(".json") else yaml.load(text, Loader=_LOADER)
    except json.JSONDecodeError as error:
        _refuse(f"not JSON: {error.msg}", error.lineno, error.colno, file, chain, problems)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None) or getattr(error, "context_mark", None)
        line, column = (1, 1) if mark is None else (mark.line + 1, mark.column + 1)
        reason = getattr(error, "problem", None) or str(error)
        _refuse(f"not YAML: {reason}", line, column, file, chain, problems)
    except (RecursionError, ValueError) as error:
        told = "it nests too deep" if isinstance(error, RecursionError) else str(error)
        _refuse(f"cannot be read: {told}", 1, 1, file, chain, problems)
    else:
        if _is_reasonable(data):
            return Document(path, text, data, chain)
        _refuse("it nests too deep, or its aliases expand to too much", 1, 1, file, chain, problems)
    return None


def _is_reasonable(data: Any) -> bool:  # noqa: ANN401 - whatever a file holds
    """Return whether all parts can be visited: aliases of YAML may make a few lines endless."""
    waiting = [(data, 0)]
    for _ in range(_MOST_PARTS):
        if not waiting:
            return True
        item, depth = waiting.pop()
        if depth > _DEEPEST:
            return False
        inner = item.values() if isinstance(item, dict) else item if isinstance(item, list) else ()
        waiting += [(part, depth + 1) for part in inner]
    return False


def _refuse(
    told: str, line: int, column: int, file: str, chain: tuple[Span, ...], problems: Problems
) -> None:
    span = Span(file, line, column, line, column + 1)
    problems.error(Code.BROKEN_DECLARATION, told, Location(span, chain))


def _span(file: str, node: yaml.Node | None, way: Way, *, key: bool) -> Span:
    if node is None:
        return point(file)
    at = node
    for step in way:
        found = _step(node, step)
        if found is None:
            break
        name, node = found
        at = name if key else node
    start, end = at.start_mark, at.end_mark
    if isinstance(at, yaml.CollectionNode):  # where it begins says enough
        return Span(file, start.line + 1, start.column + 1, start.line + 1, start.column + 1)
    return Span(file, start.line + 1, start.column + 1, end.line + 1, end.column + 1)


def _step(node: yaml.Node, step: str | int) -> tuple[yaml.Node, yaml.Node] | None:
    """Return the key and the value of an entry; an item is its own key."""
    if isinstance(node, yaml.MappingNode):
        found = [(name, value) for name, value in node.value if name.value == str(step)]
        return found[-1] if found else None
    if isinstance(node, yaml.SequenceNode) and isinstance(step, int) and step < len(node.value):
        return node.value[step], node.value[step]
    return None
