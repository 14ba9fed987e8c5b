"""`bag reindex`: the metadata of a bag anew, of what its files have."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import RunError
from orchestra.fields import replace
from orchestra.ros.tools.bag import summary
from orchestra.ros.tools.bag.reading import Bag
from orchestra.ros.tools.telling import tell, warn

if TYPE_CHECKING:
    from argparse import Namespace


def reindex(options: Namespace) -> int:
    """Write `metadata.yaml`, in place of any that is there."""
    folder = Path(options.bag)
    if folder.is_file():
        raise RunError(f"{folder} is a file, and metadata stand in the folder of a bag")
    with Bag(folder, anew=True) as bag:
        told = replace(bag.summary(), mode=bag.mode())
        for file in bag.broken:
            warn(f"warning: {file} has no end: what is told is what can be read of it")
    made = folder / f".{summary.FILE}"
    made.write_text(summary.metadata_text(told), "utf-8")
    made.rename(folder / summary.FILE)
    data = {"path": str(folder), "files": list(told.files), "messages": told.count}
    tell(
        options,
        f"{told.count} messages of {len(told.topics)} topics in {len(told.parts)} files: {folder}\n",
        data,
    )
    return 0
