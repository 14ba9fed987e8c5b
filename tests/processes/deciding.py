"""A run whose resolver stays and decides what triggers do, as code of a launch file would.

deciding.py DOCUMENT ANSWERS    ANSWERS is a JSON file: from `ref` to what is done about a question:

{"answer": FRAGMENT}        this is the answer; every "@TEXT@" in it becomes the `text` of the event, decoded
{"raise": TEXT}             the code raises
{"exit": N}                 the code calls sys.exit
{"die": NAME}               the resolver is ended by this signal
{"hang": 0}                 the code never comes to an end; says "hanging" on standard error first
{"slow": PATH}              the answer, an empty one, takes until there is this file

Each question is appended, as a line of JSON, to ANSWERS.asked.
"""

import base64
import json
import os
import signal
import sys
import threading
import time
from pathlib import Path
from typing import Any, BinaryIO

from orchestra.supervise.run import run

Answer = dict[str, Any]


def prepare(stream: BinaryIO) -> Any:
    stream.write(Path(sys.argv[1]).read_bytes())
    return decide


def decide(question: dict[str, Any]) -> Answer:
    answers = Path(sys.argv[2])
    with answers.with_suffix(".asked").open("a") as asked:
        asked.write(json.dumps(question) + "\n")
    ((what, value),) = json.loads(answers.read_text())[str(question["ref"])].items()
    match what:
        case "raise":
            raise RuntimeError(value)
        case "exit":
            sys.exit(value)
        case "die":
            os.kill(os.getpid(), signal.Signals[f"SIG{value}"])
        case "hang":
            os.write(2, b"hanging\n")
            threading.Event().wait()
        case "slow":
            while not Path(value).exists():
                time.sleep(0.02)
            return {}
    return filled(value, question["event"])


def filled(answer: Answer, event: dict[str, Any]) -> Answer:
    text = base64.b64decode(event.get("text", "")).decode().strip()
    found: Answer = json.loads(json.dumps(answer).replace("@TEXT@", text))
    return found


sys.exit(run(prepare))
