"""Takes the place of the observer and has manners of its own: odd_observer.py FOLDER MANNER[,MANNER ...] PID

The first one started in FOLDER has the first manner, and so on; the last manner is for all that follow. Each writes the
orders that it gets to FOLDER/N.

good        does everything at once
broken      ends at once
mute        answers nothing, nor whether it is there
hang        answers one ping, then nothing
ask         says that it is asking, then nothing
die         ends at the first order
garbage, list, nameless, wordless, factless, endless
            says something that is none of our words, as soon as it gets an order
"""

import json
import os
import signal
import sys
from pathlib import Path

GARBAGE = {
    "garbage": "{ no JSON",
    "list": "[1]",
    "nameless": '{"say": "done"}',
    "wordless": '{"id": "a"}',
    "factless": '{"id": "1 a", "say": "moved", "transition": 1}',
    "endless": "x" * 200_000,
}
RESULTS: dict[str, dict[str, object]] = {
    "change_state": {"state": "active"},
    "load": {"node": "/c", "unique_id": 1},
}


def say(message: dict[str, object]) -> None:
    os.write(1, (json.dumps(message) + "\n").encode())


def answer(manner: str, message: dict[str, object]) -> None:
    if "ping" in message:
        if manner not in ("mute", "silent"):
            say({"pong": message["ping"]})
        return
    if "forget" in message or manner in ("mute", "hang", "silent"):
        return
    if manner == "die":
        sys.exit(3)
    if manner in GARBAGE:
        os.write(1, GARBAGE[manner].encode() + (b"" if manner == "endless" else b"\n"))
        return
    say({"id": message["id"], "say": "asking"})
    if manner == "good":
        say({"id": message["id"], "say": "done", **RESULTS.get(str(message["do"]), {})})


def main() -> None:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    folder, manners = Path(sys.argv[1]), sys.argv[2].split(",")
    number = len(list(folder.iterdir()))
    manner = manners[min(number, len(manners) - 1)]
    with (folder / str(number)).open("w", buffering=1) as orders:
        if manner == "broken":
            sys.exit("no such module")
        if manner != "mute":
            say({"pong": 0})
        for line in sys.stdin:
            orders.write(line)
            message = json.loads(line)
            answer(manner, message)
            if manner == "hang" and "ping" in message:
                manner = "silent"


main()
