"""The process of one command: what is asked is the one argument, in JSON; what is answered, standard output."""

from __future__ import annotations

import json
import sys
from pathlib import Path

# Where this is not installed but run from its sources.
sys.path.append(str(Path(__file__).parents[3]))

if __name__ == "__main__":
    from orchestra.ros.tools.answering import answer

    answer(json.loads(sys.argv[1]))
