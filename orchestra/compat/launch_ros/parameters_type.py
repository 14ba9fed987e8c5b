"""The types of parameters, for annotations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Union

from orchestra.compat.launch.some_substitutions_type import SomeSubstitutionsType
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue

ParameterDescription = Parameter
ParameterValueDescription = ParameterValue

SomeParameterFile = Union[SomeSubstitutionsType, PathLike[str], ParameterFile]  # noqa: UP007 - evaluated by users' own annotations
SomeParameterName = Sequence[Union[Substitution, str]]  # noqa: UP007
SomeParameterValue = Any
SomeParameterValue_types_tuple = (str, Substitution, list, tuple, int, float, bool)
SomeParametersDict = Mapping[Any, Any]
SomeParameters = Sequence[Union[SomeParameterFile, Parameter, Mapping[Any, Any]]]  # noqa: UP007

ParameterName = Sequence[Substitution]
ParametersDict = Mapping[ParameterName, Any]
Parameters = Sequence[Union[ParameterFile, Parameter, ParametersDict]]  # noqa: UP007

EvaluatedParameterValue = Any
EvaluatedParameters = Sequence[Union[Path, Parameter, Mapping[str, Any]]]  # noqa: UP007

__all__ = [
    "EvaluatedParameterValue",
    "EvaluatedParameters",
    "Parameter",
    "ParameterDescription",
    "ParameterFile",
    "ParameterName",
    "ParameterValue",
    "ParameterValueDescription",
    "Parameters",
    "ParametersDict",
    "SomeParameterFile",
    "SomeParameterName",
    "SomeParameterValue",
    "SomeParameterValue_types_tuple",
    "SomeParameters",
    "SomeParametersDict",
]
