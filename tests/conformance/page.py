"""The page `docs/compatibility.md`, made of rows and of the tests that hold to them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from tests.conformance.rows import Language, Row, Section

_HEAD = """\
# Compatibility with ROS 2's launch

Row by row, the launch language of ROS 2 Jazzy, what Orchestra makes of it, and the tests that hold it to that; then
[what is deliberately different](#deliberate-differences), and why. *As upstream* means that a launch file that was right
there means the same here.

This page is written by `python -m tests.conformance` from `docs/compatibility.toml` and the marks of the tests.
"""
_TESTS = "../tests"
_CODE = re.compile(r"[A-Z_.:=-]")
_DIFFERENCE = re.compile(r"\bD\d+\b")


def faults(language: Language, tests: Mapping[str, Sequence[str]]) -> list[str]:
    """Return what is wrong: rows that nobody tests, marks and references to what there is not."""
    known = set(language.identities)
    unknown = [f"no row {name!r}: {', '.join(found)}" for name, found in tests.items() if name not in known]
    return [*unknown, *_untested(language, tests), *_dangling(language)]


def _untested(language: Language, tests: Mapping[str, Sequence[str]]) -> Iterator[str]:
    for section in language.sections:
        for row in section.rows:
            if not row.absent and section.identity(row) not in tests:
                yield f"no test of {section.identity(row)!r}"
    for name in language.differences:
        if name not in tests:
            yield f"no test of {name!r}"


def _dangling(language: Language) -> Iterator[str]:
    used = {name for section in language.sections for row in section.rows for name in row.differs}
    return (f"no difference {name!r}" for name in sorted(used - set(language.differences)))


def render(language: Language, tests: Mapping[str, Sequence[str]]) -> str:
    """Return the page."""
    parts = [_HEAD, *(_table(section, tests) for section in language.sections), _differences(language, tests)]
    return "\n".join([*parts, _targets(tests)])


def _table(section: Section, tests: Mapping[str, Sequence[str]]) -> str:
    lines = [f"## {section.number} {section.title}", "", "| row | is | here | tests |", "|---|---|---|---|"]
    for row in section.rows:
        found = tests.get(section.identity(row), ())
        lines.append(_line(_code(row.name), row.says, _status(row, found), _links(found)))
    return "\n".join([*lines, ""])


def _status(row: Row, found: Sequence[str]) -> str:
    if row.absent:
        return f"not provided: {_DIFFERENCE.sub(_to_difference, row.absent)}"
    if row.differs:
        return f"differs: {_DIFFERENCE.sub(_to_difference, ', '.join(row.differs))}"
    return "as upstream" if found else "not tested"


def _to_difference(name: re.Match[str]) -> str:
    return f"[{name[0]}](#{name[0].lower()})"


def _differences(language: Language, tests: Mapping[str, Sequence[str]]) -> str:
    lines = ["## Deliberate differences", "", "| | upstream | here | why | tests |", "|---|---|---|---|---|"]
    for name, difference in language.differences.items():
        anchor = f'<a id="{name.lower()}"></a>{name}'
        told = (difference.upstream, difference.here, difference.why)
        lines.append(_line(anchor, *told, _links(tests.get(name, ()))))
    return "\n".join([*lines, ""])


def _line(*cells: str) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _code(name: str) -> str:
    return f"`{name}`" if _CODE.search(name) and " " not in name else name


def _links(found: Sequence[str]) -> str:
    """Return each file once, with the names of its tests behind it."""
    files: dict[str, list[str]] = {}
    for test in found:
        path, _, name = test.partition("::")
        files.setdefault(path, []).append(name.removeprefix("test_").replace("_", " "))
    return "; ".join(f"[{_short(path)}]: {', '.join(names)}" for path, names in files.items())


def _targets(tests: Mapping[str, Sequence[str]]) -> str:
    """Return where the links to files lead."""
    paths = {test.partition("::")[0] for found in tests.values() for test in found}
    return "".join(f"[{_short(path)}]: {_TESTS}/{path}\n" for path in sorted(paths))


def _short(path: str) -> str:
    """Return the name of a file of tests without what all of them have."""
    return path.removesuffix(".py").replace("test_", "")
