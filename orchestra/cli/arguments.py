"""The launch arguments of a plan, for people: `orchestra launch --show-args`."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Argument, Plan


def arguments_text(plan: Plan) -> str:
    """Return name, description, default and choices of every argument."""
    if not plan.arguments:
        return f"{plan.file} has no arguments\n"
    blocks = ["".join(f"{line}\n" for line in _lines(argument)) for argument in plan.arguments]
    return "\n".join([f"arguments of {plan.file}:\n", *blocks])


def _lines(argument: Argument) -> Iterator[str]:
    yield f"  {argument.name}"
    if argument.description:
        yield from (f"      {line}" for line in argument.description.splitlines())
    yield "      required" if argument.default is None else f"      default: {shlex.quote(argument.default)}"
    if argument.choices is not None:
        yield f"      choices: {', '.join(map(shlex.quote, argument.choices))}"
