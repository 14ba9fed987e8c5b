"""`tf tree`: all frames, as text, JSON, DOT, SVG or PDF."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from orchestra.errors import RunError
from orchestra.ros.tools.frames import Frames
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.telling import as_json, tell, warn
from orchestra.ros.tools.transforms import listen

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.frames import Edge

_SETTLED: Final = 0.5


def tree(options: Namespace) -> int:
    """Write the frames that are heard of within a time; where all are static, a shorter one is enough."""
    frames = Frames()
    with joined(options) as graph:
        listen(graph, frames)
        graph.whole(lambda: (graph.node.count_publishers("/tf"), graph.node.count_publishers("/tf_static")))
        began = time.monotonic()
        moving = graph.node.count_publishers("/tf") > 0
        graph.wait(lambda: False, options.wait if moving else min(_SETTLED, options.wait))
        if moving:  # somebody who is slow is waited for once more
            graph.wait(lambda: any(not edge.static for edge in frames.edges.values()), options.spin_time)
        heard = time.monotonic() - began
    if not frames.edges:
        raise RunError("nobody publishes transforms on /tf or /tf_static")
    for child, parents in sorted(frames.parents.items()):
        if len(parents) > 1:
            warn(f"warning: {child} has several parents: {', '.join(sorted(parents))}")
    text = _written(options, frames, heard)
    tell(options, text, [_data(child, edge, heard) for child, edge in sorted(frames.edges.items())])
    return 0


def _written(options: Namespace, frames: Frames, heard: float) -> str:
    """Return the frames as the options say; what is told of a PDF is the file that it is in."""
    if as_json(options) or not (options.dot or options.svg or options.pdf):
        return _text(frames, heard)
    dot = _dot(frames, heard)
    if options.dot:
        return dot
    from orchestra.plan.render.svg import drawn, image  # noqa: PLC0415 - other pictures do not need it

    if options.svg:
        return image(dot)
    Path(options.pdf).write_bytes(drawn(dot, "pdf"))
    return f"{options.pdf}\n"


def roots(frames: Frames) -> list[str]:
    """Return the frames without a parent; of frames in a circle, the first."""
    found = sorted(frame for frame in frames.names() if frame not in frames.edges)
    reached = {frame for root in found for frame in below(frames, root)}
    for frame in sorted(frames.edges):
        if frame not in reached:
            found.append(frame)
            reached.update(below(frames, frame))
    return found


def below(frames: Frames, root: str) -> list[str]:
    """Return a frame and all below it, each once."""
    found = {root: None}
    waiting = [root]
    while waiting:
        here = waiting.pop()
        for child in children(frames, here):
            if child not in found:
                found[child] = None
                waiting.append(child)
    return list(found)


def children(frames: Frames, parent: str) -> list[str]:
    """Return the frames whose parent a frame is."""
    return sorted(child for child, edge in frames.edges.items() if edge.parent == parent)


def _text(frames: Frames, seconds: float) -> str:
    rows: list[str] = []

    def draw(frame: str, before: str, seen: frozenset[str]) -> None:
        there = [child for child in children(frames, frame) if child not in seen]
        for place, child in enumerate(there):
            last = place == len(there) - 1
            rows.append(
                f"{before}{'└─ ' if last else '├─ '}{child}  ({_manner(frames.edges[child], seconds)})"
            )
            draw(child, before + ("   " if last else "│  "), seen | {child})

    for root in roots(frames):
        rows.append(root)
        draw(root, "", frozenset({root}))
    return "".join(f"{row}\n" for row in rows)


def _dot(frames: Frames, seconds: float) -> str:
    edges = "".join(
        f"  {_name(edge.parent)} -> {_name(child)} [label={_name(_manner(edge, seconds))}];\n"
        for child, edge in sorted(frames.edges.items())
    )
    return f"digraph frames {{\n{edges}}}\n"


def _name(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _manner(edge: Edge, seconds: float) -> str:
    return "static" if edge.static else f"{edge.heard / seconds:.1f} Hz"


def _data(child: str, edge: Edge, seconds: float) -> dict[str, Any]:
    return {
        "frame": child,
        "parent": edge.parent,
        "static": edge.static,
        "rate": None if edge.static else edge.heard / seconds,
        "latest": edge.latest,
    }
