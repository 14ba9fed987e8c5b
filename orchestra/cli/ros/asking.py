"""Becomes the process that answers: the one with rclpy, in the environment that nodes get.

All of that environment can be had where this process is, but for the folders of shared libraries, which are read when
a program starts. The start script of a virtual environment with the wheels of ROS has them already, and then nothing is
started a second time: 60 ms of CPU.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NoReturn

from orchestra.supervise.environment import common_environment
from orchestra.supervise.host import this_host
from orchestra.wheels import LIBRARY_PATH

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable, Mapping

    from orchestra.cli.ros.verbs import Verb

# By its file and with `-P`: with `-m`, modules in the user's working directory would come before all others.
_SOURCES: Final = Path(__file__).parents[3]
_PROGRAM: Final = str(_SOURCES / "orchestra" / "ros" / "tools" / "__main__.py")
# By its name: no module of this room imports what imports rclpy.
_ANSWERING: Final = "orchestra.ros.tools.answering"


def answered(command: str, verb: Verb, options: Namespace) -> NoReturn:
    """Answer with the tool of a verb."""
    become(f"{command} {options.verb}", verb.tool, options)


def become(command: str, tool: str, options: Namespace) -> NoReturn:
    """Go on as the process of a tool, `module:function`, with the streams and the number of this one."""
    question = {"command": command, "tool": tool, "options": vars(options)}
    sys.stdout.flush()
    # The wheels would start an interpreter without this environment a second time.
    environment = common_environment(
        dict(os.environ), this_host(), log_folder=tempfile.gettempdir(), colour=False, inherit=True
    )
    if _folders(environment) == _folders(os.environ):
        _answer_here(question, environment)
    words = [sys.executable, "-P", _PROGRAM, json.dumps(question)]
    os.execve(sys.executable, words, environment)  # noqa: S606 - a program of ours


def _folders(environment: Mapping[str, str]) -> set[str]:
    """Return where an environment has shared libraries looked for."""
    return set(filter(None, environment.get(LIBRARY_PATH, "").split(":")))


def _answer_here(question: dict[str, Any], environment: Mapping[str, str]) -> NoReturn:
    """Make this process what the other would be, as far as it matters to a tool."""
    import faulthandler  # noqa: PLC0415 - only here

    for name in os.environ.keys() - environment.keys():
        del os.environ[name]
    os.environ.update(environment)
    faulthandler.enable()  # as PYTHONFAULTHANDLER has it
    if not sys.flags.safe_path:
        del sys.path[0]  # the working directory, or that of the start script
    sys.path.append(str(_SOURCES))
    answer: Callable[[dict[str, Any]], NoReturn] = import_module(_ANSWERING).answer
    answer(question)
