"""`python -m tests.chaos`: many runs with random processes and random assaults, several at once.

    --seed TEXT     the same seed gives the same runs (default: another one each time; it is printed)
    --runs N        how many (default: 200)
    --jobs N        how many at once (default: 4; most of the time they wait)
    --busy N        keep so many cores busy meanwhile
    --only N        play run N of the seed alone
    --replay JSON   play one case as it was printed
    --shrink        make the first case that fails as small as it can be

The exit status is 1 where a run broke a promise.
"""

from __future__ import annotations

import sys

from tests.chaos.campaign import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:], __doc__ or ""))
