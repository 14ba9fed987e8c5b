"""Loggers of their own: what launch files do to them is not seen by the rest of the process."""

from __future__ import annotations

import logging

_PLAIN = logging.INFO


class LaunchLogger(logging.Logger):
    """A logger that hands nothing on to the one above."""

    def __init__(self, name: str, level: int = logging.NOTSET) -> None:
        super().__init__(name, level)
        self.propagate = False


root = logging.RootLogger(_PLAIN)
_manager = logging.Manager(root)
_manager.loggerClass = LaunchLogger
root.manager = _manager


def named(name: str | None) -> logging.Logger:
    """Return the logger of a name, the root of all without one."""
    return _manager.getLogger(name) if name else root


def forget() -> None:
    """Take the handlers and levels from all loggers."""
    for logger in (root, *_manager.loggerDict.values()):
        if isinstance(logger, logging.Logger):
            logger.handlers.clear()
            logger.setLevel(_PLAIN if logger is root else logging.NOTSET)
