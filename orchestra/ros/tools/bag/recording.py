"""`bag record`."""

from __future__ import annotations

import sys
import time
from contextlib import nullcontext
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from orchestra.errors import RunError, UsageError
from orchestra.ros.tools.bag.overrides import overrides
from orchestra.ros.tools.bag.recorder import Recorder
from orchestra.ros.tools.bag.selection import selection
from orchestra.ros.tools.bag.settings import settings
from orchestra.ros.tools.bag.writing import BagWriter, Layout
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.keyboard import keyboard
from orchestra.ros.tools.telling import as_json, tell, warn

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterable

    from orchestra.ros.tools.bag.summary import Summary

_FAILED: Final = 1
_NANOSECONDS: Final = 1e9


def record(options: Namespace) -> int:
    """Record until Ctrl-C, SIGTERM or the given time; all of them are a good end."""
    chosen, layout, profiles = (
        selection(options),
        _layout(options),
        overrides(options.qos_profile_overrides_path),
    )
    if not (chosen.names or chosen.types or chosen.pattern or chosen.topics or chosen.services):
        raise UsageError("say which topics: names, --topic-types, --services, --regex RE or --all")
    folder = Path(options.output or time.strftime("rosbag2_%Y_%m_%d-%H_%M_%S"))
    if folder.exists():
        raise RunError(f"{folder} is there already")
    hears = sys.stdin.isatty() and not (options.disable_keyboard_controls or as_json(options))
    with joined(options) as graph, keyboard() if hears else nullcontext() as keys:
        writer = BagWriter(folder, layout, f"orchestra {version('orchestra')}")
        recorder = Recorder(graph, writer, chosen, profiles, options)
        began = time.monotonic()
        try:
            recorder.record(None if options.duration is None else began + options.duration, keys)
        except (KeyboardInterrupt, SystemExit):
            recorder.take()
        finally:
            told = recorder.close()
    for name, hint in recorder.missing():
        warn(f"warning: nothing was recorded of {name}: nobody published it{hint}")
    if recorder.timeless:
        warn("warning: nothing was recorded: nobody has published /clock")
    if recorder.lost:
        warn(f"warning: {recorder.lost} messages were lost before they could be recorded")
    tell(options, _text(folder, told), _data(folder, told, recorder.lost))
    return _FAILED if recorder.lost else 0


def _layout(options: Namespace) -> Layout:
    """Return how the bag is written. Raises `UsageError`."""
    if (options.compression_mode == "none") != (not options.compression_format):
        raise UsageError("--compression-mode and --compression-format go together")
    return Layout(
        settings(options.storage_preset_profile, options.storage_config_file, options.compression),
        options.max_bag_size,
        int(options.max_bag_duration * _NANOSECONDS),
        options.compression_mode,
        tuple(_pairs(options.custom_data)),
        options.max_cache_size,
    )


def _pairs(words: Iterable[str]) -> Iterable[tuple[str, str]]:
    for word in words:
        key, sign, value = word.partition("=")
        if not (key and sign):
            raise UsageError(f"'{word}' is not KEY=VALUE")
        yield key, value


def _text(folder: Path, told: Summary) -> str:
    seconds = (told.end - told.start) / _NANOSECONDS
    return f"{told.count} messages of {len(told.topics)} topics in {seconds:.1f} s: {folder}\n"


def _data(folder: Path, told: Summary, lost: int) -> dict[str, Any]:
    return {
        "path": str(folder),
        "messages": told.count,
        "lost": lost,
        "start": told.start,
        "end": told.end,
        "topics": {topic.name: topic.count for topic in told.topics},
    }
