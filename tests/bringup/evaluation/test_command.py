"""The commands as they are typed."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from bringup.evaluation.command import main


def test_a_good_filter_meets_the_demands(capsys: pytest.CaptureFixture[str]) -> None:
    wheels = ["--simulation", "left_wheel_scale:=1.05", "right_wheel_scale:=0.95"]
    assert main(["consistency", "--seeds", "1", "--seconds", "4", "--jobs", "1", *wheels]) == 0
    said = capsys.readouterr().out.splitlines()
    assert [line.split()[2] for line in said[1:3]] == ["robot1", "robot2"]
    assert said[-1] == "contacts: 0"


def test_a_filter_that_is_too_sure_of_itself_does_not(capsys: pytest.CaptureFixture[str]) -> None:
    sure = [
        "process_noise_covariance:=[" + ", ".join(["1.0e-12"] * 15) + "]",
        "initial_estimate_covariance:=[" + ", ".join(["1.0e-12"] * 15) + "]",
    ]
    assert main(["consistency", "--seeds", "1", "--seconds", "2", "--jobs", "1", "--filter", *sure]) == 1
    assert "not met: at 2 s 0% of the errors lie inside the 95 % ellipse" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("consistency --seeds 1 --jobs 1 --simulation wheel_slip", "'wheel_slip' is not NAME:=VALUE"),
        ("draw {folder} --recording {folder}/none", "No such file"),
        ("draw {folder} --recording {file}", "is no recording"),
    ],
)
def test_what_cannot_be_done_is_said(
    words: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "file"
    file.write_text("no recording at all")
    assert main(words.format(folder=tmp_path, file=file).split()) == 2
    assert told in capsys.readouterr().err


def test_a_run_is_written_and_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, folder = tmp_path / "run", tmp_path / "pictures"
    command = [
        sys.executable,
        "-m",
        "bringup.evaluation",
        "run",
        str(file),
        "--seconds",
        "1",
        "--world",
        "maze",
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=100, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert main(["draw", str(folder), "--recording", str(file)]) == 0
    names = [
        f"{name}.{kind}" for name in ("trajectories", "errors", "consistency") for kind in ("svg", "png")
    ]
    assert capsys.readouterr().out.splitlines() == [str(folder / name) for name in (*names, "report.html")]
    assert "maze, seed 1" in (folder / "report.html").read_text(encoding="utf-8")


def test_nothing_but_drawing_imports_matplotlib() -> None:
    code = "import sys, bringup.evaluation.command; sys.exit('matplotlib' in sys.modules or 'rclpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], timeout=60, check=False).returncode == 0


def test_who_reads_no_further_is_told_no_error() -> None:
    """As where the output goes to `head`."""
    words = [sys.executable, "-m", "bringup.evaluation", "consistency", "--seeds", "1", "--seconds", "1"]
    with subprocess.Popen(
        [*words, "--jobs", "1"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout
        assert process.stderr
        process.stdout.close()
        assert process.stderr.read() == ""
        assert process.wait() == -signal.SIGPIPE
