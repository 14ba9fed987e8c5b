"""Where the index lies below a prefix."""

from __future__ import annotations

RESOURCE_INDEX_SUBFOLDER = "share/ament_index/resource_index"
