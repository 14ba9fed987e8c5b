"""`component standalone`: a container for one component, as long as that runs."""

from __future__ import annotations

import os
import secrets
import signal
import subprocess
import sys
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Final

from orchestra.resolve.packages import InstalledPackages
from orchestra.resolve.packages.components import declared_components, target_of
from orchestra.ros.tools.components import asked_for, containers, loaded_into
from orchestra.ros.tools.graph.asking import Deadline
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.telling import tell
from orchestra.supervise.keeping import kernel

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator

_PACKAGE: Final = "rclcpp_components"
_EXECUTABLE: Final = "component_container"
# So long, in seconds, may a container take to end.
_PATIENCE: Final = 5.0


def run(options: Namespace) -> int:
    """Load a component into a container that is started for it, and return that one's exit status at its end."""
    name = options.container_node_name or f"standalone_container_{secrets.token_hex(6)}"
    deadline, request = Deadline(options.timeout), asked_for(options)
    with _started(options, name) as process:
        with joined(options) as graph:
            full = f"/{name.lstrip('/')}"
            graph.wait(lambda: full in containers(graph) or process.poll() is not None, deadline.left)
            answer = loaded_into(graph, full, request, deadline)
        node, uid = answer.full_node_name, answer.unique_id
        text = f"Loaded component {uid} into '{full}' container node as '{node}'\n"
        tell(options, text, {"container": full, "uid": uid, "name": node})
        return process.wait()


@contextmanager
def _started(options: Namespace, name: str) -> Iterator[subprocess.Popen[bytes]]:
    """Have a container, which ends with this process in any case."""
    command = [*_container_for(options), "--ros-args", "-r", f"__node:={name}"]
    ends_with_us = partial(kernel.die_with_parent, signal.SIGTERM, os.getpid())
    with subprocess.Popen(  # noqa: S603 - a program of ours
        command,
        stdout=sys.stdout,
        preexec_fn=ends_with_us,  # noqa: PLW1509 - no thread yet
    ) as process:
        try:
            yield process
        finally:
            _end(process)


def _container_for(options: Namespace) -> list[str]:
    """Return the words that start a container: that of rclcpp_components for components in C++, where it is here."""
    packages = InstalledPackages(os.environ)
    if target_of(options.package, options.plugin, declared_components()) is None:
        words = packages.executable(_PACKAGE, _EXECUTABLE)
        if words is not None:
            return [*words]
    return [sys.executable, "-m", "orchestra.ros.container", _EXECUTABLE]


def _end(process: subprocess.Popen[bytes]) -> None:
    """End a container that still runs."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        if process.poll() is not None:
            return
        process.send_signal(number)
        try:
            process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            continue
