"""Processes of a running test by name."""

from __future__ import annotations

from typing import Final

from orchestra.compat.launch_testing.running import belongs_to_running

NO_CMD_ARGS: Final = object()


class NoMatchingProcessException(Exception):
    """No process is called so."""


resolveProcesses = belongs_to_running("resolveProcesses")  # noqa: N816 - upstream's name
