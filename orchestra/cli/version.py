"""The version of what is installed, from the name of the folder with its metadata.

`importlib.metadata` reads it from a file in there, and takes as long to be imported as the interpreter to start.
"""

from __future__ import annotations

import os
import sys
from typing import Final

_NAME: Final = "orchestra"
_BEGIN, _END = f"{_NAME}-", ".dist-info"  # packaging.python.org, "Recording installed projects"


def version() -> str:
    """Return the version of the first that is found on the import path."""
    for folder in sys.path:
        try:
            names = os.listdir(folder or ".")  # noqa: PTH208 - pathlib is slow
        except OSError:  # an archive, or no such folder
            continue
        for name in names:
            if name.startswith(_BEGIN) and name.endswith(_END):
                return name[len(_BEGIN) : -len(_END)]
    from importlib import metadata  # noqa: PLC0415 - slow: see above

    return metadata.version(_NAME)
