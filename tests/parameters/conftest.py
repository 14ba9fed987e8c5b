from __future__ import annotations

from tests.resolve.conftest import ask_rcl

__all__ = ["ask_rcl"]
