"""Where files are from."""

import os
import sysconfig

from orchestra.witness import origins


def test_folders_are_those_that_python_itself_tells() -> None:
    """They are put together without a look at how Python was built."""
    told = sysconfig.get_paths()
    for names, folders in (
        (("stdlib", "platstdlib"), origins.PYTHON),
        (("purelib", "platlib"), origins.INSTALLED),
    ):
        known = {path for name in names for path in (told[name], os.path.realpath(told[name]))}
        assert {folder.rstrip("/") for folder in folders} == known
