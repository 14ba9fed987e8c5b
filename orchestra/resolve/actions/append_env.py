"""`append_env`."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.resolve.context import Poison
from orchestra.resolve.environment_names import is_faulty_name

if TYPE_CHECKING:
    from orchestra.description.actions.append_env import AppendEnv
    from orchestra.resolve.resolution import Resolution


def visit(action: AppendEnv, run: Resolution) -> None:
    """Add to an environment variable for what follows; one that is unset gets the new text alone."""
    name = run.text(action.name)
    with run.scope.tracing() as reads:
        value = run.text(action.value)
    prepend, separator = run.flag(action.prepend, default=False), run.text(action.separator)
    if not isinstance(name, str) or is_faulty_name(name, action.name, run):
        return
    if not isinstance(value, str) or not isinstance(prepend, bool) or isinstance(separator, Poison):
        run.found.lost.add(name)
        return
    present = run.scope.environment.get(name)
    texts = [value] if present is None else [value, present] if prepend else [present, value]
    joined = (os.pathsep if separator is None else separator).join(texts)
    run.scope.change(name, joined, run.at(action.value.span), tuple(reads))
