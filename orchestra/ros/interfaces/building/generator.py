"""The process of one generator of rosidl: its name and the file that tells what it is to do are its arguments."""

from __future__ import annotations

import json
import sys
from importlib import import_module
from pathlib import Path
from typing import Any, Final

_TYPE_SUPPORTS: Final = ["rosidl_typesupport_fastrtps_c", "rosidl_typesupport_introspection_c"]
# The function of each generator's module, and what it is given besides the file.
_FUNCTIONS: Final[dict[str, tuple[str, str, list[Any]]]] = {
    "rosidl_generator_type_description": ("rosidl_generator_type_description", "generate_type_hash", []),
    "rosidl_generator_c": ("rosidl_generator_c", "generate_c", []),
    "rosidl_typesupport_fastrtps_c": ("rosidl_typesupport_fastrtps_c", "generate_typesupport_fastrtps_c", []),
    "rosidl_typesupport_introspection_c": ("rosidl_typesupport_introspection_c", "generate_c", []),
    "rosidl_typesupport_c": ("rosidl_typesupport_c", "generate_c", [_TYPE_SUPPORTS]),
    "rosidl_generator_py": ("rosidl_generator_py", "generate_py", [["rosidl_typesupport_c"]]),
}


def main(name: str, task: str) -> None:
    """Generate what a file says. The definitions are translated to IDL first where it says so."""
    todo = json.loads(Path(task).read_text("utf-8"))
    for file in todo.get("translated", ()):
        share = Path(todo["share"])
        import_module("rosidl_adapter").convert_to_idl(share, todo["package_name"], Path(file), share)
    module, function, arguments = _FUNCTIONS[name]
    getattr(import_module(module), function)(task, *arguments)


if __name__ == "__main__":
    main(*sys.argv[1:])
