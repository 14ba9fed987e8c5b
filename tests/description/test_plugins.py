"""Plug-ins of pydantic are not looked for."""

from __future__ import annotations

import subprocess
import sys

_SCRIPT = """
import sys
from orchestra.description.schema import launch_schema
launch_schema()
print("importlib.metadata" in sys.modules)
from pydantic.plugin import _schema_validator
from pydantic import BaseModel
class Model(BaseModel):
    x: int
print(Model(x="3").x)
"""


def test_models_are_made_without_the_metadata_of_all_that_is_installed() -> None:
    found = subprocess.run([sys.executable, "-c", _SCRIPT], check=True, capture_output=True, text=True)
    assert found.stdout.split() == ["False", "3"]
