"""`ParameterValue`, `Parameter` and `ParameterFile`: parameters with what there is to say about them."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.substitution_failure import SubstitutionFailure
from orchestra.compat.launch.utilities.type_utils import (
    normalize_typed_substitution,
    perform_typed_substitution,
)
from orchestra.compat.place import IN_CONSTRUCTOR, here
from orchestra.compat.refusing import Refusing
from orchestra.compat.text import known_as, normalized, shown
from orchestra.compat.wrong import WrongNumber, WrongType

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.text import Sub


class ParameterValue(Refusing):
    """A value. What comes from substitutions is converted to `value_type`, else read as YAML.

    Raises `TypeError` for a literal that is not of the type.
    """

    def __init__(self, value: Any, *, value_type: Any = None) -> None:
        self._place = here(self, IN_CONSTRUCTOR)
        if isinstance(value_type, str):
            told = f"value_type is a type, this is the text {value_type!r}"
            raise WrongNumber(told, path=("value_type",))
        self.__value = normalize_typed_substitution(value, value_type)
        self.__value_type = value_type
        self.__evaluated: Any = None

    @property
    def value(self) -> Any:
        """What it came to, before that what it is made of."""
        shown[0] += 1
        return self.__value if self.__evaluated is None else self.__evaluated

    @property
    def value_type(self) -> Any:
        """The type."""
        return self.__value_type

    @property
    def _written(self) -> Any:
        return self.__value

    def __str__(self) -> str:
        """Return value and type."""
        return (
            f"launch_ros.description.ParameterValue(value={self.value}, value_type={_named(self.value_type)})"
        )

    def evaluate(self, context: LaunchContext) -> Any:
        """Return what it comes to. Raises `ValueError` where that has not the type."""
        self.__evaluated = perform_typed_substitution(context, self.__value, self.__value_type)
        return self.__evaluated


class Parameter(Refusing):
    """A name and a value."""

    def __init__(self, name: Sub, value: Any, *, value_type: Any = None) -> None:
        self._place = here(self, IN_CONSTRUCTOR)
        self.__name = normalized(name)
        self.__parameter_value = ParameterValue(value, value_type=value_type)
        self.__evaluated_name: str | None = None

    @property
    def name(self) -> list[Substitution] | str:
        """What the name came to, before that what it is made of."""
        return self.__name if self.__evaluated_name is None else self.__evaluated_name

    @property
    def value(self) -> Any:
        """What the value came to, before that what it is made of."""
        return self.__parameter_value.value

    @property
    def value_type(self) -> Any:
        """The type of the value."""
        return self.__parameter_value.value_type

    @property
    def _written(self) -> tuple[list[Substitution], ParameterValue]:
        return self.__name, self.__parameter_value

    def __str__(self) -> str:
        """Return name, value and type."""
        kind = _named(self.value_type)
        return f"launch_ros.description.Parameter(name={self.name}, value={self.value}, value_type={kind})"

    def evaluate(self, context: LaunchContext) -> tuple[str, Any]:
        """Return name and value. Raises `ValueError` where the value has not the type."""
        name = "".join(context.perform_substitution(item) for item in self.__name)
        value = self.__parameter_value.evaluate(context)
        self.__evaluated_name = name
        return name, value


class ParameterFile(Refusing):
    """A parameter file, in which `$(...)` is evaluated with `allow_substs`."""

    def __init__(
        self, param_file: Sub | bytes | os.PathLike[str] | os.PathLike[bytes], *, allow_substs: bool = False
    ) -> None:
        self.__evaluated: Path | None = None
        self.__made: Path | None = None
        self._place = here(self, IN_CONSTRUCTOR)
        if not isinstance(param_file, str | Substitution | bytes | os.PathLike | Iterable):
            raise WrongType(f"a parameter file is a path, not {param_file!r}", path=("param_file",))
        if not isinstance(allow_substs, bool):
            raise WrongType(f"allow_substs is True or False, not {allow_substs!r}", path=("allow_substs",))
        self.__param_file = (
            param_file if isinstance(param_file, bytes | os.PathLike) else normalized(param_file)
        )
        self.__allow_substs = allow_substs

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        if len(arguments) != 1:
            return False
        if keywords and (len(keywords) > 1 or type(keywords.get("allow_substs")) is not bool):
            return False
        path = arguments[0]
        if type(path) is list and known_as(path) is not None:
            path = path.copy()
        elif type(path) is not str and not isinstance(path, Substitution):
            return False
        self._as_given = (path,), keywords
        return True

    @property
    def param_file(self) -> Any:
        """The path that it came to, before that what it is made of."""
        shown[0] += 1
        return self.__param_file if self.__evaluated is None else self.__evaluated

    @property
    def allow_substs(self) -> bool:
        """Whether `$(...)` in it is evaluated."""
        return self.__allow_substs

    @property
    def _written(self) -> Sub:
        if isinstance(self.__param_file, list):
            return self.__param_file
        return os.fsdecode(self.__param_file)

    def __str__(self) -> str:
        """Return path and whether it is evaluated."""
        return (
            f"launch_ros.description.ParameterFile(param_file={self.param_file}, "
            f"allow_substs={self.allow_substs})"
        )

    def evaluate(self, context: LaunchContext) -> Path:
        """Return the path; with `allow_substs` that of a temporary file with what the file comes to.

        Raises `SubstitutionFailure` where that is no YAML, `OSError` where the file cannot be read.
        """
        if self.__evaluated is None:
            path = self._path(context)
            if self.__allow_substs:
                path = self.__made = _evaluated(path, context)
            self.__evaluated = path
        return self.__evaluated

    def cleanup(self) -> None:
        """Remove the temporary file."""
        if self.__made is not None:
            self.__made.unlink(missing_ok=True)
            self.__made = self.__evaluated = None

    def _path(self, context: LaunchContext) -> Path:
        if isinstance(self.__param_file, list):
            return Path("".join(context.perform_substitution(item) for item in self.__param_file))
        return Path(os.fsdecode(self.__param_file))


def _evaluated(path: Path, context: LaunchContext) -> Path:
    """Write what a file comes to into a temporary file: the resolution removes those of user code, too."""
    import tempfile  # noqa: PLC0415 - only user code that evaluates a file by hand comes here

    import yaml  # noqa: PLC0415 - the same

    from orchestra.compat.launch.frontend.parse_substitution import parse_substitution  # noqa: PLC0415 - the same

    parts = parse_substitution(path.read_text("utf-8"))
    text = "".join(context.perform_substitution(item) for item in parts)
    try:
        yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise SubstitutionFailure(f"{path} is no YAML after its substitutions: {error}") from error
    with tempfile.NamedTemporaryFile("w", prefix="launch_params_", delete=False) as file:
        file.write(text)
    return Path(file.name)


def _named(kind: Any) -> str:
    return getattr(kind, "__name__", str(kind))
