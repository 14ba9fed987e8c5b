"""Ready when the process says so: READY=1 to the socket in its NOTIFY_SOCKET (sd_notify(3))."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.probes.protocol import Site


class NotifyProbe:
    """Listens to what the process notifies us of; what it says of its own state meanwhile is told."""

    looks_into_graph = False

    def __init__(self) -> None:
        self._status = ""

    @property
    def words(self) -> str:
        """What is awaited, and what the process says that it is doing."""
        return f"READY=1 from it ({self._status})" if self._status else "READY=1 from it"

    def begin(self, site: Site, came: Callable[[], None]) -> None:
        """Listen."""

        def ready(value: str) -> None:
            if value == "1":
                came()

        def status(value: str) -> None:
            self._status = value

        site.on_notice("READY", ready)
        site.on_notice("STATUS", status)

    def end(self) -> None:
        """Nothing is to be given back: the socket belongs to the process."""
