"""Launch files and parameter files as nobody writes them: random in layout, with comments in odd places.

Comments are numbered, so that their order can be told without reading the text by any rule of the formatter's own.
"""

from __future__ import annotations

import itertools
from typing import Any

from hypothesis import strategies as st

_WORDS = (
    "a",
    "node",
    "exec name",
    "$(var x)",
    "/ns/n",
    "x: y",
    "1",
    "true",
    "-5",
    "0x1F",
    "1e-6",
    "y",
    "~",
    "",
    "# no",
)
_PLAIN = (
    "a",
    "node",
    "exec name",
    "$(var x)/b",
    "/ns/n",
    "1",
    "true",
    "-5",
    "0x1F",
    "1e-6",
    "y",
    "~",
    "1_000",
    "a#b",
)
_KEYS = ("a", "b", "name", "'quoted key'", '"k"', "/**", "ros__parameters", "param", "x y", "1")


@st.composite
def yaml_texts(draw: st.DrawFn) -> str:
    """Return a YAML text in some layout; most of them are readable."""
    numbers = itertools.count()
    lines = _node(draw, 0, 0).split("\n")
    if draw(st.booleans()):
        lines.insert(0, "---")
    text = []
    for line in lines:
        text.extend(_before(draw, numbers))
        comment = (
            f"{draw(st.sampled_from((' ', '   ', '          ')))}#c{next(numbers)}" if draw(_RARELY) else ""
        )
        text.append(line + comment + draw(st.sampled_from(("", "", "", " ", "\t"))))
    text.extend(_before(draw, numbers))
    return draw(st.sampled_from(("\n", "\n", "\r\n"))).join(text) + draw(
        st.sampled_from(("\n", "", "\n\n\n"))
    )


_RARELY = st.sampled_from((False, False, False, True))


def _before(draw: st.DrawFn, numbers: Any) -> list[str]:
    """Return empty lines and comments on lines of their own."""
    kinds = draw(st.lists(st.sampled_from(("", "   ", "#")), max_size=3)) if draw(_RARELY) else []
    return [f"{' ' * draw(st.integers(0, 9))}#c{next(numbers)}" if kind == "#" else kind for kind in kinds]


def _node(draw: st.DrawFn, indent: int, depth: int) -> str:
    """Return a block node; its first line is not indented."""
    if depth > 3:
        return _scalar(draw, indent)
    match draw(st.sampled_from(("scalar", "flow", "list", "map", "map", "list"))):
        case "scalar":
            return _scalar(draw, indent)
        case "flow":
            return _flow(draw, depth, indent)
        case "list":
            gaps = [draw(st.integers(1, 4)) for _ in range(draw(st.integers(1, 3)))]
            items = [f"-{' ' * gap}{_node(draw, indent + 1 + gap, depth + 1)}" for gap in gaps]
            return f"\n{' ' * indent}".join(items)
        case _:
            pairs = [_pair(draw, indent, depth) for _ in range(draw(st.integers(1, 3)))]
            return f"\n{' ' * indent}".join(pairs)


def _pair(draw: st.DrawFn, indent: int, depth: int) -> str:
    key = draw(st.sampled_from(_KEYS))
    match draw(st.sampled_from(("empty", "below", "below", "behind", "anchor"))):
        case "empty":
            return f"{key}:"
        case "below":
            inner = indent + draw(st.integers(1, 5))
            return f"{key}:\n{' ' * inner}{_node(draw, inner, depth + 1)}"
        case "anchor":
            inner = indent + draw(st.integers(1, 5))
            return f"{key}: &n{draw(st.integers(0, 99))}\n{' ' * inner}{_node(draw, inner, depth + 1)}"
        case _:
            value = _flow(draw, depth, indent) if draw(st.booleans()) else _scalar(draw, indent)
            return f"{key}:{' ' * draw(st.integers(1, 4))}{value}"


def _scalar(draw: st.DrawFn, indent: int) -> str:
    margin = " " * (indent + draw(st.integers(1, 5)))
    match draw(st.sampled_from(("plain", "plain", "single", "double", "literal", "lines"))):
        case "single":
            return "'" + draw(st.sampled_from(_WORDS)) + "'"
        case "double":
            return (
                '"'
                + draw(st.sampled_from(_WORDS))
                + draw(st.sampled_from(("", f"\n{margin}more", "\\\\")))
                + '"'
            )
        case "literal":
            head = draw(st.sampled_from(("|", ">", "|-", ">+", "|+")))
            more = draw(st.sampled_from(("", f"\n{margin}  in", f"\n\n{margin}after", f"\n{margin}   ")))
            return f"{head}\n{margin}{draw(st.sampled_from(_PLAIN))}{more}"
        case "lines":
            return f"word\n{margin}and word"
        case _:
            return draw(st.sampled_from(_PLAIN))


def _flow(draw: st.DrawFn, depth: int, indent: int) -> str:
    """Return a node in brackets, perhaps over several lines."""
    margin = " " * (indent + draw(st.integers(1, 9)))
    items = [_item(draw, depth, indent) for _ in range(draw(st.integers(0, 4)))]
    mapping = draw(st.booleans())
    if mapping:
        items = [f"k{index}:{' ' * draw(st.integers(1, 3))}{item}" for index, item in enumerate(items)]
    joined = items[0] if items else ""
    for item in items[1:]:
        joined += draw(st.sampled_from((",", ", ", " ,  ", f",\n{margin}")))
        joined += item if joined[-1] == " " else f" {item}"
    blank = draw(st.sampled_from(("", " ", f"\n{margin}")))
    return f"{{{blank}{joined}{blank}}}" if mapping else f"[{blank}{joined}{blank}]"


def _item(draw: st.DrawFn, depth: int, indent: int) -> str:
    if depth < 3 and draw(_RARELY):
        return _flow(draw, depth + 1, indent)
    return draw(st.sampled_from(("a", "1.0", "2", "'x, y'", '"z"', "true", "$(var x)")))


@st.composite
def xml_texts(draw: st.DrawFn) -> str:
    """Return an XML launch file in some layout."""
    numbers = itertools.count()
    return f"{_gap(draw, numbers)}<launch{_blank(draw, '')}>{_content(draw, 0, numbers)}</launch>{_gap(draw, numbers)}"


def _content(draw: st.DrawFn, depth: int, numbers: Any) -> str:
    count = draw(st.integers(0, 4)) if depth < 4 else 0
    return "".join(f"{_gap(draw, numbers)}{_element(draw, depth + 1, numbers)}" for _ in range(count)) + _gap(
        draw, numbers
    )


def _element(draw: st.DrawFn, depth: int, numbers: Any) -> str:
    name = draw(st.sampled_from(("node", "group", "arg", "param")))
    names = draw(
        st.lists(st.sampled_from(("name", "pkg", "exec", "if", "launch-prefix")), unique=True, max_size=4)
    )
    attributes = "".join(f"{_blank(draw, ' ')}{key}={_value(draw)}" for key in names).replace(
        "ns:x", "xmlns:x"
    )
    match draw(st.sampled_from(("empty", "content", "text"))):
        case "empty":
            return f"<{name}{attributes}{_blank(draw, '')}/>"
        case "text":
            return f"<{name}{attributes}> some\n   text<![CDATA[ <b> ]]></{name}>"
        case _:
            return f"<{name}{attributes}>{_content(draw, depth, numbers)}</{name}>"


def _value(draw: st.DrawFn) -> str:
    return draw(
        st.sampled_from(("'a'", '"b"', "'$(eval \"1\")'", '"&quot;&lt;$(var x)"', '"a\n   b"', '""', '"ü"'))
    )


def _blank(draw: st.DrawFn, least: str) -> str:
    return least + draw(st.sampled_from(("", "", " ", "\n", "\n     ", "\t")))


def _gap(draw: st.DrawFn, numbers: Any) -> str:
    """Return blanks and comments between elements."""
    kinds = draw(st.lists(st.sampled_from((" ", "\n", "\n\n\n", "    ", "#", "##", "?")), max_size=4))
    return "".join(_between(kind, numbers) for kind in kinds)


def _between(kind: str, numbers: Any) -> str:
    match kind:
        case "#":
            return f"<!-- c{next(numbers)}c -->"
        case "##":
            return f"<!-- c{next(numbers)}c\n    more\n -->"
        case "?":
            return "<?told what?>"
        case _:
            return kind
