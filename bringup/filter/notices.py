"""What the filter has to say about its input while it runs, collected until somebody asks."""

from enum import IntEnum

from bringup.filter.rotation import Quaternion

_UNIT_TOLERANCE = 0.01


class Level(IntEnum):
    """Severities, with the values of diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2


class Notices:
    """The latest notice under each key, such as `imu0_twist_timestamp`."""

    def __init__(self) -> None:
        self._notices: dict[str, tuple[Level, str]] = {}

    def __bool__(self) -> bool:
        """Whether there is anything to tell."""
        return bool(self._notices)

    def warn(self, key: str, text: str) -> None:
        """Note something that the filter copes with."""
        self._notices[key] = (Level.WARN, text)

    def error(self, key: str, text: str) -> None:
        """Note something that keeps the filter from doing what it was told to."""
        self._notices[key] = (Level.ERROR, text)

    def withdraw(self, key: str) -> None:
        """Take back what has passed before anybody was told."""
        self._notices.pop(key, None)

    def take(self) -> dict[str, tuple[Level, str]]:
        """Give all notices and start afresh."""
        taken, self._notices = self._notices, {}
        return taken


def check_orientation(quaternion: Quaternion, name: str, notices: Notices) -> None:
    """Note a quaternion that is not of unit length; it is used normalised, a zero one as no rotation."""
    x, y, z, w = quaternion
    square = x * x + y * y + z * z + w * w
    if square == 0.0:
        notices.warn(
            f"{name}_orientation", f"{name}: the orientation is all zeros; it is taken as no rotation"
        )
    elif abs(square**0.5 - 1.0) > _UNIT_TOLERANCE:
        notices.warn(
            f"{name}_orientation", f"{name}: the orientation is not of unit length; it is normalised"
        )
