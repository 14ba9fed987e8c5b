"""The simulation node: a MuJoCo world with any number of differential-drive robots.

Topics are relative to the node's namespace, but for `/clock` and `/tf_static`; parameters are in
`bringup.world.settings`.
"""

from __future__ import annotations

import sys

from bringup.world.stop import Stop


def main(args: list[str] | None = None) -> int:
    """Run the node; 0 after a whole or a stopped run, 1 and a line of log if it cannot be as asked."""
    stop = Stop()
    # Only now, because this takes a while: a signal that comes meanwhile is a wish to end, not a traceback.
    from bringup.world.running import serve  # noqa: PLC0415

    return serve(args, stop)


if __name__ == "__main__":
    sys.exit(main())
