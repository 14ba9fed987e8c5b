"""What launch files import as `launch.logging`.

The loggers are a tree of their own, so that nothing of a launch file is left in Python's: `reset` forgets it all.
"""

from __future__ import annotations

import logging
import os

from orchestra.compat.launch.logging import handlers
from orchestra.compat.launch.logging.config import LaunchConfig
from orchestra.compat.launch.logging.outputs import get_output_loggers
from orchestra.compat.launch.logging.settings import launch_config
from orchestra.compat.launch.logging.tree import LaunchLogger, forget, named, root

__all__ = [
    "LaunchConfig",
    "LaunchLogger",
    "get_logger",
    "get_output_loggers",
    "handlers",
    "launch_config",
    "log_launch_config",
    "reset",
]


def get_logger(name: str | None = None) -> logging.Logger:
    """Return a logger that writes to the screen and to the log file, the root of all without a name."""
    logger = named(name)
    for handler in (
        launch_config.get_screen_handler(),
        launch_config.get_log_file_handler(launch_config.log_file_name),
    ):
        if handler not in logger.handlers:
            logger.addHandler(handler)
    return logger


def _get_logging_directory() -> str:
    """Return the folder that ROS 2 keeps its logs in; launch files import it to put those of theirs beside them."""
    home = os.environ.get("ROS_HOME") or "~/.ros"
    folder = os.environ.get("ROS_LOG_DIR") or os.path.join(home, "log")  # noqa: PTH118 - text in, text out
    return os.path.normpath(os.path.expanduser(folder))  # noqa: PTH111 - text in, text out


def log_launch_config(*, logger: logging.Logger = root) -> None:
    """Tell where log files are and from which level on messages are written."""
    if launch_config.file_handlers:
        logger.info("Log files are in %s", launch_config.log_dir)
    logger.info("Messages are written from the level %s on", logging.getLevelName(launch_config.level))


def reset() -> None:
    """Forget what was set and attached."""
    forget()
    launch_config.reset()
