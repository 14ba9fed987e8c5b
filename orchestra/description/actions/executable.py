"""`executable`: starts a program."""

from __future__ import annotations

from orchestra.description.fields import Argv
from orchestra.description.model import field
from orchestra.description.running import Running


class Executable(Running):
    """Start any program."""

    cmd: Argv = field(
        description="The command line, split as a shell would; substituted values are not split."
    )
