"""What the resolver hands to the supervisor: one JSON document with a plan and the options of the run.

In it where the values of a process come from stands between two marks, so that who reads it may pass it over.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from orchestra.plan import codec, model
from orchestra.plan.json_text import MARK
from orchestra.supervise import options

if TYPE_CHECKING:
    from orchestra.supervise.options import RunOptions

_MOST_SHOWN: Final = 200  # processes: to write more than these line by line holds up the first by 20 ms


class Document(NamedTuple):
    """A plan and how to run it.

    `text` is the whole plan as JSON. In `plan` it is left out where values come from: nobody asks for that while it
    runs, and it is two thirds of the text.
    """

    plan: model.Plan
    options: RunOptions
    text: str


def dumps(plan: model.Plan, run_options: RunOptions) -> bytes:
    """Return the document for the stream that `prepare` is given: where values come from stands apart in it."""
    told = codec.dumps(plan, apart=model.Provenance)
    return f"{_before(options.encode(run_options))}{told}}}".encode("utf-8", "surrogatepass")


def loads(content: bytes) -> Document:
    """Read a document. Raises `ValueError` where it is none."""
    parts = content.decode("utf-8", "surrogatepass").split(MARK)
    written = "".join(parts)
    # Of a large plan what nobody asks for is not read: it takes three times as long as all else.
    is_whole = len(parts) <= 2 * _MOST_SHOWN
    document = json.loads(written if is_whole else "{}".join(parts[::2]))
    if not isinstance(document, dict) or document.keys() - {"plan", "options"} or "plan" not in document:
        raise ValueError("not an object with a plan")
    plan = document["plan"]
    if not isinstance(plan, dict) or plan.get("version") != model.VERSION:
        raise ValueError(f"not a plan of version {model.VERSION}")
    try:
        text = _text(plan, _before(document.get("options", {})), written, is_whole=is_whole)
        for record in (*plan["processes"], *plan["components"]):
            record["provenance"] = {}
        return Document(codec.decode(model.Plan, plan), options.decode(document.get("options", {})), text)
    except (KeyError, TypeError, AttributeError, IndexError) as error:
        raise ValueError(f"the plan is not complete: {error!r}") from error


def _before(chosen: dict[str, Any]) -> str:
    return f'{{"options": {json.dumps(chosen, ensure_ascii=False)}, "plan": '


def _text(plan: dict[str, Any], before: str, written: str, *, is_whole: bool) -> str:
    """Return the plan for people, with a line for each value; a large one, which nobody reads so, as it is written."""
    if len(plan["processes"]) > _MOST_SHOWN and written.startswith(before):
        return f"{written[len(before) : -1]}\n"
    return f"{codec.dumps(plan if is_whole else json.loads(written)['plan'], indent=2)}\n"
