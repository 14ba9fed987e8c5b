"""The code of a launch file whose function makes a description and does not return it, as it was meant."""

from __future__ import annotations

import ast
import linecache
import warnings
from typing import TYPE_CHECKING

from orchestra.compat.syntax_trees import called_by

if TYPE_CHECKING:
    from types import CodeType

_MADE = "LaunchDescription"


def code_with_return(file: str, function: str) -> CodeType | None:
    """Return the code of a file whose function returns what it makes, None where that is not plain."""
    try:
        with warnings.catch_warnings(action="ignore"):  # told when the file was run
            tree = ast.parse("".join(linecache.getlines(file)))
            for node in tree.body:
                if isinstance(node, ast.FunctionDef) and node.name == function and _returns(node):
                    return compile(ast.fix_missing_locations(tree), file, "exec", dont_inherit=True)
    except (SyntaxError, ValueError, RecursionError):
        pass  # what is run was another text
    return None


def _returns(function: ast.FunctionDef) -> bool:
    """Let a function return the description that it makes; return whether it makes one."""
    last = function.body[-1]
    if isinstance(last, ast.Return):  # of nothing
        function.body.pop()
    elif isinstance(last, ast.Expr) and isinstance(last.value, ast.Call) and called_by(last.value) == _MADE:
        function.body[-1] = ast.copy_location(ast.Return(last.value), last)
        return True
    made = [
        item.targets[0]
        for item in function.body
        if isinstance(item, ast.Assign)
        and isinstance(item.value, ast.Call)
        and called_by(item.value) == _MADE
    ]
    if len(made) != 1 or not isinstance(made[0], ast.Name):
        return False
    name = ast.copy_location(ast.Name(made[0].id, ast.Load()), last)
    function.body.append(ast.copy_location(ast.Return(name), last))
    return True
