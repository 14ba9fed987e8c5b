"""Launch files in Python as a text in a test."""

from __future__ import annotations

from types import ModuleType


def loaded(source: str) -> tuple[ModuleType, bytes]:
    """Return the module that a launch file with this text is, and its bytes, as it is looked at once it is loaded."""
    module = ModuleType("launch_file")
    module.__file__ = "file.launch.py"
    exec(compile(source, module.__file__, "exec"), vars(module))  # noqa: S102 - a launch file is code
    return module, source.encode()
