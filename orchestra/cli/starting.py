"""How a run is started that can be controlled, here or detached. Imported by what becomes the keeper."""

from __future__ import annotations

from orchestra.control.entrance import afterwards, attend
from orchestra.supervise.run import run

TYPE_CHECKING = False  # `typing` itself costs more than this module
if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.resolver.process import Prepare


def started(
    prepare: Prepare,
    *,
    detach: bool,
    wait_ready: bool,
    foresee: Callable[[], bool] | None = None,
) -> int:
    """Run what `prepare` describes and return the status of the command.

    `foresee` tells whether nodes in Python are to be expected, as long as nothing is known.
    Raises `OSError` where it cannot detach.
    """
    if not detach:
        return run(prepare, attend, afterwards, foresee)
    # Both only where they are needed: the keeper of a run at a terminal has no use for them.
    from orchestra.cli.detaching import detached  # noqa: PLC0415
    from orchestra.supervise.runs.running import state_path  # noqa: PLC0415

    return detached(
        f"{state_path()}/runs",
        lambda announcing: run(prepare, announcing(attend), afterwards, foresee),
        wait_ready=wait_ready,
    )
