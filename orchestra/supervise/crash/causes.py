"""What an ending means, in words: exit codes, signals, and the lines in which a program says itself why it ends."""

from __future__ import annotations

import re
import signal
from typing import TYPE_CHECKING

from orchestra.supervise.process.ending import NOT_EXECUTABLE, NOT_FOUND, signal_name

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from orchestra.supervise.process.ending import Ending

# Shells give 128+n for signal n; above that there is none.
_SIGNALLED = 128
_LAST_SIGNAL = 64

# sysexits.h (the codes of sendmail, which many programs took over).
_SYSEXITS = {
    64: "the command line is wrong (EX_USAGE)",
    65: "the input is wrong (EX_DATAERR)",
    66: "an input file is missing or cannot be read (EX_NOINPUT)",
    67: "a user is not known (EX_NOUSER)",
    68: "a host is not known (EX_NOHOST)",
    69: "a service is not there (EX_UNAVAILABLE)",
    70: "a fault in the program itself (EX_SOFTWARE)",
    71: "the system refused something: no process, no memory (EX_OSERR)",
    72: "a file of the system is missing (EX_OSFILE)",
    73: "an output file cannot be made (EX_CANTCREAT)",
    74: "reading or writing failed (EX_IOERR)",
    75: "something that may work later (EX_TEMPFAIL)",
    76: "the other side does not keep to the protocol (EX_PROTOCOL)",
    77: "no permission (EX_NOPERM)",
    78: "the configuration is wrong (EX_CONFIG)",
}
_CODES = {
    **_SYSEXITS,
    1: "the program reports a failure",
    2: "the program reports a failure; many use this code for a wrong command line",
    NOT_EXECUTABLE: "a shell found the program, but could not execute it: no permission, or the wrong format",
    NOT_FOUND: "a shell, or the dynamic loader, did not find a program or a shared library",
    128: "the program called exit with a value that is none",
    255: "the program reports a failure with -1; ssh does so where the connection fails",
}
_SIGNALS: dict[int, str] = {
    signal.SIGSEGV: "an access to memory that is not the program's: a null or dangling pointer, an index out of range, "
    "a stack that is full",
    signal.SIGBUS: "an access to memory that is not there: a mapped file that was cut, /dev/shm full, wrong alignment",
    signal.SIGABRT: "the program gave up on itself: an uncaught C++ exception, an assertion, memory that was corrupted",
    signal.SIGFPE: "an impossible calculation: most often a division of integers by zero",
    signal.SIGILL: "an instruction that this processor does not have: built for another one, or the code is damaged",
    signal.SIGKILL: "somebody killed it: the kernel for want of memory, an administrator, a container",
    signal.SIGTERM: "somebody asked it to end, who was not Orchestra: a service manager, a script, a person",
    signal.SIGINT: "somebody interrupted it, who was not Orchestra",
    signal.SIGHUP: "its terminal was closed, or somebody told it so",
    signal.SIGQUIT: "somebody asked for its core: Ctrl-\\ at a terminal, or a script",
    signal.SIGPIPE: "it wrote to a pipe or socket that nobody reads any more",
    signal.SIGALRM: "a timer of its own ran out, and it had no handler for it",
    signal.SIGSYS: "a system call that is forbidden to it (seccomp), or that does not exist",
    signal.SIGTRAP: "a breakpoint without a debugger, or a check that the compiler put in",
    signal.SIGXCPU: "its limit of processor time (limits: cpu) was used up",
    signal.SIGXFSZ: "it wrote a file beyond its limit of size (limits: fsize)",
    signal.SIGUSR1: "somebody sent it, and it had no handler",
    signal.SIGUSR2: "somebody sent it, and it had no handler",
}


def meaning(ending: Ending) -> str:
    """Return what usually causes an ending; an empty text where nothing is known of it."""
    if ending.reason is not None:
        return "the program never ran"
    if ending.code is None:
        return _SIGNALS.get(ending.signal or 0, "a signal for which the program had no handler")
    if ending.code in _CODES:
        return _CODES[ending.code]
    number = ending.code - _SIGNALLED
    if 0 < number <= _LAST_SIGNAL:
        cause = _SIGNALS.get(number, "")
        told = f"as a shell says that what it ran was ended by {signal_name(number)}"
        return f"{told}: {cause}" if cause else told
    return ""


# What interpreters, C and C++ libraries, sanitizers and the dynamic loader write before they end a program.
_TELLING = re.compile(
    r"""
      Fatal\ Python\ error: .*
    | terminate\ called\ .*
    | \s* what\(\): .*
    | .* Assertion\ .*\ failed\.?
    | .* AddressSanitizer: .*
    | .* runtime\ error: .*
    | \*\*\*\ .*\ detected\ \*\*\*.*
    | .*(double\ free|free\(\):|malloc\(\):|corrupted\ ).*
    | .* error\ while\ loading\ shared\ libraries: .*
    | .* symbol\ lookup\ error: .*
    | .*:\ line\ \d+:\ .*
    | (ModuleNotFoundError|ImportError): .*
    """,
    re.VERBOSE,
)
_TRACEBACK = "Traceback (most recent call last):"
# The last line of a traceback: a class, with its module where it is not built in, and what the exception says.
_EXCEPTION = re.compile(r"[A-Za-z_][\w.]*(: .*)?")


def telling_lines(lines: Sequence[str]) -> list[str]:
    """Return the lines among the last ones that say why a program ended, oldest first, each once."""
    exception = _python_exception(lines)
    found = [line.strip() for line in lines if _TELLING.fullmatch(line)]
    return list(dict.fromkeys([*found, *exception]))


def _python_exception(lines: Sequence[str]) -> Iterable[str]:
    """Return the exception of the last traceback, without its stack."""
    starts = [index for index, line in enumerate(lines) if line.strip() == _TRACEBACK]
    return list(_after_stack(lines[starts[-1] + 1 :]))[:1] if starts else ()


def _after_stack(lines: Sequence[str]) -> Iterator[str]:
    for line in lines:
        if line[:1].strip() and _EXCEPTION.fullmatch(line):
            yield line
