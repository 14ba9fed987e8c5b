"""The fork server, and in each process that it forks the program of a node.

Below a node there is one frame of ours, that of this module; what ends the node passes through it to the interpreter,
which then does what it always does.
"""

from __future__ import annotations

import sys
from pathlib import Path

if not sys.flags.safe_path:
    del sys.path[0]  # the folder of this file
# Where this is not installed but run from its sources. A node has the path as it was.
_path, _modules = tuple(sys.path), frozenset(sys.modules)
sys.path.append(str(Path(__file__).parents[3]))

from orchestra.ros.warm.serving import serve  # noqa: E402

_born = serve(_path, _modules)
# From here on this is the process of a node.
try:
    if _born.module is None:
        exec(_born.compiled(), _born.namespace)  # noqa: S102 - the program of the node
    else:
        _born.run_module(_born.module)
except SystemExit:
    raise
except BaseException:
    _born.hide(__file__)
    raise
