"""pydantic's core, which validates, without the modules around it.

`import pydantic_core` reads the words for schemas too, which only type checkers look at, and typing_extensions and
asyncio with them: ten times what the core itself takes. So its extension module is loaded alone. Whoever imports
pydantic_core later in the same process, as code of users may, finds that module loaded and has the same classes.
"""

from __future__ import annotations

import sys
from importlib.machinery import PathFinder
from importlib.util import module_from_spec
from typing import TYPE_CHECKING

__all__ = ["PydanticCustomError", "SchemaValidator", "ValidationError"]

if TYPE_CHECKING:
    from types import ModuleType

    from pydantic_core import PydanticCustomError, SchemaValidator, ValidationError

_PACKAGE = "pydantic_core"
_EXTENSION = f"{_PACKAGE}._pydantic_core"


def _loaded() -> ModuleType:
    """Return the module that has the core; the package itself where there is no such module in it."""
    known = sys.modules.get(_EXTENSION)
    if known is not None:
        return known
    package = PathFinder.find_spec(_PACKAGE) if _PACKAGE not in sys.modules else None
    folders = None if package is None else package.submodule_search_locations
    spec = None if folders is None else PathFinder.find_spec(_EXTENSION, folders)
    if spec is None or spec.loader is None:
        import pydantic_core  # noqa: PLC0415 - another way of packing it, or it is there already

        return pydantic_core
    module = sys.modules[_EXTENSION] = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


if not TYPE_CHECKING:
    _core = _loaded()
    PydanticCustomError = _core.PydanticCustomError
    SchemaValidator = _core.SchemaValidator
    ValidationError = _core.ValidationError
