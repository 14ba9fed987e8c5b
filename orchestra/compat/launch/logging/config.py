"""`launch.logging.launch_config`: where the messages of launch files go and how they are written."""

from __future__ import annotations

import logging
import os
import sys
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from orchestra.compat.launch.logging import handlers
from orchestra.compat.launch.logging.tree import root

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

Style: TypeAlias = Literal["%", "{", "$"]

_RUN = "${run}/logs"  # as everything in a plan that differs from run to run
_PLAIN = "[{levelname}] [{name}]: {message}"
_TIMED = "{created:.7f} " + _PLAIN
_ON_SCREEN = {"default": _PLAIN, "default_with_timestamp": _TIMED}
_IN_FILES = {"default": _TIMED}
_Screen: type[logging.StreamHandler[Any]] = handlers.with_per_logger_formatting(logging.StreamHandler)
_Nowhere: type[logging.Handler] = handlers.with_per_logger_formatting(logging.NullHandler)


class _ScreenHandler(_Screen):  # type: ignore[valid-type, misc]
    """Writes to standard error as it is at that moment: standard output carries the product of a command."""

    @property
    def stream(self) -> Any:
        return sys.stderr

    @stream.setter
    def stream(self, stream: object) -> None:
        del stream  # always the present one


class LaunchConfig:
    """The settings.

    The log folder is the run's, symbolic in a plan, and launch files write nothing there; where they set a folder of
    their own, their messages go to files in it, too.
    """

    def __init__(self) -> None:
        self.file_handlers: dict[str, logging.Handler] = {}
        self.reset()

    def reset(self) -> None:
        """Take up the settings that everybody begins with."""
        for handler in self.file_handlers.values():
            handler.close()
        self._log_dir: str | None = None
        self._factory: Callable[..., logging.Handler] | None = None
        self.log_file_name = "launch.log"
        self.file_handlers = {}
        self.screen_handler: Any = None
        self.screen_formatter: logging.Formatter | None = None
        self.file_formatter: logging.Formatter | None = None
        root.setLevel(logging.INFO)
        self.set_screen_format("default")
        self.set_log_format("default")

    @property
    def level(self) -> int:
        """The least level that is written."""
        return root.level

    @level.setter
    def level(self, level: int) -> None:
        root.setLevel(level)

    @property
    def given_log_dir(self) -> str | None:
        """The folder that a launch file has set, None: that of the run."""
        return self._log_dir

    @property
    def log_dir(self) -> str:
        """The folder of log files. Setting it raises `ValueError` for anything but a folder that is there, or None."""
        return self._log_dir or _RUN

    @log_dir.setter
    def log_dir(self, log_dir: str | os.PathLike[str] | None) -> None:
        if log_dir is not None and not os.path.isdir(log_dir):  # noqa: PTH112 - text in, text out
            raise ValueError(f"{os.fspath(log_dir)!r} is no folder")
        self._log_dir = None if log_dir is None else os.fspath(log_dir)

    @property
    def log_handler_factory(self) -> Callable[..., logging.Handler]:
        """What makes the handler of a file from its path and `encoding`."""
        factory: Callable[..., logging.Handler] = self._factory or _file_handler
        return factory

    @log_handler_factory.setter
    def log_handler_factory(self, factory: Callable[..., logging.Handler]) -> None:
        self._factory = factory

    def set_screen_format(self, screen_format: str | None, *, screen_style: Style | None = None) -> None:
        """Set how messages look on the screen: a format, `default` or `default_with_timestamp`.

        `OVERRIDE_LAUNCH_SCREEN_FORMAT` wins. Raises `ValueError` for a style beside a name.
        """
        self.screen_formatter = _formatter(
            screen_format, screen_style, _ON_SCREEN, "OVERRIDE_LAUNCH_SCREEN_FORMAT"
        )
        if self.screen_handler is not None:
            self.screen_handler.setFormatter(self.screen_formatter)

    def set_log_format(self, log_format: str | None, *, log_style: Style | None = None) -> None:
        """Set how messages look in files: a format or `default`.

        `OVERRIDE_LAUNCH_LOG_FORMAT` wins. Raises `ValueError` for a style beside a name.
        """
        self.file_formatter = _formatter(log_format, log_style, _IN_FILES, "OVERRIDE_LAUNCH_LOG_FORMAT")
        for handler in self.file_handlers.values():
            handler.setFormatter(self.file_formatter)

    def get_screen_handler(self) -> Any:
        """Return the handler that writes to the screen."""
        if self.screen_handler is None:
            self.screen_handler = _ScreenHandler()
            self.screen_handler.setFormatter(self.screen_formatter)
        return self.screen_handler

    def get_log_file_path(self, file_name: str = "launch.log") -> str:
        """Return the path of a log file."""
        return os.path.join(self.log_dir, file_name)  # noqa: PTH118 - text in, text out

    def get_log_file_handler(self, file_name: str = "launch.log") -> Any:
        """Return the handler of a log file, always the same one. Without a folder of the user's it writes nothing."""
        if file_name not in self.file_handlers:
            path = self.get_log_file_path(file_name)
            given = self._log_dir is not None
            handler = self.log_handler_factory(path, encoding="utf-8") if given else _Nowhere()
            handler.setFormatter(self.file_formatter)
            self.file_handlers[file_name] = handler
        return self.file_handlers[file_name]


def _file_handler(path: str, encoding: str) -> logging.Handler:
    """Return a handler that makes its file with the first message."""
    handler: logging.Handler = handlers.WatchedFileHandler(path, encoding=encoding, delay=True)
    return handler


def _formatter(
    written: str | None, style: Style | None, names: Mapping[str, str], variable: str
) -> logging.Formatter | None:
    override = os.environ.get(variable)
    if override:
        written, style = override.encode("latin1", "backslashreplace").decode("unicode_escape"), None
    if written is None:
        return None
    if written in names and style is not None:
        raise ValueError(f"the format '{written}' has a style of its own")
    return logging.Formatter(names.get(written, written), style=style or "{", validate=False)
