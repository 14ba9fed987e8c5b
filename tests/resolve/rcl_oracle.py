"""The real rcl, asked over a pipe: `python rcl_oracle.py` answers one JSON line for each JSON line.

It runs in a process of its own, because rclpy and its middleware stay in the process that loads them.
`parse` calls rcl's C parser of parameter files by itself; `node` creates a node and tells what it has.
"""

from __future__ import annotations

import array
import ctypes
import json
import os
import sys
import tempfile
from pathlib import Path
from typing import Any

import rclpy
from rclpy.impl.implementation_singleton import rclpy_implementation as rcl
from rclpy.parameter import Parameter

_POINTERS = ctypes.c_void_p


class Variant(ctypes.Structure):
    _fields_ = tuple(
        (name, _POINTERS)
        for name in (
            "bool",
            "int",
            "float",
            "str",
            "bytes",
            "bool_array",
            "int_array",
            "float_array",
            "str_array",
        )
    )


class NodeParameters(ctypes.Structure):
    _fields_ = (
        ("names", ctypes.POINTER(ctypes.c_char_p)),
        ("values", ctypes.POINTER(Variant)),
        ("count", ctypes.c_size_t),
        ("capacity", ctypes.c_size_t),
    )


class Parameters(ctypes.Structure):
    _fields_ = (
        ("node_names", ctypes.POINTER(ctypes.c_char_p)),
        ("nodes", ctypes.POINTER(NodeParameters)),
        ("count", ctypes.c_size_t),
        ("capacity", ctypes.c_size_t),
    )


class Array(ctypes.Structure):
    _fields_ = (("values", _POINTERS), ("size", ctypes.c_size_t))


class StringArray(ctypes.Structure):
    _fields_ = (("size", ctypes.c_size_t), ("values", ctypes.POINTER(ctypes.c_char_p)))


class Allocator(ctypes.Structure):
    _fields_ = tuple((name, _POINTERS) for name in ("a", "b", "c", "d", "state"))


class ErrorText(ctypes.Structure):
    _fields_ = (("text", ctypes.c_char * 1024),)


_LIBRARIES = Path(rclpy.__file__).parents[3]
_UTILS = ctypes.CDLL(str(_LIBRARIES / "librcutils.so"))
_PARSER = ctypes.CDLL(str(_LIBRARIES / "librcl_yaml_param_parser.so"))
_UTILS.rcutils_get_default_allocator.restype = Allocator
_UTILS.rcutils_get_error_string.restype = ErrorText
_PARSER.rcl_yaml_node_struct_init.restype = ctypes.POINTER(Parameters)
_PARSER.rcl_yaml_node_struct_init.argtypes = (Allocator,)
_PARSER.rcl_yaml_node_struct_fini.argtypes = (ctypes.POINTER(Parameters),)
_PARSER.rcl_parse_yaml_file.restype = ctypes.c_bool
_PARSER.rcl_parse_yaml_file.argtypes = (ctypes.c_char_p, ctypes.POINTER(Parameters))

_SCALARS = (
    ("bool", ctypes.c_bool),
    ("int", ctypes.c_int64),
    ("float", ctypes.c_double),
)


def _value(variant: Variant) -> Any:
    """Return the value that rclpy and rclcpp take from a variant: the first kind that is set, in this order."""
    for name, kind in _SCALARS:
        if pointer := getattr(variant, name):
            return kind.from_address(pointer).value
    if variant.str:
        return ctypes.string_at(variant.str).decode()
    for name, kind in _SCALARS:
        if pointer := getattr(variant, f"{name}_array"):
            found = Array.from_address(pointer)
            return [
                kind.from_address(found.values + i * ctypes.sizeof(kind)).value for i in range(found.size)
            ]
    if variant.str_array:
        texts = StringArray.from_address(variant.str_array)
        return [texts.values[i].decode() for i in range(texts.size)]
    return None


def parse(texts: list[str]) -> Any:
    """Read the texts as parameter files into one table: pattern, then name and value, in order."""
    table = _PARSER.rcl_yaml_node_struct_init(_UTILS.rcutils_get_default_allocator())
    try:
        with tempfile.NamedTemporaryFile("wb") as file:
            for text in texts:
                Path(file.name).write_bytes(text.encode())
                if not _PARSER.rcl_parse_yaml_file(file.name.encode(), table):
                    message = _UTILS.rcutils_get_error_string().text.decode(errors="replace")
                    _UTILS.rcutils_reset_error()
                    return {"error": message}
        return [
            [
                table[0].node_names[i].decode(),
                [
                    [table[0].nodes[i].names[k].decode(), _value(table[0].nodes[i].values[k])]
                    for k in range(table[0].nodes[i].count)
                ],
            ]
            for i in range(table[0].count)
        ]
    finally:
        _PARSER.rcl_yaml_node_struct_fini(table)


def node(
    context: rclpy.Context,
    arguments: list[Any],
    namespace: str = "/ns",
    name: str = "n",
    topics: tuple[str, ...] = (),
) -> Any:
    """Create a node; an argument that is a list holds the text of a parameter file."""
    with tempfile.TemporaryDirectory() as folder:
        words = []
        for index, argument in enumerate(arguments):
            if isinstance(argument, list):
                path = Path(folder, f"{index}.yaml")
                path.write_text(argument[0], encoding="utf-8", newline="")
                words.append(str(path))
            else:
                words.append(argument)
        try:
            with context.handle:
                handle = rcl.Node(name, namespace, context.handle, words, False, False)
            with handle:
                parameters = handle.get_parameters(Parameter)
                own = (handle.get_node_name(), handle.get_namespace())
                return {
                    "name": handle.get_fully_qualified_name(),
                    "parameters": {key: _plain(parameter.value) for key, parameter in parameters.items()},
                    "topics": {
                        topic: rcl.rclpy_remap_topic_name(handle, rcl.rclpy_expand_topic_name(topic, *own))
                        for topic in topics
                    },
                }
        except (RuntimeError, ValueError, rcl.RCLInvalidROSArgsError) as error:
            return {"error": str(error)}


def _plain(value: Any) -> Any:
    """Return arrays as lists, for JSON."""
    return list(value) if isinstance(value, array.array) else value


def names(name: str) -> Any:
    """Return what rcl says of a name: as a topic, a full topic, a namespace, a node; and its expansion."""
    try:
        expanded = rcl.rclpy_expand_topic_name(name, "n", "/ns")
    except ValueError:
        expanded = None
    return [
        rcl.rclpy_get_validation_error_for_topic_name(name),
        rcl.rclpy_get_validation_error_for_full_topic_name(name),
        rcl.rclpy_get_validation_error_for_namespace(name),
        rcl.rclpy_get_validation_error_for_node_name(name),
        expanded,
    ]


def main() -> None:
    """Answer until the asker closes the pipe. What libraries print goes to standard error."""
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    context = rclpy.Context()
    context.init([])
    # As long as there is a node, nodes come and go without a participant of DDS: one that is given back while others
    # are found may never come back (eProsima/Fast-DDS#6513).
    with context.handle:
        stays = rcl.Node("stays", "", context.handle, [], False, False)
    for line in sys.stdin:
        question = json.loads(line)
        kind = question.pop("ask")
        if kind == "parse":
            answer = parse(**question)
        elif kind == "node":
            answer = node(context, **question)
        else:
            answer = names(**question)
        answers.write(json.dumps(answer) + "\n")
        answers.flush()
    stays.destroy_when_not_in_use()
    context.shutdown()


if __name__ == "__main__":
    main()
