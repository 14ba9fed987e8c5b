"""The environment variables by which every process of a run can be told."""

from __future__ import annotations

RUN = "ORCHESTRA_RUN"
PROCESS = "ORCHESTRA_PROCESS"
