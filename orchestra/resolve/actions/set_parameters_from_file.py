"""`set_parameters_from_file`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.parameter_files import file_parameters

if TYPE_CHECKING:
    from orchestra.description.actions.set_parameters_from_file import SetParametersFromFile
    from orchestra.resolve.resolution import Resolution


def visit(action: SetParametersFromFile, run: Resolution) -> None:
    """Give a parameter file to every node that follows."""
    file = file_parameters(action.filename, run, everywhere=True)
    if file is not None:
        run.scope.parameters = (*run.scope.parameters, file)
