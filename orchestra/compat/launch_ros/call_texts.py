"""Code that takes texts out of calls of one form: words, variables, and several of both."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.compat.launch.substitutions.launch_configuration import LaunchConfiguration
from orchestra.compat.launch_ros.plain_texts import UnusualError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch_ros.call_code import Code
    from orchestra.compat.place import Way
    from orchestra.description.text import Template

    _Path: TypeAlias = tuple[Way, ...]

# What is left of an argument, and the expression that makes what it is to the model.
Read: TypeAlias = tuple[Any, str]


class Texts:
    """Reads the texts of a call, and writes what reads those of others."""

    def __init__(self, code: Code) -> None:
        self._code = code

    def text(self, level: int, var: str, value: Any, path: _Path) -> Read:
        """Read a text, a substitution, or several of both."""
        kind = type(value)
        if is_plain(value):
            return self.word(level, var), f"words({var}, False, call, {self._code.constant(path)})"
        if kind is LaunchConfiguration and known(value) is not None:
            return self._code.leaf(var), self._variable(level, var)
        if is_mixed(value):
            return self._mixed(level, var, value, path)
        made = self._code.new(1)[0]
        self._code.others += [
            f"{made} = plain_text({var}, call, {self._code.constant(path)})",
            f"{var} = copied({var})",
        ]
        self._code.leaf(made)
        return self._code.leaf(var), made

    def word(self, level: int, var: str) -> Any:
        """Take a text with nothing to look at in it."""
        self._code.exactly(level, var, str)
        self._code.texts.append(var)
        return self._code.leaf(var)

    def _mixed(self, level: int, var: str, value: Sequence[Any], path: _Path) -> Read:
        """Read several texts and variables as one text."""
        skeleton, raw, pieces, names = [], "", "", []
        items = self._code.items(level, var, value)
        for item_var, item in items:
            skeleton.append(self._code.leaf(item_var))
            if type(item) is str:
                self._code.exactly(level + 1, item_var, str)
                self._code.texts.append(item_var)
                self._code.needed.append(item_var)
                raw += f"{{{item_var}}}"
                pieces += f"{item_var}, "
            else:
                whole = self._variable(level + 1, item_var)
                raw += f"{{{whole}.raw}}"
                pieces += f"{whole}.pieces.pieces[0], "
                names.append(f"{whole}.pieces.variables")
        given = "".join(f"{item_var}, " for item_var, _ in items)
        at = self._code.constant(path)
        made = f'mixed(f"{raw}", ({pieces}), {" + ".join(names)}, ({given}), call, {at})'
        return tuple(skeleton) if type(value) is tuple else skeleton, made

    def _variable(self, level: int, var: str) -> str:
        """Return what is the text that a variable is."""
        self._code.exactly(level, var, LaunchConfiguration)
        made = self._code.new(1)[0]
        self._code.variables.append(f"{made} = {var}._sure or sure({var})")
        self._code.leaf(made)
        return made


def known(variable: LaunchConfiguration) -> Template | None:
    """Return the text that a variable alone is, None where a closer look has to tell."""
    return variable._sure or (None if variable._whole() is None else variable._sure)


def sure(variable: LaunchConfiguration) -> Template:
    """Return the text that a variable alone is. Raises `UnusualError`."""
    known_as = variable._known_as
    if known_as is None:
        raise UnusualError
    return variable._surely(known_as)


def is_plain(value: Any) -> bool:
    """Return whether something is a text with nothing to look at in it."""
    return type(value) is str and "$" not in value and "\\" not in value


def is_mixed(value: Any) -> bool:
    """Return whether something is several texts and variables with nothing to look at in them."""
    kinds = set(map(type, value)) if type(value) in _SERIES else ()
    if (
        LaunchConfiguration not in kinds
        or not {str, LaunchConfiguration}.issuperset(kinds)
        or len(value) < _SEVERAL
    ):
        return False
    return all(
        (item and "$" not in item and "\\" not in item) if type(item) is str else known(item) is not None
        for item in value
    )


_SERIES: Final = frozenset({list, tuple})
_SEVERAL: Final = 2
