"""The report of a bug: what happened, where, with which versions. It holds no environment, which may hold secrets."""

from __future__ import annotations

import os
import platform
import sys
import tempfile
import time
import traceback
from importlib.metadata import version
from pathlib import Path

from orchestra.supervise.runs.directory import state_folder


def write_report(error: BaseException) -> Path:
    """Write the report below the state folder, or in the temporary folder where that is impossible; return its path."""
    name = f"{time.strftime('%Y-%m-%dT%H-%M-%S')}-{os.getpid()}.txt"
    text = _text(error)
    for folder in (state_folder() / "crash", Path(tempfile.gettempdir())):
        try:
            folder.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text, "utf-8")
        except OSError:
            continue
        return folder / name
    return Path(os.devnull)


def _text(error: BaseException) -> str:
    facts = {
        "orchestra": version("orchestra"),
        "python": sys.version,
        "platform": platform.platform(),
        "command": sys.argv,
        "folder": Path.cwd(),
    }
    lines = "".join(f"{name}: {value}\n" for name, value in facts.items())
    return f"{lines}\n{traceback_of(error)}"


def traceback_of(error: BaseException) -> str:
    """Return the traceback as the interpreter would print it."""
    return "".join(traceback.format_exception(error))
