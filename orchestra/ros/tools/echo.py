"""`topic echo`."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any

from orchestra.errors import RunError
from orchestra.ros.tools.graph.hearing import identities, publishers, subscribe, type_of
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.graph.names import absolute
from orchestra.ros.tools.graph.qos import chosen, matched
from orchestra.ros.tools.losses import Losses
from orchestra.ros.tools.messages.commas import csv_text
from orchestra.ros.tools.messages.expressions import field_of, passes
from orchestra.ros.tools.messages.fields import is_message
from orchestra.ros.tools.messages.plain import WHOLE, Shortening, plain, value_of
from orchestra.ros.tools.messages.text import yaml_text
from orchestra.ros.tools.messages.types import message_class
from orchestra.ros.tools.telling import as_json, json_line, remark, warn

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable

_END = "---\n"


def echo(options: Namespace) -> int:
    """Write the messages of a topic as they come."""
    topic = absolute(options.topic)
    wanted = 1 if options.once else options.count
    shown = 0
    select, keep, render = _select(options.field), passes(options.filter), renderer(options)

    def heard(message: Any, about: dict[str, Any]) -> None:  # noqa: ANN401 - of any class
        nonlocal shown
        losses.number(about["publication_sequence_number"])
        chosen_part = message if options.raw else select(message)
        if (wanted is not None and shown >= wanted) or not (options.raw or keep(chosen_part)):
            return
        shown += 1
        sys.stdout.write(render(chosen_part, about))
        sys.stdout.flush()

    until = None if options.timeout is None else time.monotonic() + options.timeout
    with joined(options) as graph:
        kind = message_class(options.type or type_of(graph, topic))
        profile, said = chosen(options)
        if not said:
            profile, notes = matched(publishers(graph, topic), profile)
            for note in notes:
                remark(options, note)
        losses = Losses(
            lambda: identities(graph, topic), None if options.no_lost_messages else _tell_of_losses
        )
        lost = None if options.no_lost_messages else lambda status: losses.unheard(status.total_count_change)
        subscribe(graph.node, kind, topic, profile, heard, raw=options.raw, lost=lost)
        left = None if until is None else max(0.0, until - time.monotonic())
        enough = graph.wait(lambda: wanted is not None and shown >= wanted, left)
    if wanted is not None and not enough:
        raise RunError(f"{topic}: {shown} of {wanted} messages came within {options.timeout:g} s")
    return 0


def renderer(
    options: Namespace, worded: Callable[[dict[str, Any]], dict[str, Any]] = lambda told: told
) -> Callable[[Any, dict[str, Any]], str]:
    """Return what writes a message, or a part of one, as the options say; `worded` has words for numbers in YAML."""
    short = Shortening(
        None if options.full_length else options.truncate_length, options.no_arr, options.no_str
    )
    if as_json(options):
        return _json(options, short)
    if options.csv:
        return _csv(options, short)

    def text(part: Any, about: dict[str, Any]) -> str:  # noqa: ANN401 - of any class
        if not is_message(part):
            return _bare(part, about if options.include_message_info else None)
        info = yaml_text(dict(sorted(about.items()))) + _END if options.include_message_info else ""
        return f"{info}{yaml_text(worded(plain(part, short)), flow=options.flow_style)}{_END}"

    return text


def _bare(part: Any, about: dict[str, Any] | None) -> str:  # noqa: ANN401 - as above
    """Return what is no message, a single value, as the ROS 2 tools write it."""
    info = "" if about is None else f"---Got new message, message info:---\n{about}\n---Message data:---\n"
    return f"{info}{part}\n{_END}"


def _json(options: Namespace, short: Shortening) -> Callable[[Any, dict[str, Any]], str]:
    asked = Shortening(options.truncate_given, short.no_arrays, short.no_texts) if short != WHOLE else short

    def text(part: Any, about: dict[str, Any]) -> str:  # noqa: ANN401 - as above
        data = list(part) if isinstance(part, bytes) else value_of(part, asked)
        return json_line({"info": about, "message": data} if options.include_message_info else data)

    return text


def _csv(options: Namespace, short: Shortening) -> Callable[[Any, dict[str, Any]], str]:
    def text(part: Any, about: dict[str, Any]) -> str:  # noqa: ANN401 - as above
        if not is_message(part):
            return _bare(part, about if options.include_message_info else None)
        info = ",".join(map(str, about.values())) + "," if options.include_message_info else ""
        return info + csv_text(part, short)

    return text


def _select(path: str | None) -> Callable[[Any], Any]:
    return (lambda message: message) if path is None else field_of(path)


def _tell_of_losses(more: int, total: int) -> None:
    warn(f"A message was lost!!!\n\ttotal count change:{more}\n\ttotal count: {total}\n---")
