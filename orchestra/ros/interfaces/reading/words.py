"""The words of a line of a definition: types, names and values, by the rules of rosidl_adapter.

rosidl_adapter turns a definition into IDL, and rosidl_parser reads that. Here the same comes to be in one step: parsing
IDL takes a second, and every node would wait for it.
"""

from __future__ import annotations

import codecs
import keyword
import math
import re
import warnings
from typing import Any, Final

from rosidl_adapter import parser as adapter  # type: ignore[import-untyped]  # as every ROS package
from rosidl_parser import definition

Kind = Any  # a type of rosidl_parser, which has no type information

_BASIC: Final = {
    "bool": "boolean",
    "byte": "octet",
    "char": "uint8",
    "float32": "float",
    "float64": "double",
    **{f"{sign}int{bits}": f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)},
}
_STRINGS: Final = {
    "string": (definition.UnboundedString, definition.BoundedString),
    "wstring": (definition.UnboundedWString, definition.BoundedWString),
}
_GONE: Final = ("time", "duration")  # of ROS 1; rosidl has builtin_interfaces/Time and Duration
_NEEDS_SPACE: Final = re.compile(r"[<\[].*=.*")
# IDL table 7-9: what a backslash may begin in a string.
_ESCAPE: Final = re.compile(r"""\\(?:[ntvbrfa\\?'"]|[0-7]{1,3}|x[0-9a-fA-F]{1,2})""")


def type_of(text: str, package: str) -> Any:  # noqa: ANN401 - a class of rosidl_adapter
    """Return what a type is to rosidl_adapter. Raises `ValueError`, in the words of the user."""
    if text in _GONE:
        raise ValueError(
            f"'{text}' is a type of ROS 1; ROS 2 has builtin_interfaces/{text.capitalize()} for it"
        )
    if _NEEDS_SPACE.match(text) and "<=" not in text:
        raise ValueError(f"'{text}' is not a type")
    try:
        return adapter.Type(text, context_package_name=package)
    except (TypeError, IndexError) as error:  # one of its messages cannot be made
        raise ValueError(_wrong_type(text)) from error
    except adapter.InvalidSpecification as error:
        raise ValueError(f"'{text}' is not a type: neither a primitive nor [package/]Name") from error


def _wrong_type(text: str) -> str:
    if text.endswith("]") and "[" in text:
        return (
            f"the size of the array '{text}' is a whole number above 0, with '<=' before it if it is a bound"
        )
    if "<=" in text:
        return f"the bound of the string '{text}' is a whole number above 0"
    return f"'{text}' is not a type"


def kind_of(found: Any) -> Kind:  # noqa: ANN401 - as above
    """Return the type of rosidl_parser for one of rosidl_adapter."""
    item = _item_of(found)
    if not found.is_array:
        return item
    if found.is_fixed_size_array():
        return definition.Array(item, found.array_size)
    if found.is_upper_bound:
        return definition.BoundedSequence(item, found.array_size)
    return definition.UnboundedSequence(item)


def _item_of(found: Any) -> Kind:  # noqa: ANN401 - as above
    if not found.is_primitive_type():
        return definition.NamespacedType([found.pkg_name, "msg"], found.type)
    if found.type in _STRINGS:
        unbounded, bounded = _STRINGS[found.type]
        return bounded(found.string_upper_bound) if found.string_upper_bound else unbounded()
    return definition.BasicType(_BASIC[found.type])


def check_field_name(name: str) -> None:
    """Raise `ValueError` for what is no name of a field."""
    if not adapter.is_valid_field_name(name):
        raise ValueError(
            f"'{name}' is not the name of a field: lower case letters, digits and single underscores, "
            "a letter first and no underscore last"
        )
    if keyword.iskeyword(name):
        raise ValueError(f"'{name}' is a word of Python, which no field can be called")


def check_constant_name(name: str) -> None:
    """Raise `ValueError` for what is no name of a constant."""
    if not adapter.is_valid_constant_name(name):
        raise ValueError(
            f"'{name}' is not the name of a constant: upper case letters, digits and single underscores, "
            "a letter first and no underscore last"
        )


def default(found: Any, text: str) -> Any:  # noqa: ANN401 - as above; a value of any type
    """Return the default value of a field as rosidl_parser has it: of an array it is the text of a tuple.

    Raises `ValueError`, in the words of the user.
    """
    if not found.is_primitive_type():
        raise ValueError(f"a field of type '{found}' has no default value")
    value = _value(adapter.parse_value_string, found, text)
    if not found.is_array:
        return _as_in_idl(value)
    if not all(_is_finite(item) for item in value):
        raise ValueError("a default value is a finite number")
    return repr(tuple(value))


def constant(text_of_type: str, text: str) -> Any:  # noqa: ANN401 - a value of any type
    """Return the value of a constant as rosidl_parser has it. Raises `ValueError`, in the words of the user."""
    value = _value(adapter.parse_primitive_value_string, adapter.Type(text_of_type), text)
    return _as_in_idl(value)


def constant_kind(text: str, value: Any) -> Kind:  # noqa: ANN401 - as above
    """Return the type of a constant, which is bounded by its own value if it is a text."""
    if text in _STRINGS:
        return _STRINGS[text][1](len(value))
    return definition.BasicType(_BASIC[text])


def is_basic(text: str) -> bool:
    """Tell whether a constant can have this type."""
    return text in _BASIC or text in _STRINGS


def _value(parse: Any, found: Any, text: str) -> Any:  # noqa: ANN401 - as above
    try:
        return parse(found, text)
    except adapter.InvalidValue as error:
        raise ValueError(str(error)) from error


def _as_in_idl(value: Any) -> Any:  # noqa: ANN401 - as above
    if not _is_finite(value):
        raise ValueError("a value is a finite number")
    return _read_back(value) if isinstance(value, str) and "\\" in value else value


def _is_finite(value: Any) -> bool:  # noqa: ANN401 - as above
    return not isinstance(value, float) or math.isfinite(value)


def _read_back(text: str) -> str:
    r"""Return a text with backslashes after its way through IDL, which reads escape sequences twice (`\\\\` is one)."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # an escape sequence that Python does not know
        first = text.encode().decode("unicode_escape")
    try:
        written = first.replace('"', r"\"").encode("iso-8859-1").decode()
    except UnicodeError as error:
        raise ValueError(f"the escape sequences in {text!r} make no text") from error
    read = _ESCAPE.sub(lambda found: codecs.decode(found[0], "unicode-escape"), written)
    return re.sub(r"\\([\"\\])", r"\1", read)
