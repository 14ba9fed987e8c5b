"""What files that change nothing leave in the process that looks at one after the other."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from orchestra.cli.checking import Manner, check
from orchestra.cli.targets import Target
from orchestra.pipeline import inputs_from
from orchestra.witness.harmless import changes_nothing

if TYPE_CHECKING:
    from pathlib import Path

_FILE = """\
import os
from launch import LaunchDescription
from launch.actions import LogInfo, OpaqueFunction, SetEnvironmentVariable

def late(context):
    return [LogInfo(msg=os.environ['SET_BY_ONE'])]

def generate_launch_description():
    if os.getenv('SET_BY_ONE'):
        raise ValueError('another file has set it')
    return LaunchDescription([SetEnvironmentVariable('SET_BY_ONE', 'x'), OpaqueFunction(function=late)])
"""


def test_what_a_harmless_file_sets_for_its_nodes_is_unset_for_the_next(tmp_path: Path) -> None:
    assert changes_nothing(compile(_FILE, "some.launch.py", "exec")) is (sys.version_info < (3, 14))
    targets = []
    for number in range(2):
        file = tmp_path / f"{number}.launch.py"
        file.write_text(_FILE, "utf-8")
        targets.append(Target(str(file), "launch"))
    found = check(targets, inputs_from((), environment={"PATH": "/bin"}), Manner(jobs=1))
    assert found.problems == ()
