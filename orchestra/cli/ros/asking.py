"""Becomes the process that answers: the one with rclpy, in the environment that nodes get."""

from __future__ import annotations

import json
import os
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Final, NoReturn

from orchestra.supervise.environment import common_environment
from orchestra.supervise.host import this_host

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.ros.verbs import Verb

# By its file and with `-P`: with `-m`, modules in the user's working directory would come before all others.
_PROGRAM: Final = str(Path(__file__).parents[2] / "ros" / "tools" / "__main__.py")


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
    words = [sys.executable, "-P", _PROGRAM, json.dumps(question)]
    os.execve(sys.executable, words, environment)  # noqa: S606 - a program of ours
