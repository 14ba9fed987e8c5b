"""What a service manager that has started us says to us, and to nobody that we start."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import MutableMapping

# sd_notify(3), sd_watchdog_enabled(3), sd_listen_fds(3): each of them is for one process alone.
PERSONAL = (
    *("NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"),
    *("LISTEN_PID", "LISTEN_PIDFDID", "LISTEN_FDS", "LISTEN_FDNAMES"),
)


class Summons:
    """Where the service manager listens, None where there is none; the seconds between two signs of life it wants."""

    __slots__ = ("address", "period")

    def __init__(self, address: str | None = None, period: float | None = None) -> None:
        self.address = address
        self.period = period


def taken(environment: MutableMapping[str, str], keeper: int) -> Summons:
    """Take out of the environment what a service manager has put there; `keeper` is the process that it started."""
    said = {name: environment.pop(name, "") for name in PERSONAL}
    address, microseconds = said["NOTIFY_SOCKET"], said["WATCHDOG_USEC"]
    meant = said["WATCHDOG_PID"] in ("", str(keeper))
    counts = meant and microseconds.isascii() and microseconds.isdigit() and int(microseconds) > 0
    return Summons(address or None, int(microseconds) / 1e6 if address and counts else None)
