"""`executable`: starts a program."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.fields import Text
from orchestra.description.running import Running


class Executable(Running):
    """Start any program."""

    cmd: Text = Field(
        description="The command line, split as a shell would; substituted values are not split."
    )
