from __future__ import annotations

import base64
import json
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.fuzz.answers import Answer, Ask

if TYPE_CHECKING:
    from collections.abc import Iterator

_CHECKER = Path(__file__).with_name("checker.py")


@pytest.fixture(scope="session")
def check() -> Iterator[Ask]:
    """Check files in a process of their own."""
    with subprocess.Popen(
        [sys.executable, str(_CHECKER)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        asked, answers = process.stdin, process.stdout

        def ask(files: dict[str, bytes], main: str | None = None) -> Answer:
            encoded = {name: base64.b64encode(content).decode() for name, content in files.items()}
            asked.write(json.dumps({"files": encoded, "main": main or next(iter(files))}) + "\n")
            asked.flush()
            return Answer(**json.loads(answers.readline()))

        yield ask
        process.stdin.close()
