"""Forks, as the server does it."""

from __future__ import annotations

import os
import warnings

FAILED = -1


def fork() -> int:
    """Fork; `FAILED` where there is no memory or no room for one more process."""
    with warnings.catch_warnings():
        # Later interpreters warn of threads: libraries have some here, for tracing, and they are to be left behind.
        warnings.simplefilter("ignore")
        try:
            return os.fork()
        except OSError:
            return FAILED
