"""What the keys of `teleop` mean: directions and speeds, as teleop_twist_keyboard has them, and the arrows. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Mapping

# Forward, left, up, and turning to the left, as shares of the speeds.
Direction = tuple[float, float, float, float]

STOPPED: Final[Direction] = (0, 0, 0, 0)
_DIRECTIONS: Final[Mapping[str, Direction]] = {
    "i": (1, 0, 0, 0),
    "o": (1, 0, 0, -1),
    "u": (1, 0, 0, 1),
    "j": (0, 0, 0, 1),
    "l": (0, 0, 0, -1),
    ",": (-1, 0, 0, 0),
    ".": (-1, 0, 0, 1),
    "m": (-1, 0, 0, -1),
    "I": (1, 0, 0, 0),
    "O": (1, -1, 0, 0),
    "U": (1, 1, 0, 0),
    "J": (0, 1, 0, 0),
    "L": (0, -1, 0, 0),
    "<": (-1, 0, 0, 0),
    ">": (-1, -1, 0, 0),
    "M": (-1, 1, 0, 0),
    "t": (0, 0, 1, 0),
    "b": (0, 0, -1, 0),
    "up": (1, 0, 0, 0),
    "down": (-1, 0, 0, 0),
    "left": (0, 0, 0, 1),
    "right": (0, 0, 0, -1),
}
# By how much a key changes the speed and the turning speed.
_CHANGES: Final[Mapping[str, tuple[float, float]]] = {
    "q": (1.1, 1.1),
    "z": (0.9, 0.9),
    "w": (1.1, 1.0),
    "x": (0.9, 1.0),
    "e": (1.0, 1.1),
    "c": (1.0, 0.9),
}
LEGEND: Final = """\
   u    i    o        arrows: forward, back, turn
   j    k    l        with shift: sideways instead of turning; t, b: up, down
   m    ,    .        any other key, as k or the space bar: stop

q, z: all speeds 10 % up, down    w, x: only the speed    e, c: only turning
Ctrl-C stops the robot and ends this.
"""


@dataclass(frozen=True, slots=True)
class Driving:
    """Where to, and how quickly: `speed` in m/s, `turn` in rad/s. No key takes them over the limits."""

    speed: float
    turn: float
    limits: tuple[float, float] = (float("inf"), float("inf"))
    direction: Direction = STOPPED

    def pressed(self, key: str) -> Driving:
        """Return what holds after a key."""
        if key in _CHANGES:
            speed, turn = _CHANGES[key]
            return replace(
                self,
                speed=min(self.speed * speed, self.limits[0]),
                turn=min(self.turn * turn, self.limits[1]),
            )
        return replace(self, direction=_DIRECTIONS.get(key, STOPPED))

    @property
    def command(self) -> Direction:
        """What is commanded: x, y and z in m/s, turning in rad/s."""
        x, y, z, turn = self.direction
        return (x * self.speed, y * self.speed, z * self.speed, turn * self.turn)
