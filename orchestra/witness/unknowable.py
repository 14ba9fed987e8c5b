"""Signs that a result depends on something that nobody can record: time, chance, other programs, the network."""

from __future__ import annotations

from types import CodeType
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Callable
    from collections.abc import Set as AbstractSet

# Events of the interpreter (docs.python.org, "Audit events table"): a whole name, or its beginning before a dot.
EVENTS: Final = frozenset(
    {
        *("subprocess", "socket", "sqlite3", "ctypes", "urllib", "ftplib", "http", "smtplib", "pty", "fcntl"),
        *("os.system", "os.exec", "os.fork", "os.forkpty", "os.posix_spawn", "os.spawn", "os.startfile"),
        *("os.getxattr", "os.listxattr", "os.kill", "os.killpg", "mmap", "signal"),
        *("_thread", "syslog", "webbrowser", "nntplib", "poplib", "imaplib", "telnetlib", "winreg"),
    }
)
# Events of what is changed: whoever goes by a kept result does not change it again.
CHANGES: Final = frozenset(
    {
        *(
            "os.remove",
            "os.rmdir",
            "os.rename",
            "os.mkdir",
            "os.link",
            "os.symlink",
            "os.truncate",
            "os.chmod",
        ),
        *("os.chown", "os.utime", "os.setxattr", "os.removexattr", "os.lockf"),
        *(
            "shutil.copyfile",
            "shutil.copymode",
            "shutil.copystat",
            "shutil.copytree",
            "shutil.move",
            "shutil.rmtree",
        ),
    }
)
# Names in code of users through which it learns what no event tells.
_NAMES: Final = frozenset(
    {
        *("time", "datetime", "random", "secrets", "uuid", "socket", "platform", "getpass", "pwd", "grp"),
        *("psutil", "resource", "multiprocessing", "concurrent", "asyncio", "ctypes", "mmap", "sqlite3"),
        *("getpid", "getppid", "getuid", "geteuid", "getgid", "getegid", "getlogin", "uname", "cpu_count"),
        *("sched_getaffinity", "urandom", "getrandom", "getloadavg", "statvfs", "disk_usage", "isatty"),
        *(
            "get_terminal_size",
            "input",
            "stdin",
            "getmtime",
            "getctime",
            "getatime",
            "getsize",
            "stat_result",
        ),
        *("st_mtime", "st_mtime_ns", "st_ctime", "st_ctime_ns", "st_atime", "st_atime_ns", "st_size"),
        *("st_ino", "st_uid", "st_gid", "st_nlink", "st_dev", "environb", "getnode"),
    }
)


def sign_in(code: CodeType) -> str | None:
    """Return the name by which code, or code inside it, learns what cannot be recorded; None where there is none."""
    waiting = [code]
    while waiting:
        item = waiting.pop()
        for name in item.co_names:
            if name in _NAMES or name.partition(".")[0] in _NAMES:
                return name
        waiting += [inner for inner in item.co_consts if isinstance(inner, CodeType)]
    return None


def reaches_out(code: CodeType) -> bool:
    """Tell whether code names anything: without a name it comes to the same always, and changes nothing."""
    return bool(code.co_names) or any(isinstance(inner, CodeType) for inner in code.co_consts)


def is_unknowable(event: str) -> bool:
    """Tell whether an event of the interpreter is such a sign."""
    return event in EVENTS or event.partition(".")[0] in EVENTS


def sifted(hear: Callable[[str, tuple[Any, ...]], None], harmless: AbstractSet[str]) -> Callable[..., None]:
    """Return a hook of the interpreter that is told of everything, and hands on what is not known to be harmless.

    Some hundreds of events come with each launch file. It is a function because the interpreter asks a hook for an
    attribute each time, which takes twice as long where that is a method.
    """

    def heard(event: str, args: tuple[Any, ...]) -> None:
        if event not in harmless:
            hear(event, args)

    return heard
