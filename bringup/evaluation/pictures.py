"""All pictures of a run, and the page that shows them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bringup.evaluation.drawing import consistency, over_time, trajectories
from bringup.evaluation.drawing.style import save, styled
from bringup.evaluation.ground import shapes
from bringup.evaluation.report import page

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from bringup.evaluation.track import Track

CAPTIONS = {
    "trajectories": "Where the robots drove (broad), where their wheels believed they were (dotted), where their "
    "filters did (thin), and every 10 s the filter's 95 % ellipse.",
    "errors": "The filters' errors against the truth, and three of their own standard deviations about zero.",
    "consistency": "Normalised errors and innovations squared; 95 % lie in the bands if the covariances are right.",
}


def draw(
    tracks: Sequence[Track], facts: Mapping[str, Any], folder: Path, notes: Sequence[str] = ()
) -> list[Path]:
    """Write the pictures as SVG and PNG and the page into a folder, which is made; the files. Raises OSError."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    with styled():
        written += save(trajectories.draw(tracks, shapes(facts.get("shapes", ()))), folder, "trajectories")
        written += save(over_time.draw(tracks), folder, "errors")
        written += save(consistency.draw(tracks), folder, "consistency")
    report = folder / "report.html"
    drawn = {
        caption: (folder / f"{name}.svg").read_text(encoding="utf-8") for name, caption in CAPTIONS.items()
    }
    report.write_text(page(tracks, facts, drawn, notes), encoding="utf-8")
    return [*written, report]
