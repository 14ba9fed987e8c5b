"""The types of the wheels, made a second time of their definitions, are what the compiled ones are."""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from random import Random
from typing import Any

import pytest
from rclpy.serialization import deserialize_message, serialize_message

from orchestra.ros.interfaces import cdr, conversion, description, layouts
from orchestra.ros.interfaces.slots import fields_of
from tests.ros.interfaces.wheels import Pair, filled, messages, pairs

_HANDLES = {"msg": layouts.Handle, "srv": layouts.ServiceHandle}


def _told(kind: Any, of: str) -> tuple[bytes, Any, list[Any]]:
    """Return the hash, the description and the sources that the graph tells of a type."""
    if type(kind)._TYPE_SUPPORT is None:
        type(kind).__import_type_support__()
    handle: Any = _HANDLES[of].from_address(conversion.address_in(type(kind)._TYPE_SUPPORT))
    call = ctypes.PYFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p)
    own = ctypes.addressof(handle)
    described = layouts.TypeDescription.from_address(call(handle.get_type_description_func)(own))
    referenced = description.items(described.referenced_type_descriptions, layouts.IndividualType)
    sources = layouts.String.from_address(call(handle.get_type_description_sources_func)(own))
    return (
        ctypes.string_at(call(handle.get_type_hash_func)(own), 33),
        [_fields(item) for item in (described.type_description, *referenced)],
        [_source(item) for item in description.items(sources, layouts.TypeSource)],
    )


def _fields(item: layouts.IndividualType) -> Any:
    text = description.string
    return text(item.type_name), [
        (
            text(field.name),
            (field.type.type_id, field.type.capacity, field.type.string_capacity),
            text(field.type.nested_type_name),
            text(field.default_value),
        )
        for field in description.items(item.fields, layouts.Field)
    ]


def _source(item: layouts.TypeSource) -> tuple[str, str, str]:
    name, encoding, text = map(description.string, (item.type_name, item.encoding, item.raw_file_contents))
    # The compiled ones have a NUL where a definition ends its last line.
    return name, encoding, text.rstrip("\0\n")


def test_hash_description_and_sources_are_those_of_the_graph() -> None:
    assert len(pairs()) > 250
    assert [
        pair.name for pair in pairs() if _told(pair.made, pair.kind) != _told(pair.compiled, pair.kind)
    ] == []


def test_the_classes_have_the_same_members() -> None:
    for pair in messages():
        assert pair.made.get_fields_and_field_types() == pair.compiled.get_fields_and_field_types(), pair.name
        assert pair.made.SLOT_TYPES == pair.compiled.SLOT_TYPES, pair.name
        assert pair.made.__slots__ == pair.compiled.__slots__, pair.name
        # Of a class whose messages have been copied, and of one that a class statement has made, from 3.13 on.
        extra = {"__slotnames__", "__firstlineno__", "__static_attributes__"}
        assert set(dir(pair.made)) ^ set(dir(pair.compiled)) <= extra, pair.name
        constants = [name for name in dir(pair.compiled) if name.isupper() and name != "SLOT_TYPES"]
        for name in constants:
            assert repr(getattr(pair.made, name)) == repr(getattr(pair.compiled, name)), pair.name
            with pytest.raises(AttributeError):
                setattr(pair.made, name, 5)


def test_messages_are_written_and_compared_alike() -> None:
    random = Random(1)  # noqa: S311 - the same values each time
    for pair in messages():
        made, compiled = _both(pair, random)
        assert repr(made) == repr(compiled), pair.name
        assert repr(pair.made()) == repr(pair.compiled()), pair.name
        assert made == pair.made(**{name: getattr(made, name) for name, _ in fields_of(pair.made)}), pair.name
        assert made != compiled, pair.name


def test_what_either_sends_the_other_reads() -> None:
    random = Random(2)  # noqa: S311 - as above
    for pair in messages():
        for _ in range(2):
            made, compiled = _both(pair, random)
            assert repr(deserialize_message(cdr.encode(made), pair.compiled)) == repr(compiled), pair.name
            assert repr(cdr.decode(serialize_message(compiled), pair.made)) == repr(made), pair.name


def _both(pair: Pair, random: Random) -> tuple[Any, Any]:
    compiled = filled(pair.compiled, random)
    fields = {name: getattr(compiled, name) for name, _ in fields_of(pair.compiled)}
    if any(
        "_Request" in kind or "_Response" in kind
        for kind in pair.compiled.get_fields_and_field_types().values()
    ):
        return pair.made(), pair.compiled()  # an event holds messages of the class beside it
    return pair.made(**fields), compiled


_VALUES: tuple[Any, ...] = (
    *(None, True, 1, -1, 300, 70000, 2**40, -(2**40), 2**70, 0.5, 1e300, -1e300, float("inf")),
    *("", "a", "text", b"", b"\1", b"\1\2", bytearray(b"\1")),
    *(
        [],
        [1],
        [0.5],
        ["a"],
        [b"\1"],
        [True],
        [-1],
        [2**40],
        [2**70],
        (1, 2, 3),
        {1},
        {"a": 1},
        [1e300],
        [None],
    ),
    *([0.0] * 9, [0.0] * 36, [1] * 16, object),
)


@pytest.mark.filterwarnings(
    "ignore:.collections.abc.ByteString:DeprecationWarning"
)  # which the wheels ask for
def test_checked_fields_refuse_the_same_values_with_the_same_words() -> None:
    for pair in messages():
        if pair.name.endswith("_Event"):
            continue
        made, compiled = pair.made(check_fields=True), pair.compiled(check_fields=True)
        for name in pair.made.get_fields_and_field_types():
            for value in (*_VALUES, getattr(compiled, name)):
                assert _outcome(made, name, value) == _outcome(compiled, name, value), (
                    pair.name,
                    name,
                    value,
                )


def _outcome(message: Any, name: str, value: Any) -> tuple[str, str]:
    try:
        setattr(message, name, value)
    except (AssertionError, TypeError, ValueError, OverflowError, AttributeError) as error:
        # pytest adds lines to what a module says that is called like a test: `_self_test`.
        return type(error).__name__, str(error).partition("\n")[0]
    return "holds", repr(getattr(message, name))


def test_checks_are_asked_for_by_the_variable_of_rosidl() -> None:
    program = (
        "from orchestra.ros.interfaces.definitions import provide; provide('tf2_msgs')\n"
        "from tf2_msgs.msg import TF2Error\n"
        "try: TF2Error(error='no')\n"
        "except AssertionError as error: print(error)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, "ROS_PYTHON_CHECK_FIELDS": "1"},
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert done.stdout == "The 'error' field must be of type 'int'\n"
