"""Loggers for what a process writes, by the words of `output`."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.logging.settings import launch_config
from orchestra.compat.launch.logging.tree import named

if TYPE_CHECKING:
    from collections.abc import Mapping

_SOURCES = ("stdout", "stderr", "both")
_PLACES = ("screen", "log", "own_log")
_WORDS: dict[str, dict[str, tuple[str, ...]]] = {
    "screen": {"both": ("screen",)},
    "log": {"both": ("log",), "stderr": ("screen",)},
    "both": {"both": ("screen", "log")},
    "own_log": {"both": ("own_log",), "stdout": ("own_log",), "stderr": ("own_log",)},
    "full": {"both": ("screen", "log", "own_log"), "stdout": ("own_log",), "stderr": ("own_log",)},
}


def get_output_loggers(
    process_name: str, output_config: str | Mapping[str, Any], main_log_file_name: str = "launch.log"
) -> tuple[logging.Logger, logging.Logger]:
    """Return the loggers of standard output and standard error of a process.

    `output_config` is `screen`, `log`, `both`, `own_log`, `full`, or a mapping from `stdout`, `stderr` and `both` to
    `screen`, `log` and `own_log`. Raises `ValueError` for any other word.
    """
    places = _places(output_config)
    for source in ("stdout", "stderr"):
        logger = named(f"{process_name}-{source}")
        wanted = places["both"] | places[source]
        if "screen" in wanted:
            _attach(logger, launch_config.get_screen_handler(), "{message}")
        if "log" in wanted:
            _attach(logger, launch_config.get_log_file_handler(main_log_file_name), "{created:.7f} {message}")
        if "own_log" in places[source]:
            _attach(logger, launch_config.get_log_file_handler(f"{logger.name}.log"), "{message}")
        if "own_log" in places["both"]:
            _attach(logger, launch_config.get_log_file_handler(f"{process_name}.log"), "{message}")
    return named(f"{process_name}-stdout"), named(f"{process_name}-stderr")


def _attach(logger: logging.Logger, handler: Any, form: str) -> None:
    if handler not in logger.handlers:
        handler.setFormatterFor(logger, logging.Formatter(form, style="{"))
        logger.addHandler(handler)


def _places(config: Any) -> dict[str, frozenset[str]]:
    if isinstance(config, str):
        if config not in _WORDS:
            raise ValueError(f"{config!r} is no output: use one of {', '.join(_WORDS)}, or a dict")
        config = _WORDS[config]
    if not isinstance(config, dict):
        raise ValueError(f"{config!r} is no output: use one of {', '.join(_WORDS)}, or a dict")  # noqa: TRY004 - as upstream
    found = {source: frozenset[str]() for source in _SOURCES}
    for source, given in config.items():
        found[_known(source, _SOURCES)] = frozenset(
            _known(place, _PLACES) for place in ([given] if isinstance(given, str) else given)
        )
    return found


def _known(word: str, words: tuple[str, ...]) -> str:
    if word not in words:
        raise ValueError(f"{word!r} is none of {', '.join(words)}")
    return word
