"""What may be assigned to a field, where fields are checked (`check_fields`, `ROS_PYTHON_CHECK_FIELDS=1`).

The rules and the words are those of the classes that rosidl_generator_py makes, whose errors people know.
"""

from __future__ import annotations

import math
from array import array
from collections import UserList, UserString
from collections.abc import Callable, Sequence
from collections.abc import Set as AbstractSet
from typing import Any, Final

from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractNestedType,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

from orchestra.ros.interfaces.made.values import DTYPES, Kind, is_compact, python_type
from orchestra.ros.interfaces.slots import TYPE_CODES, class_of

Check = Callable[[Any], None]

_FLOATS: Final = {"float": 3.402823466e38, "double": 1.7976931348623157e308}


def check_of(name: str, kind: Kind) -> Check:
    """Return what raises `AssertionError` for a value that a field cannot hold."""
    if isinstance(kind, AbstractNestedType):
        return _collection(name, kind)
    if isinstance(kind, NamespacedType):
        return _message(name, kind)
    if isinstance(kind, AbstractGenericString):
        return _string(name, kind)
    return _basic(name, kind)


def taken_as_it_is(name: str, kind: Kind, value: Any) -> bool:  # noqa: ANN401 - whatever is assigned
    """Tell whether a value is an array of the very kind that the field holds; of another kind it is refused."""
    if not is_compact(kind):
        return False
    typename = kind.value_type.typename
    if isinstance(kind, Array):
        if type(value).__module__ != "numpy" or not hasattr(value, "dtype"):
            return False
        dtype = DTYPES.get(typename, typename)
        _require(value.dtype == dtype, f"The '{name}' numpy.ndarray() must have the dtype of 'numpy.{dtype}'")
        _require(value.size == kind.size, f"The '{name}' numpy.ndarray() must have a size of {kind.size}")
        return True
    if not isinstance(value, array):
        return False
    code = TYPE_CODES[typename]
    _require(value.typecode == code, f"The '{name}' array.array() must have the type code of '{code}'")
    if isinstance(kind, BoundedSequence):
        most = kind.maximum_size
        _require(len(value) <= most, f"The '{name}' array.array() must have a size <= {most}")
    return True


def _require(holds: bool, message: str) -> None:
    if not holds:
        raise AssertionError(message)


def _message(name: str, kind: NamespacedType) -> Check:
    def check(value: Any) -> None:  # noqa: ANN401 - as above
        _require(
            isinstance(value, class_of(kind)),
            f"The '{name}' field must be a sub message of type '{kind.name}'",
        )

    return check


def _string(name: str, kind: Any) -> Check:  # noqa: ANN401 - a type of rosidl_parser
    def check(value: Any) -> None:  # noqa: ANN401 - as above
        if not kind.has_maximum_size():
            _require(isinstance(value, str), f"The '{name}' field must be of type 'str'")
            return
        most = kind.maximum_size
        _require(
            isinstance(value, (str, UserString)) and len(value) <= most,
            f"The '{name}' field must be string value not longer than {most}",
        )

    return check


def _basic(name: str, kind: BasicType) -> Check:
    if kind.typename == "octet":
        return _octet(name)
    if kind.typename in ("char", "wchar"):
        return _character(name)
    type_, (fits, _, told) = python_type(kind), _range(kind.typename)

    def check(value: Any) -> None:  # noqa: ANN401 - as above
        _require(isinstance(value, type_), f"The '{name}' field must be of type '{type_.__name__}'")
        _require(fits(value), f"The '{name}' field must be {told}")

    return check


def _octet(name: str) -> Check:
    def check(value: Any) -> None:  # noqa: ANN401 - as above
        _require(
            isinstance(value, (bytes, bytearray)) and len(value) == 1,
            f"The '{name}' field must be of type 'bytes' or 'ByteString' with length 1",
        )

    return check


def _character(name: str) -> Check:
    def check(value: Any) -> None:  # noqa: ANN401 - as above
        _require(
            isinstance(value, (str, UserString)) and len(value) == 1 and ord(str(value)) < 128,  # noqa: PLR2004
            f"The '{name}' field must be of type 'str' or 'UserString' "
            "with length 1 and the character ord() in [-128, 127]",
        )

    return check


def _range(typename: str) -> tuple[Callable[[Any], bool], str, str]:
    """Return what tells whether a number is in the range of a type, and both wordings of it: of many and of one."""
    if (bound := _FLOATS.get(typename)) is not None:
        return (
            lambda value: not (value < -bound or value > bound) or math.isinf(value),
            f"and each {typename} in [{-bound:f}, {bound:f}]",
            f"a {typename} in [{-bound}, {bound}]",
        )
    if "int" not in typename:
        return lambda _: True, "", ""
    bits = int(typename.removeprefix("u").removeprefix("int"))
    low, high = (0, 2**bits) if typename.startswith("u") else (-(2 ** (bits - 1)), 2 ** (bits - 1))
    what = "unsigned integer" if low == 0 else "integer"
    return (
        lambda value: low <= value < high,
        f"and each {what} in [{low}, {high - 1}]",
        f"an {what} in [{low}, {high - 1}]",
    )


def _collection(name: str, kind: Any) -> Check:  # noqa: ANN401 - as above
    item = kind.value_type
    length, length_told = _length(kind)
    longest = (
        item.maximum_size if isinstance(item, AbstractGenericString) and item.has_maximum_size() else None
    )
    fits, range_told, _ = _range(item.typename) if isinstance(item, BasicType) else (lambda _: True, "", "")
    told = [
        "a set or sequence",
        length_told,
        f"and each string value not longer than {longest}" if longest is not None else "",
        f"and each value of type '{item.name if isinstance(item, NamespacedType) else python_type(item).__name__}'",
        range_told,
    ]
    message = f"The '{name}' field must be {' '.join(filter(None, told))}"

    def check(value: Any) -> None:  # noqa: ANN401 - as above
        _require(
            isinstance(value, (Sequence, AbstractSet, UserList)) and not isinstance(value, (str, UserString)),
            message,
        )
        type_ = class_of(item) if isinstance(item, NamespacedType) else python_type(item)
        _require(longest is None or all(len(each) <= longest for each in value), message)
        _require(length(len(value)), message)
        _require(all(isinstance(each, type_) for each in value) and all(map(fits, value)), message)

    return check


def _length(kind: Any) -> tuple[Callable[[int], bool], str]:  # noqa: ANN401 - as above
    if isinstance(kind, BoundedSequence):
        most = kind.maximum_size
        return (lambda length: length <= most), f"with length <= {most}"
    if isinstance(kind, Array):
        size = kind.size
        return (lambda length: length == size), f"with length {size}"
    return (lambda _: True), ""
