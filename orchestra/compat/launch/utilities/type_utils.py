"""Values that may be substitutions, and the types that they must come to.

The types are `int`, `float`, `bool`, `str`, `List` of one of these, or None: whatever the text reads as in YAML 1.1.
`can_be_str` lets texts pass that cannot be read as the type, as the front ends need.
Source: `launch.utilities.type_utils` of Jazzy, measured; section 2.6 of the launch language.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Sized
from typing import TYPE_CHECKING, Any, List, Union, get_args, get_origin  # noqa: UP035 - users hand `List[int]` in

from orchestra.compat.launch.some_substitutions_type import SomeSubstitutionsType
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.utilities.ensure_argument_type_impl import ensure_argument_type
from orchestra.compat.launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from orchestra.compat.launch.utilities.perform_substitutions_impl import perform_substitutions

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext

# The names below are evaluated by users' own annotations, so they are spelled as upstream's.
# ruff: noqa: UP006, UP007
ScalarTypesTuple = (int, float, bool, str)
ListTypesTuple = (List[int], List[float], List[bool], List[str])
AllowedTypesTuple = ScalarTypesTuple + ListTypesTuple
ScalarTypesType = type[Union[int, float, bool, str]]
ListTypesType = type[Union[List[int], List[float], List[bool], List[str]]]
AllowedTypesType = Union[ScalarTypesType, ListTypesType]
ScalarValueType = Union[int, float, bool, str]
ListValueType = Union[List[int], List[float], List[bool], List[str]]
SequenceValueType = Union[Sequence[int], Sequence[float], Sequence[bool], Sequence[str]]
AllowedValueType = Union[ScalarValueType, SequenceValueType]
SomeScalarType = Union[SomeSubstitutionsType, ScalarValueType]
SomeSequenceType = Union[
    Sequence[Union[int, SomeSubstitutionsType]],
    Sequence[Union[float, SomeSubstitutionsType]],
    Sequence[Union[bool, SomeSubstitutionsType]],
    Sequence[Union[str, SomeSubstitutionsType]],
]
SomeValueType = Union[SomeScalarType, SomeSequenceType]
NormalizedScalarType = Union[List[Substitution], ScalarValueType]
NormalizedSequenceType = Union[
    List[Union[int, List[Substitution]]],
    List[Union[float, List[Substitution]]],
    List[Union[bool, List[Substitution]]],
    List[Union[str, List[Substitution]]],
]
NormalizedValueType = Union[NormalizedScalarType, NormalizedSequenceType]
StrSomeScalarType = SomeScalarType
StrSomeSequenceType = Union[
    Sequence[Union[int, str]], Sequence[Union[float, str]], Sequence[Union[bool, str]], Sequence[str]
]
StrSomeValueType = Union[StrSomeScalarType, StrSomeSequenceType]

_TRUTH = {"1": True, "0": False}


def is_typing_list(data_type: Any) -> bool:
    """Return whether a type is `List` or `List` of something."""
    return data_type is List or get_origin(data_type) is list


def is_valid_scalar_type(data_type: Any) -> bool:
    """Return whether a type is that of a scalar."""
    return data_type in ScalarTypesTuple


def extract_type(data_type: Any) -> tuple[Any, bool]:
    """Return the type of the scalar or of the items, and whether it is a list. Raises `ValueError` for any other."""
    is_list = is_typing_list(data_type)
    kind = next(iter(get_args(data_type)), None) if is_list else data_type
    if not is_valid_scalar_type(kind):
        raise ValueError(f"{data_type!r} is no type of a value: use int, float, bool, str or a List of one")
    return kind, is_list


def is_instance_of_valid_type(value: Any, can_be_str: bool = False) -> bool:
    """Return whether a value is a scalar, or a list of scalars of one type."""
    if not isinstance(value, list):
        return isinstance(value, ScalarTypesTuple)
    kinds = {type(item) for item in value}
    if can_be_str and len(kinds) > 1:
        kinds.discard(str)
    return len(kinds) < 2 and all(kind in ScalarTypesTuple for kind in kinds)  # noqa: PLR2004 - one type


def is_instance_of(value: Any, data_type: Any = None, can_be_str: bool = False) -> bool:
    """Return whether a value is of a type. Raises `ValueError` for what is no type."""
    if data_type is None:
        return is_instance_of_valid_type(value, can_be_str)
    kind, is_list = extract_type(data_type)
    kinds = (str, kind) if can_be_str else (kind,)
    if is_list:
        return isinstance(value, list) and all(isinstance(item, kinds) for item in value)
    return isinstance(value, kinds)


def coerce_to_type(value: str, data_type: Any = None, can_be_str: bool = False) -> Any:
    """Return what a text means as a type. Raises `ValueError` where it cannot, `TypeError` for anything but a text."""
    ensure_argument_type(value, str, "value", "coerce_to_type")
    if data_type is None:
        return _read(value, can_be_str) if value else value
    kind, is_list = extract_type(data_type)
    if kind is str and not is_list:
        return value
    try:
        return _list_of(value, kind, can_be_str) if is_list else _scalar_of(value, kind)
    except ValueError:
        if can_be_str and not is_list:
            return value
        raise


def coerce_list(value: list[str], data_type: Any = None, can_be_str: bool = False) -> Any:
    """Return what several texts mean; they must come to one type. Raises as `coerce_to_type` does."""
    ensure_argument_type(value, list, "value", "coerce_list")
    found = [coerce_to_type(item, data_type, can_be_str) for item in value]
    if not is_instance_of_valid_type(found, can_be_str):
        raise ValueError(f"{value!r} has items of several types")
    return found


def get_typed_value(value: str | list[str], data_type: Any, can_be_str: bool = False) -> Any:
    """Return what a text or a list of texts means as a type. Raises as `coerce_to_type` does."""
    if not isinstance(value, list):
        return coerce_to_type(value, data_type, can_be_str)
    kind, is_list = (None, True) if data_type is None else extract_type(data_type)
    if not is_list:
        raise TypeError(f"the list {value!r} cannot become {data_type.__name__}")
    return coerce_list(value, kind, can_be_str)


def is_substitution(x: Any) -> bool:
    """Return whether a value is a substitution, or texts and substitutions with at least one of these."""
    if isinstance(x, Substitution):
        return True
    if isinstance(x, str) or not (isinstance(x, Iterable) and isinstance(x, Sized)):
        return False
    return any(isinstance(item, Substitution) for item in x) and all(
        isinstance(item, str | Substitution) for item in x
    )


def is_normalized_substitution(x: Any) -> bool:
    """Return whether a value is a list of substitutions, with at least one."""
    return isinstance(x, list) and bool(x) and all(isinstance(item, Substitution) for item in x)


def normalize_typed_substitution(value: Any, data_type: Any) -> Any:
    """Return a value, a list of substitutions, or a list of both that can come to a type.

    Integers are welcome where floats are wanted. Raises `TypeError` for what cannot come to the type, `ValueError`
    for what is no type.
    """
    if isinstance(value, ScalarTypesTuple):
        if data_type is float and type(value) is int:
            return float(value)
        if not is_instance_of(value, data_type):
            raise TypeError(f"{value!r} is not of the type {_named(data_type)}")
        return value
    if is_substitution(value):
        return normalize_to_list_of_substitutions(value)
    if not isinstance(value, Iterable):
        raise TypeError(f"expected a value, a substitution or a list of both, found {value!r}")
    wanted, is_list = (None, True) if data_type is None else extract_type(data_type)
    if not is_list:
        raise TypeError(f"the list {value!r} cannot become {_named(data_type)}")
    return _normalized_items(list(value), wanted)


def perform_typed_substitution(context: LaunchContext, value: Any, data_type: Any) -> Any:
    """Return what a value from `normalize_typed_substitution` comes to.

    Raises `TypeError` for a scalar of another type, `ValueError` for a text that cannot be read as the type.
    """
    if isinstance(value, ScalarTypesTuple):
        if not is_instance_of(value, data_type):
            raise TypeError(f"{value!r} is not of the type {_named(data_type)}")
        return value
    if is_normalized_substitution(value):
        return coerce_to_type(perform_substitutions(context, value), data_type)
    if not isinstance(value, list):
        raise TypeError(f"expected a value, a list of substitutions or a list of both, found {value!r}")
    kind, is_list = (None, True) if data_type is None else extract_type(data_type)
    if not is_list:
        raise ValueError(f"the list {value!r} cannot become {_named(data_type)}")
    found = [_performed(context, item, kind) for item in value]
    if not is_instance_of(found, data_type):
        raise ValueError(f"{found!r} is not of the type {_named(data_type)}")
    return found


def _performed(context: LaunchContext, item: Any, kind: Any) -> Any:
    return coerce_to_type(perform_substitutions(context, item), kind) if is_substitution(item) else item


def _normalized_items(items: list[Any], wanted: Any) -> list[Any]:
    values = [item for item in items if not is_substitution(item)]
    kinds = {_kind_of(item) for item in values}
    kind = (
        float if kinds == {int, float} or (kinds == {int} and wanted is float) else next(iter(kinds), wanted)
    )
    if len(kinds - {int, float}) + bool(kinds & {int, float}) > 1 or (
        wanted is not None and kind is not wanted
    ):
        raise TypeError(f"{items!r} is not of the type {_named(wanted)}, or has items of several types")
    return [
        normalize_to_list_of_substitutions(item)
        if is_substitution(item)
        else float(item)
        if kind is float
        else item
        for item in items
    ]


def _kind_of(item: Any) -> type:
    for kind in (bool, int, float, str):
        if isinstance(item, kind):
            return kind
    raise TypeError(f"a list holds values and substitutions, not {item!r}")


def _scalar_of(text: str, kind: Any) -> Any:
    if kind is not bool:
        return kind(text)
    found = _TRUTH.get(text.strip())
    found = _loaded(text) if found is None else found
    if not isinstance(found, bool):
        raise ValueError(f"'{text}' is no boolean")  # noqa: TRY004 - the text is wrong, not the call
    return found


def _list_of(text: str, kind: Any, can_be_str: bool) -> Any:
    found = _loaded(text)
    if not is_instance_of(found, List[kind], can_be_str):
        raise ValueError(f"'{text}' is no list of {kind.__name__}")
    return found


def _read(text: str, can_be_str: bool) -> Any:
    try:
        found = _loaded(text)
    except ValueError:
        if can_be_str:
            return text
        raise
    if not is_instance_of_valid_type(found, can_be_str):
        raise ValueError(f"'{text}' means neither a value nor a list of values of one type")
    return found


def _loaded(text: str) -> Any:
    import yaml  # noqa: PLC0415 - most launch files never come here

    try:
        return yaml.safe_load(text)
    except yaml.YAMLError as error:
        reason = getattr(error, "problem", None) or str(error).partition("\n")[0]
        raise ValueError(f"'{text}' is not YAML: {reason}") from None


def _named(data_type: Any) -> str:
    return "any value" if data_type is None else getattr(data_type, "__name__", str(data_type))
