"""Interactive shells in a terminal, into which a test types."""

from __future__ import annotations

import os
import pty
import re
import select
import subprocess
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

_DEADLINE = 60.0  # seconds, for one line
_TELL = """
tell() { printf 'WORDS:'; printf '<%s>' "$@"; printf ':%s' DONE; echo; }
"""
_BASH = """
PS1= PS2= HISTFILE=
bind 'set bell-style none'; bind 'set enable-bracketed-paste off'; bind 'set show-all-if-ambiguous on'
bind 'set page-completions off'; bind 'set completion-query-items 0'
eval "$(orchestra completion bash)"
echo READY
"""
_ZSH = """
PS1= PS2= HISTFILE= KEYTIMEOUT=1
unsetopt PROMPT_SP PROMPT_CR BEEP; zstyle ':completion:*' list-prompt ''; LISTMAX=10000
bindkey -e; autoload -Uz compinit; compinit -u -D
eval "$(orchestra completion zsh)"
echo READY
"""
_START_OF_LINE, _TAB = "\x01", "\t"


class Shell:
    """A shell that waits for a line, and what it has shown so far."""

    def __init__(self, terminal: int) -> None:
        self._terminal = terminal
        self.shown = ""

    def words_after_tab(self, typed: str) -> list[str]:
        """Type a text and the Tab key; return the words that the line then has."""
        before = len(self.shown)
        os.write(self._terminal, f"{typed}{_TAB}{_START_OF_LINE}tell \n".encode())
        told = self.wait_for(r"WORDS:(.*?):DONE", before)
        return re.findall(r"<(.*?)>", told[1], re.DOTALL)

    def wait_for(self, pattern: str, start: int = 0) -> re.Match[str]:
        """Return where the pattern is in what the shell has shown since a place."""
        deadline = time.monotonic() + _DEADLINE
        while (found := re.search(pattern, self.shown[start:], re.DOTALL)) is None:
            left = deadline - time.monotonic()
            assert left > 0, f"no {pattern} in {self.shown[start:]!r}"
            if select.select([self._terminal], [], [], left)[0]:
                self.shown += os.read(self._terminal, 1 << 16).decode("utf-8", "replace")
        return found


@contextmanager
def bash(folder: Path, environment: Mapping[str, str]) -> Iterator[Shell]:
    """Start bash with the completion that `orchestra` prints."""
    start = folder / "bashrc"
    start.write_text(_TELL + _BASH)
    with _shell(["bash", "--noprofile", "--rcfile", str(start), "-i"], folder, environment) as shell:
        yield shell


@contextmanager
def zsh(folder: Path, environment: Mapping[str, str]) -> Iterator[Shell]:
    """Start zsh with the completion that `orchestra` prints."""
    (folder / ".zshrc").write_text(_TELL + _ZSH)
    with _shell(["zsh", "-i"], folder, {**environment, "ZDOTDIR": str(folder)}) as shell:
        yield shell


@contextmanager
def _shell(command: Sequence[str], folder: Path, environment: Mapping[str, str]) -> Iterator[Shell]:
    ours, theirs = pty.openpty()
    try:
        with subprocess.Popen(
            command,
            stdin=theirs,
            stdout=theirs,
            stderr=theirs,
            cwd=folder,
            env={**environment, "TERM": "dumb", "INPUTRC": os.devnull, "COLUMNS": "500"},
            start_new_session=True,
        ) as process:
            try:
                shell = Shell(ours)
                shell.wait_for("READY")
                yield shell
            finally:
                process.kill()
    finally:
        os.close(theirs)
        os.close(ours)
