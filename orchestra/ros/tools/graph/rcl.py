"""rclpy's extension module, without what the package around it imports: that takes as long again (50 ms of CPU).

Whoever asks for what is in the package, or imports it in the common way, gets it whole.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any, Final

from orchestra.ros.tools.postponing import postpone_module

_PACKAGE: Final = "rclpy"

postpone_module(_PACKAGE)
rcl: Final[Any] = import_module(f"{_PACKAGE}._rclpy_pybind11")
