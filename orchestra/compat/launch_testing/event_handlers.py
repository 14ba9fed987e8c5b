"""What tests wait for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.event_handlers.on_process_io import OnProcessIO

if TYPE_CHECKING:
    from collections.abc import Sequence


class StdoutReadyListener(OnProcessIO):
    """Visit actions when the output of a process has a text in it."""

    def __init__(self, *, target_action: Any = None, ready_txt: str, actions: Sequence[Any]) -> None:
        def on_stdout(event: Any) -> Any:
            return list(actions) if ready_txt in event.text.decode(errors="replace") else None

        super().__init__(target_action=target_action, on_stdout=on_stdout)
