"""`KeepAliveProc`: a process that does nothing until it is stopped."""

from __future__ import annotations

import sys
from typing import Any

from orchestra.compat.launch.actions.execute_process import ExecuteProcess

_IDLE = "import signal; signal.signal(signal.SIGINT, lambda *_: exit(0)); signal.pause()"


class KeepAliveProc(ExecuteProcess):
    """Keep a launch going that has no process of its own."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(name="keep_alive", cmd=[sys.executable, "-c", _IDLE], **kwargs)
