"""`orchestra check`: find what is wrong in launch files and parameter files, and start nothing."""

from __future__ import annotations
