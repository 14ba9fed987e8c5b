"""`FilePath`: whatever names a file."""

from __future__ import annotations

import os
from typing import Union

FilePath = Union[str, bytes, os.PathLike]  # type: ignore[type-arg]  # noqa: UP007 - evaluated by users' own annotations
