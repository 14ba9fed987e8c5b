"""What tests start hears the signals that they send."""

from __future__ import annotations

import signal


def heed_signals() -> None:
    """Ignore none of them: programs in the background of a shell ignore the first two, under nohup the third.

    What they start does so too.
    """
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGQUIT, signal.SIG_DFL)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
