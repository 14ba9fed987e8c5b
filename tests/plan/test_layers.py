"""What is told without the table of rcl is what the table tells."""

from __future__ import annotations

from functools import partial
from random import Random
from typing import TYPE_CHECKING, Final

from orchestra.errors import Problems
from orchestra.location import Location, point
from orchestra.plan.layers import Layers
from orchestra.resolve.model import FileParameters, InlineParameter, ParameterSource
from orchestra.resolve.rcl.effective import effective
from orchestra.resolve.rcl.files import read_parameter_file
from orchestra.resolve.rcl.indexed import Indexed
from orchestra.resolve.rcl.sections import Section, entry

if TYPE_CHECKING:
    from orchestra.values import ParameterValue

_AT = Location(point("made.launch.yaml"))
_NODES = ("/n", "/ns/n", "/m", "/ns/m")
_PATTERNS = ("/**", "/**", "/**", "**", "n", "/n", "/ns/n", "/**/n", "/ns/*")
_KEYS = ("a", "b", "c", "a.b", "c.d", "e")
_VALUES = ("1", "2", "2.5", "true", "x", "y", "[1, 2]", "[]")
_OWN: Final[tuple[ParameterValue, ...]] = (1, 2, 2.5, True, "x", (1, 2))


def _lines(rnd: Random, pad: int) -> list[str]:
    lines = []
    for key in rnd.sample(_KEYS, rnd.randrange(1, 4)):
        if pad < 8 and rnd.random() < 0.25:
            lines += [f"{' ' * pad}{key}:", *_lines(rnd, pad + 2)]
        else:
            lines.append(f"{' ' * pad}{key}: {rnd.choice(_VALUES[: rnd.choice((2, 2, 8))])}")
    return lines


def _file(rnd: Random) -> FileParameters:
    patterns = rnd.sample(_PATTERNS, rnd.choice((1, 1, 2, 3)))
    lines = [line for pattern in patterns for line in (f"{pattern}:", "  ros__parameters:", *_lines(rnd, 4))]
    return FileParameters("p.yaml", read_parameter_file("\n".join(lines), "p.yaml", Problems()), _AT)


def _section(source: InlineParameter, own: str) -> Section:
    item = entry(source.name, source.value, source.location)
    return Section("/**" if source.everywhere else own, (item,), source.location)


def _by_the_table(
    sources: list[ParameterSource], own: str, full: str | None
) -> tuple[dict[str, ParameterValue], bool]:
    """Return the values, and whether there is nothing to report of any."""
    sections: list[Section] = []
    for source in sources:
        if isinstance(source, InlineParameter):
            sections.append(_section(source, own))
        else:
            sections += Indexed(source.sections).everywhere() if full is None else source.sections
    settings = effective(sections, full or "/_")
    plain = all(item.value is not None and item.overruled is None for item in settings.values())
    return {name: item.value for name, item in settings.items() if item.value is not None}, plain


def test_layers_come_to_what_the_table_comes_to() -> None:
    rnd, told = Random(5), 0  # noqa: S311 - the same every time
    for _ in range(100):
        files = [_file(rnd) for _ in range(4)]
        for_all = [
            InlineParameter(rnd.choice(_KEYS), rnd.choice(_OWN), _AT, everywhere=True) for _ in range(2)
        ]
        layers = Layers(Indexed, partial(_section, own="/**"))
        kept: list[list[InlineParameter]] = []
        for node in (*_NODES, *_NODES, None):
            one = [InlineParameter(rnd.choice(_KEYS), rnd.choice(_OWN), _AT) for _ in range(2)]
            either: list[ParameterSource] = [*files, *files, *one]
            sources = [*rnd.sample(for_all, rnd.randrange(3)), *rnd.choices(either, k=3)]
            kept.append(one)  # they are known by their identities
            own = "/**" if node is None or rnd.random() < 0.5 else node
            found, (expected, plain) = layers.values(sources, own, node), _by_the_table(sources, own, node)
            if found is not None:
                told += 1
                assert (list(found.items()), plain) == (list(expected.items()), True)
    assert 200 < told < 800
