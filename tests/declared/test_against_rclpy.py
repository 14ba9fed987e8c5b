"""What is told of types and ranges is what rclpy does: it takes the same values, and refuses the same."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from orchestra.declared.capturing.json_schema import as_json_schema
from orchestra.declared.capturing.model import Captured, CapturedParameter
from orchestra.declared.documents import Document
from orchestra.declared.json_schema import read_schema
from orchestra.errors import Problems

pytest.importorskip("rclpy", reason="needs ROS")

_ORACLE = Path(__file__).with_name("rclpy_oracle.py")
_VALUES: list[Any] = [
    *(True, 3, 3.0, 2.5, "3", "x"),
    *([True], [1, 2], [1.0, 2.5], ["a"], ["1"]),
]
_TYPES = (
    "bool",
    "integer",
    "double",
    "string",
    "bool_array",
    "integer_array",
    "double_array",
    "string_array",
)
_RANGES: list[tuple[str, list[float]]] = [
    ("integer", [0, 10, 0]),
    ("integer", [1, 10, 4]),
    ("integer", [-3, 9, 3]),
    ("double", [0.0, 1.0, 0.0]),
    ("double", [0.5, 2.0, 0.25]),
    ("double", [-1.0, 1.0, 0.1]),
]
_NUMBERS: dict[str, list[Any]] = {
    "integer": list(range(-4, 13)),
    "double": [-1.5, -1.0, -0.7, -0.05, 0.0, 0.1, 0.3, 0.5, 0.6, 0.75, 1.0, 1.9, 2.0, 2.1],
}
_ROWS: list[tuple[str, Any, list[float] | None]] = [
    *((kind, value, None) for kind in _TYPES for value in _VALUES),
    *((kind, value, limits) for kind, limits in _RANGES for value in _NUMBERS[kind]),
]


def _taken_by_rclpy() -> list[bool]:
    lines = "".join(
        json.dumps({"type": kind, "value": value, "range": limits}) + "\n" for kind, value, limits in _ROWS
    )
    done = subprocess.run(
        [sys.executable, str(_ORACLE)],
        input=lines,
        env={**os.environ, "ROS_DOMAIN_ID": "46", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"},
        capture_output=True,
        text=True,
        check=True,
    )
    return [json.loads(line) for line in done.stdout.splitlines()]


def _taken(kind: str, value: Any, limits: list[float] | None) -> bool:
    """Return whether the schema that would be captured of such a declaration takes the value."""
    span = None if limits is None else (limits[0], limits[1], limits[2])
    schema = as_json_schema(Captured("/n", (CapturedParameter("x", kind, None, range=span),)))
    problems = Problems()
    read = read_schema(Document("s.json", "", schema), problems)
    assert read is not None, list(problems)
    return not list(read.faults({"x": tuple(value) if isinstance(value, list) else value}))


def test_the_same_values_are_taken() -> None:
    real = _taken_by_rclpy()
    assert len(real) == len(_ROWS)
    differing = [row for row, taken in zip(_ROWS, real, strict=True) if _taken(*row) != taken]
    assert differing == []
    assert 0 < sum(real) < len(real)
