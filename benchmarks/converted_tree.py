"""A tree of launch files in another language: what `orchestra convert` writes of each, and all else as it stands."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING, Final

from benchmarks import launching

if TYPE_CHECKING:
    from pathlib import Path

    from benchmarks.figure import Site

# The ends of names of launch files by language, as `orchestra convert --to` calls them.
ENDS: Final = {"xml": "launch.xml", "python": "launch.py"}

# One process for all files: it takes as long to start as to convert twenty of them. It prints how many there were.
_CONVERTING: Final = """
import os, sys
from pathlib import Path
from orchestra.convert.converting import convert
language, end, folder = sys.argv[1:]
files = sorted(Path(folder).glob("*.launch.yaml"))
for file in files:
    converted = convert(str(file), language, os.environ)
    assert converted.text is not None and not converted.lossy, (file, converted.remarks)
    # They include each other.
    text = converted.text.replace(".launch.yaml", f".{end}")
    file.with_name(file.name.replace("launch.yaml", end)).write_text(text)
    file.unlink()
print(len(files))
"""


def write(site: Site, yaml: Path, language: str) -> Path:
    """Write the tree beside a launch file in YAML once more, in a folder of its own; return the file at its top.

    Raises `RuntimeError` where it cannot be said in that language.
    """
    folder = yaml.parent.with_name(f"{yaml.parent.name}-{language}")
    shutil.copytree(yaml.parent, folder)
    launching.printed(_CONVERTING, [language, ENDS[language], folder], site)
    return folder / yaml.name.replace("launch.yaml", ENDS[language])
