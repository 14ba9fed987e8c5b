"""The pytest plug-in, which pytest finds by its entry point."""

from __future__ import annotations
