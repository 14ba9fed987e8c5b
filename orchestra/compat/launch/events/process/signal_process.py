"""`SignalProcess`: some processes are to get a signal."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.events.process.process_targeted_event import ProcessTargetedEvent
from orchestra.compat.wrong import WrongType

if TYPE_CHECKING:
    from collections.abc import Callable


class SignalProcess(ProcessTargetedEvent):
    """Some processes are to get a signal. Raises `TypeError` for a number: it is to have its name."""

    name = "launch.events.process.SignalProcess"

    def __init__(
        self, *, signal_number: signal.Signals | str, process_matcher: Callable[[Any], bool]
    ) -> None:
        super().__init__(process_matcher=process_matcher)
        if isinstance(signal_number, str) and signal_number in signal.Signals.__members__:
            signal_number = signal.Signals[signal_number]
        if not isinstance(signal_number, signal.Signals):
            message = f"signal_number is one of signal.Signals, as signal.SIGINT, not {signal_number!r}"
            raise WrongType(message, signal_number, path=("signal_number",))
        self.__signal = signal_number

    @property
    def signal(self) -> signal.Signals:
        """The signal."""
        return self.__signal

    @property
    def signal_name(self) -> str:
        """Its name, as `SIGINT`."""
        return self.__signal.name
