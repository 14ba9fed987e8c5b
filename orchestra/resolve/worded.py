"""The words that a program is started with, and what can be told of them before it is."""

from __future__ import annotations

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
    said = [word.text for word in words]
    if for_ros is not None and "--log-level" in said:
        # Here, because few nodes have one.
        from orchestra.resolve.log_levels import check_levels  # noqa: PLC0415

        check_levels(words, run.problems, for_ros=for_ros)
    if for_ros is not None and words:
        from orchestra.resolve.ros_rules import check_rules  # noqa: PLC0415 - as above

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
    return tuple(said) or (() if isinstance(argv, tuple) else ("",))


def look_at_paths(words: Sequence[Value], run: Resolution, *, for_ros: bool | None = None) -> None:
    """Report files among words that are not there, as far as that can be told."""
    if any(["/" in word.text and "." in word.text for word in words]):  # noqa: C419 - quicker for few
        from orchestra.resolve.argument_files import check_files  # noqa: PLC0415 - few words are paths

        check_files(words, run, for_ros=for_ros)
