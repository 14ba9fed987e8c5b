"""`orchestra schema`: print a JSON Schema."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from orchestra.cli.parser import CommandParser
from orchestra.cli.schemas.table import SCHEMAS, schema_text

if TYPE_CHECKING:
    from argparse import Namespace


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser(
        "schema", "Print the JSON Schema of launch files, parameter files, plans, events or problems."
    )
    made.add_argument(
        "name", nargs="?", choices=sorted(SCHEMAS), default="launch", help="which one (default: launch)"
    )
    return made


def run(options: Namespace) -> int:
    """Print the schema."""
    sys.stdout.write(schema_text(options.name))
    return 0
