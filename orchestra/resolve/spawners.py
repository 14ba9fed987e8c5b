"""Names that spawners of ros2_control are given: of controllers, and of the manager that has them.

Another launch file, or a simulation, may have controllers that are not in this one: told is only a name that is a slip
for that of a controller whose type is known here. Source: `controller_manager/spawner.py`, Humble to Jazzy.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.nearest import may_look
from orchestra.resolve.model import FileParameters
from orchestra.resolve.parameter_files import sections_in
from orchestra.resolve.ros_rules import is_written
from orchestra.resolve.typos import is_typo

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from orchestra.errors import Problems
    from orchestra.resolve.context import Value
    from orchestra.resolve.model import ResolvedProcess
    from orchestra.resolve.resolution import Resolution

_MANAGER: Final = ("controller_manager", "ros2_control_node")
_NAME: Final = "controller_manager"  # of the manager, where it is given none
_ITS_NAME: Final = ("--controller-manager", "-c")
_FILE: Final = ("--param-file", "-p")
_SEVERAL: Final = "--fallback_controllers"  # which takes more than one
_FLAGS: Final = (
    *("--activate-as-group", "--help", "--inactive", "--load-only", "--stopped", "--switch-asap"),
    "--unload-on-kill",
)
_SHORT_FLAGS: Final = ("-h", "-u")
_TYPE: Final = ".type"
_STEPS: Final = 4  # of a look at a name, see `may_look`


def warn_of_spawned(run: Resolution) -> None:
    """Tell of the names that are slips, among the words of all spawners."""
    managers = [item for item in run.found.processes if (item.package, item.executable) == _MANAGER]
    known, taken = set[str](), set[str]()
    asked: list[tuple[Value, bool]] = []
    for words in run.found.spawned:
        said = tuple(_said(words))
        asked += [(word, option in _ITS_NAME) for option, word in said if option in ("", *_ITS_NAME)]
        taken.update(word.text for option, word in said if not option)
        files = [word.text for option, word in said if option in _FILE]
        known.update(name for file in files for name in _in_file(file))
    known.update(name for manager in managers for name in _given_to(manager))
    names = {_NAME if item.name is None else item.name.text for item in managers if not item.faulty}
    for word, is_manager in asked:
        if is_manager:
            _check(word, names, "no controller manager", run.problems)
        elif word.text not in known:
            _check(word, known - taken, "no controller", run.problems)


def _check(word: Value, names: set[str], what: str, problems: Problems) -> None:
    called = word.text.rpartition("/")[2]
    if called in names or not may_look(_STEPS * len(names)):
        return
    near = [name for name in names if is_typo(called, name)]
    if len(near) == 1:
        told = f"{what} is called '{word.text}' here"
        meant = word.text[: len(word.text) - len(called)] + near[0] if is_written(word) else None
        notes = () if meant is not None else (f"did you mean '{near[0]}'?",)
        problems.warning(Code.UNKNOWN_DEPENDENCY, told, word.location, suggestion=meant, notes=notes)


def _said(words: Sequence[Value]) -> Iterator[tuple[str, Value]]:
    """Yield the words of a spawner that are values, each with its option; the names of controllers have none."""
    option = ""
    for word in words:
        name, sign, _ = word.text.partition("=")
        if name.startswith("-"):
            is_flag = name in _SHORT_FLAGS or any(flag.startswith(name) for flag in _FLAGS)
            option = "" if is_flag or sign else name
        else:
            yield option, word
            option = option if option == _SEVERAL else ""


def _given_to(manager: ResolvedProcess) -> Iterator[str]:
    """Yield the controllers whose types a manager is given."""
    for given in (*manager.parameters, *manager.parameter_arguments):
        if isinstance(given, FileParameters):
            yield from _typed(entry.name for section in given.sections for entry in section.entries)
        else:
            yield from _typed([given.name])


def _typed(names: Iterable[str]) -> Iterator[str]:
    for name in names:
        controller = name.removesuffix(_TYPE)
        if controller != name and "." not in controller:
            yield controller


def _in_file(path: str) -> Iterator[str]:
    """Yield the controllers that a parameter file of a spawner is for."""
    for section in sections_in(path):
        name = section.pattern.rpartition("/")[2]
        if name == _NAME or "*" in name:
            yield from _typed(entry.name for entry in section.entries)
        else:
            yield name
