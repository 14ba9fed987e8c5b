"""What the tools write on standard output: text as the ROS 2 tools write it, or JSON."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from argparse import Namespace


def tell(options: Namespace, text: str, data: Any) -> None:  # noqa: ANN401 - JSON data
    """Write an answer: the text, or the data where JSON is asked for, and so that whoever reads has it at once."""
    sys.stdout.write(json_line(data) if as_json(options) else text)
    sys.stdout.flush()


def as_json(options: Namespace) -> bool:
    """Tell whether JSON is asked for."""
    return bool(options.format == "json")


def json_line(data: Any) -> str:  # noqa: ANN401 - as above
    """Return data as one line of JSON. What it has no number for is null: not a number, and infinity."""
    try:
        text = json.dumps(data, ensure_ascii=False, allow_nan=False)
    except ValueError:
        text = json.dumps(_finite(data), ensure_ascii=False)
    return text + "\n"


def lines(items: Any) -> str:  # noqa: ANN401 - texts
    """Return texts, a line each."""
    return "".join(f"{item}\n" for item in items)


def remark(options: Namespace, text: str) -> None:
    """Say what the ROS 2 tools say among their answers; where JSON is asked for, on standard error."""
    stream = sys.stderr if as_json(options) else sys.stdout
    stream.write(f"{text}\n")
    stream.flush()


def warn(text: str) -> None:
    """Say something on standard error, beside the answer."""
    sys.stderr.write(f"{text}\n")


def _finite(data: Any) -> Any:  # noqa: ANN401 - as above
    if isinstance(data, dict):
        return {key: _finite(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [_finite(value) for value in data]
    if isinstance(data, float) and (data != data or data in (float("inf"), -float("inf"))):  # noqa: PLR0124
        return None
    return data
