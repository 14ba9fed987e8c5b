"""Packages and what they have registered, as launch files find them."""

from __future__ import annotations

import os
import sys
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.compat import ament_index_python as ament
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Iterator

_INDEX = ament.RESOURCE_INDEX_SUBFOLDER


def _register(prefix: Path, kind: str, name: str, content: str = "") -> None:
    file = prefix / _INDEX / kind / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(content)


@pytest.fixture
def prefixes(tmp_path: Path) -> Iterator[tuple[str, str]]:
    """Two prefixes: `lower` is in both, `upper` has no share folder."""
    over, under = tmp_path / "over", tmp_path / "under"
    _register(over, "packages", "upper")
    _register(over, "packages", "lower")
    _register(under, "packages", "lower")
    _register(under, "packages", ".hidden")
    _register(under, "packages", "only_under")
    _register(over, "robots", "arm", "six joints")
    _register(under, "robots", "arm", "seven joints")
    _register(under, "robots", "leg")
    for prefix in (over, under):
        (prefix / "share" / "lower").mkdir(parents=True)
    (under / "share" / "only_under").mkdir()
    variable = os.pathsep.join(map(str, (over, tmp_path / "gone", under)))
    with loading({"AMENT_PREFIX_PATH": variable, "PATH": "/usr/bin:/bin"}):
        yield str(over), str(under)


@pytest.mark.conforms(
    "1.17 get_package_prefix",
    "1.17 get_package_share_directory",
    "1.17 get_package_share_path",
    "4.10 AMENT_PREFIX_PATH",
)
def test_the_first_prefix_that_has_a_package_counts(prefixes: tuple[str, str]) -> None:
    over, under = prefixes
    assert ament.get_package_prefix("lower") == over
    assert ament.get_package_share_directory("lower") == f"{over}/share/lower"
    assert ament.get_package_share_path("only_under") == Path(under, "share", "only_under")


@pytest.mark.conforms("1.17 get_packages_with_prefixes")
def test_all_packages_are_known_with_their_prefixes(prefixes: tuple[str, str]) -> None:
    over, under = prefixes
    found = ament.get_packages_with_prefixes()
    assert {name: found[name] for name in ("upper", "lower", "only_under")} == {
        "upper": over,
        "lower": over,
        "only_under": under,
    }
    assert ".hidden" not in found


@pytest.mark.conforms("1.17 get_package_prefix")
@pytest.mark.parametrize("name", ["_package", "a package", "a/package", "a.package", "/a", "", "x"])
def test_what_cannot_be_a_name_is_a_value_error(prefixes: tuple[str, str], name: str) -> None:
    del prefixes
    with pytest.raises(ValueError, match="cannot be the name of a package"):
        ament.get_package_prefix(name)


@pytest.mark.conforms("1.17 PackageNotFoundError")
def test_a_missing_package_is_a_key_error_that_names_what_was_meant(prefixes: tuple[str, str]) -> None:
    del prefixes
    for look_up in (
        ament.get_package_prefix,
        ament.get_package_share_directory,
        ament.get_package_share_path,
    ):
        with pytest.raises(ament.PackageNotFoundError) as raised:
            look_up("loewr")
        assert isinstance(raised.value, KeyError)
        assert str(raised.value) == "there is no package 'loewr' here, did you mean 'lower'?"


@pytest.mark.conforms("1.17 get_package_share_directory", "1.17 get_package_share_path")
def test_a_share_folder_that_does_not_exist_is_warned_of(prefixes: tuple[str, str]) -> None:
    over, _ = prefixes
    with pytest.warns(UserWarning, match="does not exist"):
        assert ament.get_package_share_directory("upper") == f"{over}/share/upper"
    with pytest.warns(UserWarning, match="does not exist"):
        ament.get_package_share_path("upper")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ament.get_package_share_directory("upper", print_warning=False)


def test_python_packages_are_found_without_ament(prefixes: tuple[str, str]) -> None:
    del prefixes
    folder = Path(ament.get_package_share_directory("bringup"))
    assert (folder / "__init__.py").is_file()


@pytest.mark.conforms("1.17 get_resource")
def test_resources_are_those_of_the_first_prefix(prefixes: tuple[str, str]) -> None:
    over, under = prefixes
    assert ament.get_resource("robots", "arm") == ("six joints", over)
    assert ament.get_resources("robots") == {"arm": over, "leg": under}
    assert ament.has_resource("robots", "leg") == under
    assert ament.has_resource("robots", "wing") is False
    assert {"packages", "robots"} <= ament.get_resource_types()
    assert ament.get_resources("nothing") == {}
    with pytest.raises(LookupError, match="wing"):
        ament.get_resource("robots", "wing")


@pytest.mark.conforms("1.17 InvalidResourceTypeNameError")
@pytest.mark.parametrize("name", ["a/b", "/a", "a\\b", ""])
def test_names_of_resources_have_no_slashes(prefixes: tuple[str, str], name: str) -> None:
    del prefixes
    with pytest.raises(ament.InvalidResourceNameError):
        ament.has_resource("robots", name)
    with pytest.raises(ament.InvalidResourceNameError):
        ament.get_resource("robots", name)
    for look_up in (ament.get_resources, lambda kind: ament.has_resource(kind, "arm")):
        with pytest.raises(ament.InvalidResourceTypeNameError):
            look_up(name)


@pytest.mark.conforms("1.17 get_search_paths")
def test_prefixes_that_do_not_exist_are_not_searched(prefixes: tuple[str, str]) -> None:
    assert ament.get_search_paths() == list(prefixes)


@pytest.mark.conforms("1.17 get_search_paths")
def test_without_the_variable_there_is_the_interpreter_s_prefix_or_an_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    monkeypatch.setattr(sys, "prefix", str(tmp_path))
    with pytest.raises(EnvironmentError, match="AMENT_PREFIX_PATH"):
        ament.get_search_paths()
    _register(tmp_path, "packages", "wheel")
    assert ament.get_search_paths() == [str(tmp_path)]
    assert ament.has_resource("packages", "wheel") == str(tmp_path)


@pytest.mark.conforms("1.17 RESOURCE_INDEX_SUBFOLDER")
def test_the_submodules_have_the_names_too() -> None:
    from orchestra.compat.ament_index_python import constants, packages, resources, search_paths  # noqa: PLC0415

    assert packages.get_package_prefix is ament.get_package_prefix
    assert resources.get_resource is ament.get_resource
    assert search_paths.get_search_paths is ament.get_search_paths
    assert constants.RESOURCE_INDEX_SUBFOLDER == _INDEX
