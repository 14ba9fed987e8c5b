"""The run as a film (MP4, H.264) or its end as a picture (PNG), seen from above."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from bringup.world.sensing import due

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from numpy.typing import NDArray

    from bringup.world.rendering import Renderer

WIDTH, HEIGHT = 640, 480
CAMERA = "overview"
# Pictures per simulated second of a film.
RATE = 20


class RecordingError(ValueError):
    """A run cannot be recorded as asked; the message says why."""


class Recording(Protocol):
    """Something that keeps pictures of a run."""

    def add(self, ticks: int, picture: Callable[[], NDArray[np.uint8]]) -> None:
        """Take what is to be seen at a tick, if it is wanted."""

    def close(self, picture: Callable[[], NDArray[np.uint8]]) -> None:
        """Take what is to be seen at the end and write all. Raises OSError."""


class Film:
    """An MP4 file; its parts can be watched whatever becomes of the process that writes it."""

    def __init__(self, path: Path) -> None:
        # Here, because a run without a film needs no encoder.
        import av  # noqa: PLC0415

        whole = {"movflags": "frag_keyframe+empty_moov"}
        self._file: Any = av.open(str(path), "w", format="mp4", options=whole)
        self._stream = self._file.add_stream(
            "libx264", rate=RATE, options={"preset": "veryfast", "crf": "23"}
        )
        self._stream.width, self._stream.height, self._stream.pix_fmt = WIDTH, HEIGHT, "yuv420p"
        self._frame = av.VideoFrame.from_ndarray

    def add(self, ticks: int, picture: Callable[[], NDArray[np.uint8]]) -> None:
        """Add a picture at every fifth tick."""
        if due(ticks, RATE):
            self._file.mux(self._stream.encode(self._frame(np.ascontiguousarray(picture()), format="rgb24")))

    def close(self, _picture: Callable[[], NDArray[np.uint8]]) -> None:
        """Write what the encoder still holds."""
        self._file.mux(self._stream.encode())
        self._file.close()


class Still:
    """A PNG file with the end of the run."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def add(self, _ticks: int, _picture: Callable[[], NDArray[np.uint8]]) -> None:
        """Wait for the end."""

    def close(self, picture: Callable[[], NDArray[np.uint8]]) -> None:
        """Write the picture."""
        # Here, because a run without a picture needs no Pillow.
        from PIL import Image  # noqa: PLC0415

        Image.fromarray(picture()).save(self._path, format="PNG")


KINDS: dict[str, Callable[[Path], Recording]] = {".mp4": Film, ".png": Still}


def opened(path: Path) -> Recording:
    """What writes such a file. Raises RecordingError: of another kind, or not to be written."""
    kind = KINDS.get(path.suffix.lower())
    if kind is None:
        raise RecordingError(f"parameter 'record': '{path}' should end in {' or '.join(KINDS)}")
    folder = path.parent
    if not folder.is_dir() or not os.access(folder, os.W_OK) or path.is_dir():
        raise RecordingError(f"parameter 'record': '{path}' cannot be written")
    try:
        return kind(path)
    except (ImportError, OSError) as error:
        raise RecordingError(f"parameter 'record': '{path}' cannot be written: {error}") from error


def seen(renderer: Renderer, data: Any) -> Callable[[], NDArray[np.uint8]]:  # noqa: ANN401 - MjData has no type
    """The world from above, when it is asked for."""
    return lambda: renderer.render(data, CAMERA, WIDTH, HEIGHT)
