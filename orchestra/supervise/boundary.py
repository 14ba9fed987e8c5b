"""The outermost function of the supervisor: what it returns is the exit status, whatever happens inside."""

from __future__ import annotations

import os
import sys
import time
from typing import TYPE_CHECKING

from orchestra.supervise.conduct import conduct
from orchestra.supervise.keeping.marks import folder_prefix
from orchestra.supervise.keeping.standard_streams import say
from orchestra.supervise.keeping.sweeping import reap, sweep
from orchestra.supervise.outcome import BUG
from orchestra.supervise.process import open_files
from orchestra.supervise.resolver.resolving import Refused
from orchestra.supervise.runs.directory import state_folder

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.supervise.beginnings import Beginnings


def guarded_run(beginnings: Beginnings) -> int:
    """Run and return the exit status. After a bug the keeper ends what is left, or we do where it was killed."""
    open_files.keep_to_ourselves()
    try:
        return conduct(beginnings)
    except Refused as refusal:
        if refusal.message:
            say(refusal.message)
            _remove_folders(beginnings.run_id)
        return refusal.status
    except Exception as error:  # noqa: BLE001 - whatever else comes here is a bug, and this is where it is shown
        say(
            f"this is a bug in Orchestra: {type(error).__name__}: {error}; please report it with {_report(error)}"
        )
        if os.getppid() != beginnings.keeper:
            sweep(_pause)
        return BUG


def _remove_folders(run_id: str) -> None:
    """Remove temporary folders that the resolver was killed before it could remove, or has kept for a run in vain."""
    # Here, because few runs are refused by anybody but the resolver.
    import shutil  # noqa: PLC0415
    import tempfile  # noqa: PLC0415
    from pathlib import Path  # noqa: PLC0415

    for folder in Path(tempfile.gettempdir()).glob(f"{folder_prefix(run_id)}*"):
        shutil.rmtree(folder, ignore_errors=True)


def _pause(seconds: float) -> bool:
    """Let some time pass and collect our children; nobody is in a hurry."""
    time.sleep(seconds)
    reap()
    return False


def _report(error: Exception) -> str:
    """Write what is known to a file and return its path; the text itself where no file can be written."""
    import traceback  # noqa: PLC0415 - only bugs need it

    text = f"python {sys.version}\ncommand {sys.argv}\n\n{''.join(traceback.format_exception(error))}"
    path: Path = state_folder() / "crash" / f"{time.strftime('%Y-%m-%dT%H-%M-%S')}-{os.getpid()}.txt"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")
    except OSError:
        return f"this:\n{text}"
    return f"the file {path}"
