"""A graph, as that of a plan, as an image in SVG or PDF, which Graphviz draws."""

from __future__ import annotations

import shutil
import subprocess
from typing import TYPE_CHECKING

from orchestra.errors import RunError, UsageError
from orchestra.plan.render import dot
from orchestra.plan.render.setting import Setting

if TYPE_CHECKING:
    from orchestra.plan.model import Plan

# Graphviz takes a second for a thousand nodes; there are graphs that it never ends with.
_PATIENCE = 60.0


def render(plan: Plan, setting: Setting = Setting(), /) -> str:  # noqa: B008 - it is frozen
    """Return the image of a plan. Raises as `image` does."""
    return image(dot.render(plan, setting))


def image(source: str) -> str:
    """Return the SVG that Graphviz draws of a text in DOT. Raises as `drawn` does."""
    return drawn(source, "svg").decode()


def drawn(source: str, form: str) -> bytes:
    """Return what Graphviz draws of a text in DOT, in a form as `svg` or `pdf`.

    Raises `UsageError` where Graphviz is not installed, `RunError` where it fails.
    """
    program = shutil.which("dot")
    if program is None:
        raise UsageError(
            "the program `dot` of Graphviz draws this, and it is not installed; --format dot needs none"
        )
    try:
        done = subprocess.run(  # noqa: S603 - the program that was found
            [program, f"-T{form}"], input=source.encode(), capture_output=True, timeout=_PATIENCE, check=False
        )
    except subprocess.TimeoutExpired:
        raise RunError(f"Graphviz has not drawn this in {_PATIENCE:g} s") from None
    if done.returncode:
        raise RunError(f"Graphviz could not draw this: {done.stderr.decode(errors='replace').strip()}")
    return done.stdout
