"""A page with all pictures and figures of a run, in one file that needs nothing else."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any

from bringup.evaluation.bar import LEAST_INSIDE, moments, outcome
from bringup.evaluation.errors import inside, nees

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bringup.evaluation.track import Track

PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>{title}</title>
<style>
body {{ font: 15px/1.5 sans-serif; color: #24292f; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }}
table {{ border-collapse: collapse; }}
th, td {{ padding: .25rem .9rem; border-bottom: 1px solid #d7dbe0; text-align: right; }}
th:first-child, td:first-child {{ text-align: left; }}
figure {{ margin: 2rem 0; }}
svg {{ max-width: 100%; height: auto; }}
figcaption {{ color: #57606a; }}
</style>
<h1>{title}</h1>
<p>{about}</p>
{table}
{figures}
</html>
"""


def page(
    tracks: Sequence[Track], facts: Mapping[str, Any], pictures: Mapping[str, str], notes: Sequence[str] = ()
) -> str:
    """The page; `pictures` are captions and SVG documents, `notes` what a reader should know of the data."""
    world = facts.get("world")
    title = f"Evaluation of a run in {world}, seed {facts.get('seed')}" if world else "Evaluation of a run"
    seconds = max(float(track.times[-1] - track.times[0]) for track in tracks)
    about = [f"{seconds:.0f} s of simulated time, {len(tracks)} robots.", *notes]
    return PAGE.format(
        title=html.escape(title),
        about=html.escape(" ".join(about)),
        table=_table(tracks),
        figures="\n".join(
            f"<figure>{_inline(svg)}<figcaption>{html.escape(caption)}</figcaption></figure>"
            for caption, svg in pictures.items()
        ),
    )


def _table(tracks: Sequence[Track]) -> str:
    head = (
        "robot",
        "filtered, RMS (m)",
        "wheel odometry, RMS (m)",
        "ratio",
        "mean NEES",
        "inside 95 %",
        "contacts",
    )
    rows = [_row(track) for track in tracks]
    return (
        f"<table><tr>{''.join(f'<th>{name}</th>' for name in head)}</tr>"
        + "".join(f"<tr>{''.join(f'<td>{html.escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
        + f"</table><p>NEES is 3 on average where the covariance is exact; {LEAST_INSIDE:.0%} or more of the errors "
        "in (x, y, yaw) should lie inside the 95 % ellipse.</p>"
    )


def _row(track: Track) -> tuple[str, ...]:
    figures = outcome("", track, moments(float(track.times[-1])))
    return (
        track.robot,
        f"{figures.filtered:.3f}",
        f"{figures.wheels:.3f}",
        f"{figures.ratio:.3f}",
        f"{nees(track).mean():.2f}",
        f"{inside(track).mean():.1%}",
        str(track.contacts),
    )


def _inline(svg: str) -> str:
    """An SVG document as an element of a page: without its declarations."""
    return svg[svg.index("<svg") :]
