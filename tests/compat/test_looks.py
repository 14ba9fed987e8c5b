"""Names that stand twice in dictionaries of launch files: a short look tells whether a syntax tree is worth it."""

from __future__ import annotations

from types import ModuleType

import pytest

from orchestra.compat.looks import has_doubled_keys

# Many dictionaries with the same names, none of which is wrong.
_SOUND = "def sound(make, name):\n    return [\n" + "        make({'a': 1, 'b': 2}),\n" * 20 + "    ]\n"
_LONG = ", ".join(f"'n{number}': {number}" for number in range(20))
DOUBLED = {
    "in a function": f"{_SOUND}def other():\n    return {{'a': 1, 'a': 2}}\n",
    "beside another name": f"{_SOUND}def other(name):\n    return {{'a': 1, name: 2, 'a': 3}}\n",
    "in a long one": f"{_SOUND}def other():\n    return {{{_LONG}, 'n7': 0}}\n",
    "outside of functions": f"{_SOUND}KNOWN = {{'a': 1, 'a': 2}}\n",
    "outside of functions, on another line": f"{_SOUND}KNOWN = list(\n    {{'a': 1, 'a': 2}}\n)\n",
    "in a class": f"{_SOUND}class Known:\n    names = {{'a': 1, 'a': 2}}\n",
    "in a branch": f"{_SOUND}if sound:\n    names = {{'a': 1, 'a': 2}}\n",
}
SOUND = {
    "numbers in a list": f"{_SOUND}def other():\n    return {{'pose': [0.0, 0.0, 1.0], 'flags': [1, 1, 0]}}\n",
    "many": _SOUND,
    "a long one": f"{_SOUND}def other():\n    return {{{_LONG}}}\n",
}


@pytest.mark.parametrize("name", [*DOUBLED, *SOUND])
def test_names_that_may_stand_twice_are_looked_for(name: str) -> None:
    source = {**DOUBLED, **SOUND}[name].encode()
    module = ModuleType("launch_file")
    module.__file__ = "file.launch.py"
    exec(compile(source, "file.launch.py", "exec"), vars(module))  # noqa: S102 - a launch file is code
    assert has_doubled_keys(module, source) == (name in DOUBLED)
