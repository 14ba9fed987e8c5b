"""Results are kept many in a file, share what they depend on, and survive damage and company."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.witness.batches import Batches
from orchestra.witness.record import Record
from orchestra.witness.world import World

if TYPE_CHECKING:
    from pathlib import Path


def _results(first: int, last: int) -> list[tuple[str, Record, object]]:
    shared = Record(variables={"SHARED": "x" * 1000})
    found: list[tuple[str, Record, object]] = []
    for number in range(first, last):
        record = Record(variables={f"OWN{number}": str(number)})
        record.depend(shared)
        found.append((f"key{number}", record, {"number": number}))
    return found


def _read(folder: Path, key: str) -> object:
    found = Batches(str(folder)).read(key)
    return None if found is None else found[1]


def test_results_are_read_with_all_that_they_depend_on(tmp_path: Path) -> None:
    Batches(str(tmp_path / "new/folder")).write(_results(0, 3))
    kept = Batches(str(tmp_path / "new/folder"))
    assert kept.read("other") is None
    for number in range(3):
        found = kept.read(f"key{number}")
        assert found is not None
        record, result = found
        assert result == {"number": number}
        assert record.whole().variables == {f"OWN{number}": str(number), "SHARED": "x" * 1000}
        changed = {f"OWN{number}": str(number), "SHARED": "y"}
        for environment, holds in ((record.whole().variables, True), (changed, False), ({}, False)):
            assert World(environment, lambda _: None).holds(record) is holds  # type: ignore[arg-type] # no None in it


def test_texts_of_other_classes_are_kept_as_texts(tmp_path: Path) -> None:
    """Code may look at a path of a class of its own, which a record has as it is."""

    class Name(str):
        __slots__ = ()

    record = Record(looks={"mode": {Name("/some"): 5}}, variables={"A\udc80": Name("b\udc80")})
    Batches(str(tmp_path)).write([("key", record, [Name("c"), ("d", None)])])
    found = Batches(str(tmp_path)).read("key")
    assert found is not None
    assert found[0].whole().looks == {"mode": {"/some": 5}}
    assert found[0].whole().variables == {"A\udc80": "b\udc80"}
    assert found[1] == ["c", ["d", None]]


def test_what_results_share_is_there_once(tmp_path: Path) -> None:
    Batches(str(tmp_path)).write(_results(0, 50))
    (file,) = tmp_path.iterdir()
    assert file.read_bytes().count(b"x" * 1000) == 1
    assert file.stat().st_mode & 0o777 == 0o600


def test_the_latest_result_counts_and_many_files_become_one(tmp_path: Path) -> None:
    for turn in range(20):
        batches = Batches(str(tmp_path))
        batches.write([("changing", Record(), turn)])
        batches.write([(f"steady{turn}", Record(), turn)])
        batches.tidy()
        assert len(list(tmp_path.iterdir())) <= 14
        assert _read(tmp_path, "changing") == turn
    assert [_read(tmp_path, f"steady{turn}") for turn in range(20)] == list(range(20))


def test_what_was_kept_first_goes_where_there_is_too_much(tmp_path: Path) -> None:
    for turn in range(40):
        batches = Batches(str(tmp_path), most=10_000)
        batches.write([(f"key{turn}", Record(), "x" * 1000)])
        batches.tidy()
    kept = Batches(str(tmp_path))
    assert kept.read("key39")
    assert kept.read("key0") is None
    assert sum(file.stat().st_size for file in tmp_path.iterdir()) < 11_500


def test_damage_costs_no_more_than_what_it_hits(tmp_path: Path) -> None:
    Batches(str(tmp_path)).write(_results(0, 1))
    Batches(str(tmp_path)).write(_results(1, 2))
    first = min(tmp_path.iterdir())
    content = first.read_bytes()
    for damaged in (b"", content[:40], content[:-1], content.replace(b"number", b"numbed")):
        first.write_bytes(damaged)
        kept = Batches(str(tmp_path))
        assert kept.read("key0") is None
        assert kept.read("key1")
        kept.tidy()
    first.unlink()
    assert Batches(str(tmp_path)).read("key0") is None


def test_a_file_that_goes_while_it_is_read_counts_as_none(tmp_path: Path) -> None:
    Batches(str(tmp_path)).write(_results(0, 1))
    kept = Batches(str(tmp_path))
    for file in tmp_path.iterdir():
        file.unlink()
    assert kept.read("key0") is None


def test_nothing_is_kept_that_depends_on_what_nobody_knows(tmp_path: Path) -> None:
    part = Record(unknown="time")
    record = Record()
    record.depend(part)
    Batches(str(tmp_path)).write([("key", record, 1)])
    assert not list(tmp_path.iterdir())


def test_files_that_cannot_be_read_go_with_the_others(tmp_path: Path) -> None:
    batches = Batches(str(tmp_path))
    batches.write([("key", Record(), 5)])
    for number in range(20):
        (tmp_path / f"{number:020}-1-0.batch").write_bytes(b"damaged")
    batches.tidy()
    assert len(list(tmp_path.iterdir())) == 1
    found = Batches(str(tmp_path)).read("key")
    assert found is not None
    assert found[1] == 5
