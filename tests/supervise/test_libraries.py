"""The wheels' libraries in one folder of links: found as before, looked for in fewer places, whatever happens to them."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from orchestra.supervise.environment import Host, node_environment
from orchestra.supervise.host import this_host
from orchestra.supervise.libraries import gathered
from orchestra.wheels import LIBRARY_PATH, as_called

WHEELS = this_host()
needs_wheels = pytest.mark.skipif(not WHEELS.libraries, reason="rclpy does not come from wheels here")


def installed(folder: Path, **libraries: str) -> Host:
    """Return a host with a folder for each word, with libraries of the names that it lists."""
    for wheel, names in libraries.items():
        (folder / f"ros_{wheel}.libs").mkdir(parents=True, exist_ok=True)
        for name in names.split():
            (folder / f"ros_{wheel}.libs" / name).write_text(wheel)
    found = sorted(str(path) for path in folder.glob("ros_*.libs"))
    return Host(str(folder), None, (str(folder), *found), ament=False)


def there(host: Host) -> dict[str, str]:
    """Return the content of each library in the folder that stands for all."""
    folder = Path(host.libraries[-1])
    return {path.name: path.read_text() for path in folder.iterdir() if path.name[0] != "."}


def environment(host: Host, caller: dict[str, str]) -> dict[str, str]:
    return node_environment(caller, host, {}, log_folder="/logs", colour=False, marks=("1f-7", "a"))


def test_one_folder_stands_for_all_and_the_first_of_a_name_counts(tmp_path: Path) -> None:
    before = installed(tmp_path / "site", a="x y", b="y z")
    host = gathered(before, f"{tmp_path}/libraries")
    assert (len(host.libraries), host.libraries[0]) == (2, before.libraries[0])
    assert there(host) == {"x": "a", "y": "a", "z": "b"}
    of_the_caller = {LIBRARY_PATH: ":".join((*before.libraries, "/mine"))}
    assert environment(host, of_the_caller)[LIBRARY_PATH] == ":".join((*host.libraries, "/mine"))


def test_whoever_goes_through_the_folder_finds_files_alone(tmp_path: Path) -> None:
    host = gathered(installed(tmp_path / "site", a="x", b="y"), f"{tmp_path}/libraries")
    assert all(path.is_file() for path in Path(host.libraries[-1]).iterdir())


def test_nothing_is_done_where_nothing_has_changed(tmp_path: Path) -> None:
    host = installed(tmp_path / "site", a="x", b="y")
    folder = Path(gathered(host, f"{tmp_path}/libraries").libraries[-1])
    before = folder.stat().st_mtime_ns
    gathered(host, f"{tmp_path}/libraries")
    assert folder.stat().st_mtime_ns == before


def test_what_comes_and_goes_is_followed(tmp_path: Path) -> None:
    gathered(installed(tmp_path / "site", a="x y", b="z"), f"{tmp_path}/libraries")
    (tmp_path / "site" / "ros_a.libs" / "y").unlink()
    host = gathered(installed(tmp_path / "site", b="new", c="other"), f"{tmp_path}/libraries")
    assert there(host) == {"x": "a", "z": "b", "new": "b", "other": "c"}


def test_a_library_that_is_found_elsewhere_now_is_linked_anew(tmp_path: Path) -> None:
    gathered(installed(tmp_path / "site", a="x", b="y"), f"{tmp_path}/libraries")
    shutil.move(tmp_path / "site" / "ros_a.libs" / "x", tmp_path / "site" / "ros_b.libs" / "x")
    assert there(gathered(installed(tmp_path / "site"), f"{tmp_path}/libraries")) == {"x": "a", "y": "b"}


def test_installations_beside_each_other_have_folders_of_their_own(tmp_path: Path) -> None:
    one, other = (
        gathered(installed(tmp_path / name, a=name, b=name), f"{tmp_path}/libraries")
        for name in ("one", "other%")
    )
    assert (there(one), there(other)) == ({"one": "a"}, {"other%": "a"})


@pytest.mark.parametrize("place", ["with:colon", "with;semicolon", "with$ORIGIN", "file/below"])
def test_where_it_cannot_be_all_stays_as_it_is(tmp_path: Path, place: str) -> None:
    (tmp_path / "file").touch()
    host = installed(tmp_path / "site", a="x", b="y")
    assert gathered(host, f"{tmp_path}/{place}") is host


def test_a_folder_in_which_others_write_is_not_taken(tmp_path: Path) -> None:
    host = installed(tmp_path / "site", a="x", b="y")
    made = gathered(host, f"{tmp_path}/libraries").libraries[-1]
    Path(made).chmod(0o777)
    assert gathered(host, f"{tmp_path}/libraries") is host


def test_others_read_it_and_do_not_write_to_it(tmp_path: Path) -> None:
    """A launch prefix may give a process to another user, who has to find them too."""
    before = os.umask(0)
    try:
        made = gathered(installed(tmp_path / "site", a="x", b="y"), f"{tmp_path}/libraries").libraries[-1]
    finally:
        os.umask(before)
    assert Path(made).stat().st_mode & 0o777 == 0o755


def test_many_that_begin_at_once_find_all_of_it(tmp_path: Path) -> None:
    host = installed(tmp_path / "site", a=" ".join(map(str, range(40))), b="x")
    children = []
    for _ in range(8):
        pid = os.fork()
        if pid == 0:
            os._exit(0 if len(there(gathered(host, f"{tmp_path}/libraries"))) == 41 else 1)
        children.append(pid)
    assert [os.waitpid(pid, 0)[1] for pid in children] == [0] * 8


@needs_wheels
def test_rclpy_finds_its_libraries_there(tmp_path: Path) -> None:
    host = gathered(WHEELS, f"{tmp_path}/libraries")
    result = environment(host, {**as_called(os.environ), "ROS_LOG_DIR": str(tmp_path)})
    code = (
        "import os, rclpy; rclpy.init(args=[], domain_id=203); rclpy.create_node('a').destroy_node();"
        f"rclpy.shutdown(); print(os.environ['{LIBRARY_PATH}'])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], env=result, capture_output=True, text=True, timeout=60, check=True
    )
    assert done.stdout.strip() == result[LIBRARY_PATH]
    assert as_called(result).get(LIBRARY_PATH) == as_called(os.environ).get(LIBRARY_PATH)


@needs_wheels
def test_a_program_is_looked_for_in_few_folders(tmp_path: Path) -> None:
    """The loader tells of each file that it tries (ld.so(8), LD_DEBUG)."""
    tried = [
        subprocess.run(
            ["/bin/true"], env={**environment(host, {}), "LD_DEBUG": "libs"}, capture_output=True, check=True
        ).stderr.count(b"trying file=")
        for host in (WHEELS, gathered(WHEELS, f"{tmp_path}/libraries"))
    ]
    assert tried[1] * len(WHEELS.libraries) <= tried[0] * 3
