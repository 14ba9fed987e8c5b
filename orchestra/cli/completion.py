"""`orchestra completion`: print what makes a shell complete `orchestra` command lines."""

from __future__ import annotations

import sys
from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.cli.parser import CommandParser

if TYPE_CHECKING:
    from collections.abc import Sequence

SHELLS = ("bash", "zsh", "fish")
_COMPLETE = "--complete"
_EPILOG = """\
bash   eval "$(orchestra completion bash)" in ~/.bashrc
zsh    eval "$(orchestra completion zsh)" in ~/.zshrc, after compinit
fish   orchestra completion fish > ~/.config/fish/completions/orchestra.fish
"""


class _Parser(CommandParser):
    """Leaves alone what the printed text asks with: the words of another command line, dashes and all."""

    def read(self, words: Sequence[str]) -> Namespace:
        if words[:1] == [_COMPLETE]:
            return Namespace(shell=None, question=words[1:])
        return Namespace(question=None, **vars(super().read(words)))


def parser() -> CommandParser:
    """Return what the command understands."""
    made = _Parser("completion", "Print what makes a shell complete orchestra's command lines.", _EPILOG)
    made.add_argument("shell", choices=SHELLS, help="which one")
    return made


def run(options: Namespace) -> int:
    """Print the text, or the answer to a question of it."""
    if options.question is None:
        hook = Path(__file__).parent / "completing" / "hooks" / options.shell
        sys.stdout.write(hook.read_text("utf-8"))
        return 0
    from orchestra.cli.completing.answers import answer  # noqa: PLC0415 - the text itself needs nothing of it

    shell, *question = options.question or [""]
    sys.stdout.write(answer(shell, question))
    return 0
