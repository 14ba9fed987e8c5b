"""Trees of files: what is looked at, what user code does to the check, what is kept, and the hooks for it."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess

import pytest
import yaml

from orchestra.cli.commands import COMMANDS
from orchestra.cli.targets import targets

Command = Callable[..., CompletedProcess[str]]

_FINE = "launch: [log: {message: hello}]\n"
_ROOT = Path(__file__).parents[2]


def _write(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def _looked_at(folder: Path) -> list[str]:
    return [os.path.relpath(target.path, folder) for target in targets([str(folder)])]


def test_what_was_made_or_installed_in_a_project_is_left_alone(tmp_path: Path) -> None:
    left_out = (
        *("install", "build", "venv", ".hidden", "ignored", "a/ignored", "node_modules/x", "__pycache__"),
        *("kept/draft", "excluded"),
    )
    _write(tmp_path, {f"{name}/x.launch.yaml": _FINE for name in ("src", "kept", *left_out)})
    _write(
        tmp_path,
        {
            "install/COLCON_IGNORE": "",
            "build/AMENT_IGNORE": "",
            "venv/pyvenv.cfg": "",
            ".gitignore": "ignored/\n*.yml\n!b.launch.yml\n",
            "kept/.gitignore": "draft\n",
            "src/a.launch.yml": _FINE,
            "src/b.launch.yml": _FINE,
            "orchestra.toml": "exclude = ['excluded', '*.draft.yaml']\n",
            "src/c.draft.yaml": _FINE,
        },
    )
    (tmp_path / "src/circle").symlink_to(tmp_path)
    (tmp_path / "src/linked.launch.yaml").symlink_to("nowhere")
    assert _looked_at(tmp_path) == [
        *("kept/x.launch.yaml", "src/b.launch.yml", "src/linked.launch.yaml", "src/x.launch.yaml"),
    ]


def test_what_is_named_is_looked_at_wherever_it_is(tmp_path: Path) -> None:
    _write(
        tmp_path,
        {".gitignore": "install/\n", "install/share/x.launch.yaml": _FINE, "install/COLCON_IGNORE": ""},
    )
    (tmp_path / ".git").mkdir()
    assert _looked_at(tmp_path / "install") == ["share/x.launch.yaml"]
    assert _looked_at(tmp_path / "install/share") == ["x.launch.yaml"]
    assert [target.path for target in targets([str(tmp_path / "install/share/x.launch.yaml")])]


def test_what_a_repository_ignores_holds_below_its_root(tmp_path: Path) -> None:
    _write(
        tmp_path, {".gitignore": "/src/made\n", "src/made/x.launch.yaml": _FINE, "src/a.launch.yaml": _FINE}
    )
    (tmp_path / ".git").mkdir()
    assert _looked_at(tmp_path / "src") == ["a.launch.yaml"]


_BAD = {
    "crash": ("import os\nos.kill(os.getpid(), 11)\n", "SIGSEGV"),
    "leave": ("import os\nos._exit(0)\n", "exit status 0"),
    "exit": ("import sys\nsys.exit(3)\n", "SystemExit"),
    "endless": ("while True: pass\n", "has not come to an end within 4 s"),
    "fork": ("import os\nos.fork()\nraise ValueError('after a fork')\n", "after a fork"),
}


def test_code_that_ends_or_holds_its_process_is_a_problem_of_its_file_alone(
    orchestra: Command, folder: Path
) -> None:
    _write(folder, {f"{name}.launch.py": text for name, (text, _) in _BAD.items()})
    _write(folder, {f"fine{number}.launch.yaml": _FINE for number in range(5)})
    found = orchestra("check", ".", "--format", "json", "--time-limit", "4")
    assert found.returncode == 2
    told = {problem["file"].split(".")[0]: problem for problem in json.loads(found.stdout)}
    assert told.keys() == _BAD.keys()
    assert {problem["code"] for problem in told.values()} == {"ORC036"}
    for name, (_, words) in _BAD.items():
        assert words in told[name]["message"]


def test_what_code_prints_is_no_part_of_the_result(orchestra: Command, folder: Path) -> None:
    text = "import os\nprint('one')\nos.system('echo two')\nos.write(1, b'three')\n"
    made = "from launch import LaunchDescription\ndef generate_launch_description(): return LaunchDescription([])\n"
    _write(folder, {"a.launch.py": text + made})
    found = orchestra("check", ".", "--format", "json")
    assert (found.returncode, found.stdout) == (0, "[]\n")


def test_problems_come_in_the_same_order_however_many_look(orchestra: Command, folder: Path) -> None:
    _write(folder, {f"part{number}/x.launch.yaml": "launch: [lgo: {}]\n" for number in range(12)})
    alone = orchestra("check", ".", "--jobs", "1", "--no-cache")
    assert orchestra("check", ".", "--jobs", "4", "--no-cache").stdout == alone.stdout
    for _ in range(2):
        assert orchestra("check", ".").stdout.replace(", 12 unchanged", "") == alone.stdout


def test_what_code_of_one_file_changes_is_not_there_for_the_next(orchestra: Command, folder: Path) -> None:
    changes = ("chdir('/')", "environ.update(WORLD='flat')", "sys.path.clear()")
    reading = (
        "launch: [log: {message: $(file-content beside.txt) $(eval \"__import__('os').environ['WORLD']\")}]\n"
    )
    _write(folder, {"beside.txt": "x", "0.launch.yaml": _FINE})
    for number, change in enumerate(changes):
        code = f"__import__('os').{change}"
        changing = f'launch: [log: {{message: $(eval "{code}")}}]\n'
        _write(folder, {f"{number}a.launch.yaml": changing, f"{number}b.launch.yaml": reading})
    together = orchestra("check", ".", "--jobs", "1", "--no-cache", "--format", "json")
    found = json.loads(together.stdout)
    alone = [
        problem
        for path in _looked_at(folder)
        for problem in json.loads(orchestra("check", path, "--no-cache", "--format", "json").stdout)
    ]
    assert found == alone
    assert [problem["file"] for problem in found] == [
        f"{number}b.launch.yaml" for number in range(len(changes))
    ]


def test_files_behind_conditions_are_looked_at(orchestra: Command, folder: Path) -> None:
    _write(
        folder,
        {
            "main.launch.yaml": "launch:\n  - include: {file: sub/a.launch.yaml, if: 'false'}\n",
            "sub/a.launch.yaml": "launch:\n  - arg: {name: needed}\n  - include: {file: b.launch.yaml, if: 'false'}\n",
            "sub/b.launch.yaml": "launch:\n  - lgo: {}\n",
            "main.launch.py": (
                "import os\nfrom launch import LaunchDescription\nfrom launch.conditions import IfCondition\n"
                "from launch.actions import IncludeLaunchDescription\n"
                "def generate_launch_description():\n"
                "    file = os.path.join(os.path.dirname(__file__), 'sub', 'c.launch.yaml')\n"
                "    return LaunchDescription([IncludeLaunchDescription(file, condition=IfCondition('false'))])\n"
            ),
            "sub/c.launch.yaml": "launch:\n  - arg: {name: needed}\n  - nod: {}\n",
        },
    )
    found = orchestra("check", "main.launch.yaml", "main.launch.py", "--format", "json")
    told = [(problem["code"], problem["file"]) for problem in json.loads(found.stdout)]
    assert sorted(told) == [("ORC007", "sub/b.launch.yaml"), ("ORC007", "sub/c.launch.yaml")]


def test_a_severity_of_the_command_line(orchestra: Command, folder: Path) -> None:
    _write(folder, {"a.launch.yaml": "launch: [executable: {cmd: ls, nmae: x}]\n"})
    assert orchestra("check", ".", "--severity", "ORC004=off").returncode == 0
    assert orchestra("plan", "a.launch.yaml", "--severity", "ORC004=warning").returncode == 0
    wrong = orchestra("check", ".", "--severity", "ORC04=off")
    assert (wrong.returncode, "did you mean 'ORC004'?" in wrong.stderr) == (2, True)
    wrong = orchestra("check", ".", "--severity", "ORC004=of")
    assert (wrong.returncode, "did you mean 'off'?" in wrong.stderr) == (2, True)


@pytest.mark.parametrize("words", [("--jobs", "0"), ("--jobs", "x"), ("--time-limit", "-1")])
def test_options_that_make_no_sense(orchestra: Command, folder: Path, words: tuple[str, ...]) -> None:
    _write(folder, {"a.launch.yaml": _FINE})
    assert orchestra("check", ".", *words).returncode == 2


def test_the_hooks_name_commands_that_there_are() -> None:
    hooks = yaml.safe_load((_ROOT / ".pre-commit-hooks.yaml").read_text())
    assert [hook["id"] for hook in hooks] == ["orchestra-check", "orchestra-format"]
    for hook in hooks:
        assert {"id", "name", "description", "entry", "language", "files"} <= hook.keys()
        program, command = hook["entry"].split()
        assert (program, command in COMMANDS) == ("orchestra", True)
    check, form = (re.compile(hook["files"]) for hook in hooks)
    for name in ("a.launch.py", "x/a_launch.xml", "a.launch", "params.yaml", "orchestra.toml"):
        assert check.search(name)
    assert not check.search("README.md")
    assert form.search("x/a.launch.yaml")
    assert not form.search("x/a.launch.py")


def test_the_jobs_in_the_documentation_are_yaml() -> None:
    text = (_ROOT / "docs/checking.md").read_text().partition("## In CI")[2]
    blocks = [yaml.safe_load(block) for block in re.findall(r"```yaml\n(.*?)```", text, re.DOTALL)]
    ids = {hook["id"] for block in blocks for repo in block.get("repos", []) for hook in repo["hooks"]}
    assert ids == {"orchestra-check", "orchestra-format"}
    steps = [step for block in blocks for job in block.get("jobs", {}).values() for step in job["steps"]]
    assert any("--format github" in step.get("run", "") for step in steps)
    assert any("upload-sarif" in step.get("uses", "") for step in steps)


def test_each_file_finds_an_empty_folder_for_temporary_files(tmp_path: Path, orchestra: Command) -> None:
    """One that was left empty serves the next file, whatever has been done to another."""
    code = """\
import os, tempfile
from launch import LaunchDescription
assert os.listdir(tempfile.gettempdir()) == []
{}
def generate_launch_description():
    return LaunchDescription([])
"""
    deeds = (
        "",
        "tempfile.mkstemp()",
        "",
        "os.chmod(tempfile.gettempdir(), 0)",
        "",
        "os.rmdir(tempfile.gettempdir())",
        "tempfile.mkstemp()",
    )
    files = {f"{number}.launch.py": code.format(deed) for number, deed in enumerate(deeds)}
    _write(tmp_path / "tree", files)
    done = orchestra("check", "--jobs", "1", str(tmp_path / "tree"))
    assert (done.returncode, done.stdout) == (0, "no problems in 7 files\n")
