"""The words that a program is started with, and what can be told of them before it is."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Final

from orchestra.resolve.context import POISON, Poison
from orchestra.resolve.words import split

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.text import Template
    from orchestra.resolve.context import Value
    from orchestra.resolve.model import FileParameters, ResolvedRemap
    from orchestra.resolve.resolution import Resolution

_SPAWNING: Final = "controller_manager"
ARGUED: Final = frozenset({_SPAWNING, "tf2_ros"})  # packages with programs whose arguments are known
_OF_ROS: Final = (":=", "ros", "--params-file")  # what holds none of these is not for ROS, nor meant to be
_SETTING: Final = frozenset({"-p", "--param", "--params-file", "-r", "--remap"})


def texts(
    argv: Template | tuple[Template, ...] | None,
    run: Resolution,
    *,
    for_ros: bool | None = None,
    given: list[FileParameters | ResolvedRemap] | None = None,
    started_by: tuple[str, str] | None = None,
) -> tuple[str, ...] | Poison:
    """Return words: a text is split as a shell would, an item of a list is one word.

    A text that is empty, or blank, is one empty word (launch, `ExecuteProcess._parse_cmdline`). Of a node, `for_ros`
    tells whether all words are for rcl, or those behind `--ros-args` only; what they set becomes `given`. They are for
    the executable of a package of `ARGUED` that it is `started_by`.
    """
    if argv is None:
        return ()
    words = split(argv, run.context)
    if isinstance(words, Poison):
        return POISON
    said = tuple([word.text for word in words])
    if for_ros is not None and words and not _are_sound(said, for_ros):
        # Here, because most words are as they should be.
        from orchestra.resolve.log_levels import check_levels  # noqa: PLC0415
        from orchestra.resolve.ros_rules import check_rules  # noqa: PLC0415

        check_levels(words, run.problems, for_ros=for_ros)
        check_rules(words, run.problems, for_ros=for_ros)
    if started_by is not None:
        from orchestra.resolve.known_arguments import check_arguments  # noqa: PLC0415 - as above

        check_arguments(*started_by, words, run.problems)
        if started_by[0] == _SPAWNING and started_by[1].endswith("spawner"):
            run.found.spawned.append(words)
    if for_ros is not None:
        look_at_paths(words, run, for_ros=for_ros)
    if given is not None and not _SETTING.isdisjoint(said):
        from orchestra.resolve.parameter_arguments import settings_among  # noqa: PLC0415 - as above

        given += settings_among(words, run, for_ros=for_ros is True)
    return said or (() if isinstance(argv, tuple) else ("",))


@lru_cache(maxsize=512)  # many nodes are given the same
def _are_sound(said: tuple[str, ...], for_ros: bool) -> bool:
    """Return whether nothing can be told of words: none holds a blank, and ROS knows all that are for it."""
    whole = " ".join(said)
    if whole.split() != [*said]:
        return False
    if not for_ros and not any(sign in whole for sign in _OF_ROS):
        return True
    # Here, because few nodes are given words for ROS.
    from orchestra.resolve.ros_rules import are_known  # noqa: PLC0415

    return are_known(said, for_ros=for_ros)


def look_at_paths(words: Sequence[Value], run: Resolution, *, for_ros: bool | None = None) -> None:
    """Report files among words that are not there, as far as that can be told."""
    if any(["/" in word.text and "." in word.text for word in words]):  # noqa: C419 - quicker for few
        from orchestra.resolve.argument_files import check_files  # noqa: PLC0415 - few words are paths

        check_files(words, run, for_ros=for_ros)
