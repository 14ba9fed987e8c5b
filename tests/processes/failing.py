"""Runs a launcher whose supervisor has a bug: `failing.py PYTHON LAUNCHER WORD...`; it fails when it is to stop."""

import runpy
import sys
from typing import NoReturn

from orchestra.supervise.system import System


def fail(_system: System, number: int) -> NoReturn:
    raise RuntimeError(f"a bug of the supervisor, at signal {number}")


System.stop_signal = fail  # type: ignore[assignment,method-assign]
sys.argv = sys.argv[2:]
runpy.run_path(sys.argv[0], run_name="__main__")
