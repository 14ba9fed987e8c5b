"""What well-known nodes declare, whose packages have no file that says so.

A node of rclcpp refuses a value of another type and ends, and drops names that it does not declare without a word. Of
another version than the one here a node may declare more: so a name is told only where it is a slip for one of these,
and everything as a warning. Source: the nodes' own code, Humble to Jazzy.
"""

from __future__ import annotations

import re
from itertools import zip_longest
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.declared.judging import DeclaredParameters
from orchestra.declared.known_nodes import NODES, Known
from orchestra.declared.model import Declarations, Fault, Parameter
from orchestra.declared.rules import Size
from orchestra.fields import replace
from orchestra.nearest import is_slip
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from orchestra.declared.model import ParameterSchema, RosType
    from orchestra.values import ParameterValue

_FRAMES: Final = {"map_frame": "map", "odom_frame": "odom"}
_WORLD: Final = "world_frame"
_ROBOT: Final = "robot_description"
_OF_FILES: Final = pattern(r"[^<\s]+\.(?:urdf|xacro|sdf|xml)")
_WORD: Final = pattern(r"[a-z]+(?=_|$)")
_BETWEEN: Final = pattern(r"[_.-]+")
_LONG_WORD: Final = 6


def known_schema(package: str | None, called: str) -> ParameterSchema | None:
    """Return the schema of a node that is started by an executable of a package, or by a class; None for others."""
    known = NODES.get((package or "", called))
    if known is None:
        return None
    return _Known(DeclaredParameters(_declarations(known)), known, f"{called} of {package}")


@dataclass(frozen=True, slots=True)
class _Known:
    """The schema of a node that is known from its code."""

    declared: DeclaredParameters
    known: Known
    source: str

    def faults(self, values: Mapping[str, ParameterValue]) -> Iterator[Fault]:
        """Yield what is wrong with values by dotted name."""
        for fault in self._faults(values):
            yield replace(fault, certain=False, source=self.source)

    def _faults(self, values: Mapping[str, ParameterValue]) -> Iterator[Fault]:
        for fault in self.declared.faults(values):
            if fault.kind != "undeclared":
                if self._is_read(fault.name, values):
                    yield fault
            elif self._is_slip(fault, values):
                yield fault
            elif (meant := self._joined(fault.name) or self._numbered(fault.name, values)) is not None:
                yield replace(fault, meant=meant)
        if _WORLD in self.known.texts:
            yield from _of_frames(values)
        if _ROBOT in self.known.texts:
            yield from _of_robot(values)

    def _is_read(self, name: str, values: Mapping[str, ParameterValue]) -> bool:
        """Return whether the node declares a name, given the parameters that decide whether it does."""
        for item, decides in self.known.only_where:
            if (found := re.search(item, name)) is not None:
                return values.get(decides or found[1], False) is not False
        return True

    def _is_slip(self, fault: Fault, values: Mapping[str, ParameterValue]) -> bool:
        meant = fault.meant
        return meant is not None and meant not in values and _is_slip_of(fault.name, meant)

    def _joined(self, name: str) -> str | None:
        """Return the name that has the same letters: `initial_pose.x` for `initial_pose_x`."""
        letters = "".join(_words(name))
        names = (item.name for item in self.declared.declared.parameters)
        return next((other for other in names if "".join(_words(other)) == letters), None)

    def _numbered(self, name: str, values: Mapping[str, ParameterValue]) -> str | None:
        """Return a name that lacks its number with the first one that is free: `imu0_config` for `imu_config`."""
        begin = _WORD.match(name)
        if begin is None:
            return None
        numbered = (f"{begin[0]}{number}{name[begin.end() :]}" for number in range(10))
        free = (other for other in numbered if other not in values)
        patterns = self.declared.declared.patterns
        return next((other for other in free if any(re.search(item, other) for item, _ in patterns)), None)


def _is_slip_of(name: str, meant: str) -> bool:
    """Return whether a name is another one but for the order of its words, or for a slip in one of them.

    `imu_frame` is none of `map_frame`: another version may declare it.
    """
    one, other = _words(name), _words(meant)
    if sorted(one) == sorted(other) or "".join(one) == "".join(other):
        return True
    differing = [pair for pair in zip_longest(one, other, fillvalue="") if pair[0] != pair[1]]
    if len(differing) != 1 or not is_slip(*differing[0]):
        return False
    word, right = differing[0]
    return word[:1] == right[:1] or len(right) >= _LONG_WORD


def _words(name: str) -> list[str]:
    return _BETWEEN.split(name.lower())


def _declarations(known: Known) -> Declarations:
    rows: tuple[tuple[RosType, tuple[str, ...]], ...] = (
        ("bool", known.truths),
        ("integer", known.integers),
        ("double", known.doubles),
        ("string", known.texts),
        ("string_array", known.lists),
    )
    plain = (Parameter(name, (kind,)) for kind, names in rows for name in names)
    sized = (
        (name, Parameter(name, (kind,), rules=() if size is None else (Size(size, size),)))
        for name, kind, size in known.sized
    )
    patterns = tuple((pattern, item) for pattern, item in sized)
    return Declarations(tuple(plain), patterns, known.groups, undeclared="ignored")


def _of_frames(values: Mapping[str, ParameterValue]) -> Iterator[Fault]:
    """Yield that the world of a filter that publishes transforms is neither of the two frames that it can be."""
    if values.get("publish_tf") is False:
        return  # then the name is that of the frame in messages, and may be any
    world = values.get(_WORLD)
    frames = [values.get(name, default) for name, default in _FRAMES.items()]
    if isinstance(world, str) and world not in frames:
        told = f"'{_WORLD}' must be the value of map_frame or of odom_frame, not '{world}'"
        yield Fault("value", _WORLD, told, str(frames[-1]), whole=True)


def _of_robot(values: Mapping[str, ParameterValue]) -> Iterator[Fault]:
    """Yield that the description of a robot is the path of a file: the node parses what it is given, and ends."""
    given = values.get(_ROBOT)
    if isinstance(given, str) and _OF_FILES.fullmatch(given):
        told = f"'{_ROBOT}' is the description itself, not the path of a file that has it"
        yield Fault("value", _ROBOT, told)
