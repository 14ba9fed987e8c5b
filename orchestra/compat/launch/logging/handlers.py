"""The handlers of Python's `logging` and `logging.handlers`, each with formatters for single loggers.

A name of these modules is made when somebody asks for it.
"""

from __future__ import annotations

import logging
import logging.handlers
from typing import Any


def with_per_logger_formatting(cls: type[logging.Handler]) -> Any:
    """Return a subclass of a handler with `setFormatterFor(logger, formatter)` and `unsetFormatterFor(logger)`."""

    class Formatting(cls):  # type: ignore[valid-type, misc]
        def __init__(self, *args: Any, **kwargs: Any) -> None:
            super().__init__(*args, **kwargs)
            self._formatters: dict[str, logging.Formatter] = {}

        def setFormatterFor(self, logger: logging.Logger | str, formatter: logging.Formatter) -> None:  # noqa: N802 - upstream's
            """Let a formatter write the records of one logger."""
            self._formatters[_name(logger)] = formatter

        def unsetFormatterFor(self, logger: logging.Logger | str) -> None:  # noqa: N802 - upstream's
            """Let the common formatter write the records of a logger again."""
            self._formatters.pop(_name(logger), None)

        def format(self, record: logging.LogRecord) -> str:
            formatter = self._formatters.get(record.name)
            return super().format(record) if formatter is None else formatter.format(record)

    Formatting.__name__ = Formatting.__qualname__ = cls.__name__
    Formatting.__doc__ = cls.__doc__
    return Formatting


def _name(logger: logging.Logger | str) -> str:
    return logger if isinstance(logger, str) else logger.name


def __getattr__(name: str) -> Any:
    for module in (logging, logging.handlers):
        found = getattr(module, name, None)
        if isinstance(found, type) and issubclass(found, logging.Handler):
            globals()[name] = with_per_logger_formatting(found)
            return globals()[name]
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
