"""Launch descriptions of launch files in Python."""

from __future__ import annotations

from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from types import ModuleType

    from orchestra.compat.launch.launch_description import LaunchDescription

_MODULE: Final = "python_launch_file"
_FUNCTION: Final = "generate_launch_description"


class InvalidPythonLaunchFileError(Exception):
    """A Python file does not have what a launch file needs."""


def load_python_launch_file_as_module(python_launch_file_path: str) -> ModuleType:
    """Run a file, whatever its name, and return what is in it. Raises what the file raises."""
    loader = SourceFileLoader(_MODULE, python_launch_file_path)
    spec = spec_from_loader(_MODULE, loader)
    assert spec is not None  # noqa: S101 - there is a loader
    module = module_from_spec(spec)
    loader.exec_module(module)
    return module


def get_launch_description_from_python_launch_file(python_launch_file_path: str) -> LaunchDescription:
    """Return the description of a launch file. Raises `InvalidPythonLaunchFileError` without the usual function."""
    module = load_python_launch_file_as_module(python_launch_file_path)
    generate = getattr(module, _FUNCTION, None)
    if generate is None:
        raise InvalidPythonLaunchFileError(f"{python_launch_file_path} has no function {_FUNCTION}()")
    found: LaunchDescription = generate()
    return found
