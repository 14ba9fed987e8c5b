"""A run that finds no place for its control socket: placeless.py DOCUMENT FOLDER."""

import sys
from pathlib import Path
from typing import BinaryIO

from orchestra.control import door
from orchestra.control.entrance import afterwards, attend
from orchestra.supervise.run import run


def prepare(stream: BinaryIO) -> int:
    stream.write(Path(sys.argv[1]).read_bytes())
    return 0


setattr(door, "folders", lambda: [sys.argv[2]])  # noqa: B010 - mypy
sys.exit(run(prepare, attend, afterwards))
