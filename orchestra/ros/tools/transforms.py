"""`tf echo`, and hearing of transforms."""

from __future__ import annotations

import time
from math import degrees
from typing import TYPE_CHECKING, Any, Final

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from orchestra.errors import RunError
from orchestra.nearest import nearest
from orchestra.ros.interfaces import tf_message_type
from orchestra.ros.tools.frames import Frames, Transform, angles, matrix
from orchestra.ros.tools.graph.hearing import subscribe
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.telling import as_json, tell, warn

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.joining import Graph

_DEPTH: Final = 1000
# Everybody is heard: who publishes reliably, and who does not.
MOVING: Final = QoSProfile(
    history=HistoryPolicy.KEEP_LAST, depth=_DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT
)
STATIC: Final = QoSProfile(
    history=HistoryPolicy.KEEP_LAST, depth=_DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL
)
_TELL_AGAIN: Final = 1.0
_NANOSECONDS: Final = 1e9


def listen(graph: Graph, frames: Frames) -> None:
    """Hear all transforms from now on, and the static ones of before."""
    kind = tf_message_type()

    def hear(message: Any, *, static: bool) -> None:  # noqa: ANN401 - of a class made here
        for one in message.transforms:
            place, turn = one.transform.translation, one.transform.rotation
            frames.hear(
                one.header.frame_id.removeprefix("/"),
                one.child_frame_id.removeprefix("/"),
                one.header.stamp.sec + one.header.stamp.nanosec / _NANOSECONDS,
                Transform((place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w)),
                static=static,
            )

    subscribe(graph.node, kind, "/tf", MOVING, lambda message, _: hear(message, static=False))
    subscribe(graph.node, kind, "/tf_static", STATIC, lambda message, _: hear(message, static=True))


def echo(options: Namespace) -> int:
    """Write where one frame is in another, once or again and again."""
    wanted = 1 if options.once else options.count
    frames, shown = Frames(), 0
    ends = (options.source.removeprefix("/"), options.target.removeprefix("/"))
    with joined(options) as graph:
        listen(graph, frames)
        began = due = time.monotonic()
        while wanted is None or shown < wanted:
            found = frames.between(*ends)
            if found is not None:
                tell(options, _text(*found), _data(*ends, *found))
                shown += 1
                due = max(due + 1 / options.rate, time.monotonic())
                graph.wait(lambda: False, due - time.monotonic() if shown != wanted else 0)
                continue
            left = None if options.timeout is None else began + options.timeout - time.monotonic()
            if left is not None and left <= 0:
                raise RunError(_missing(frames, *ends, options.timeout))
            patience = _TELL_AGAIN if left is None else min(_TELL_AGAIN, left)
            if not graph.wait(lambda: frames.between(*ends), patience) and not as_json(options):
                warn(f"Waiting for transform {ends[0]} -> {ends[1]}: {_why(frames, *ends)}")
            due = time.monotonic()
    return 0


def _missing(frames: Frames, source: str, target: str, seconds: float) -> str:
    return f"no transform from {source} to {target} within {seconds:g} s: {_why(frames, source, target)}"


def _why(frames: Frames, source: str, target: str) -> str:
    """Return why there is no transform."""
    known = frames.names()
    for frame in (source, target):
        if frame not in known:
            near = nearest(frame, known)
            return f"there is no frame {frame}" + (f"; did you mean {near}?" if near else "")
    return "they are not connected"


def _text(when: float, transform: Transform) -> str:
    place, turn = transform.translation, transform.rotation
    radians = angles(turn)
    seconds, _, rest = f"{when:.9f}".partition(".")
    rows = [
        f"At time {seconds}.{rest.rstrip('0') or '0'}",
        f"- Translation: {_row(place)}",
        f"- Rotation: in Quaternion (xyzw) {_row(turn)}",
        f"- Rotation: in RPY (radian) {_row(radians)}",
        f"- Rotation: in RPY (degree) {_row(tuple(map(degrees, radians)))}",
        "- Matrix:",
        *(
            "".join(f" {value:6.3f}" for value in (*row, offset))
            for row, offset in zip(matrix(turn), place, strict=True)
        ),
        "".join(f" {value:6.3f}" for value in (0.0, 0.0, 0.0, 1.0)),
    ]
    return "".join(f"{row}\n" for row in rows)


def _row(values: tuple[float, ...]) -> str:
    return "[" + ", ".join(f"{value:.3f}" for value in values) + "]"


def _data(source: str, target: str, when: float, transform: Transform) -> dict[str, Any]:
    return {
        "source": source,
        "target": target,
        "time": when,
        "translation": list(transform.translation),
        "rotation": list(transform.rotation),
        "rpy": list(angles(transform.rotation)),
    }
