"""Models of pydantic: pydantic validates, and what it says is told of parameters."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Any, Literal

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator, model_validator

from orchestra.declared.pydantic_model import read_model
from orchestra.errors import Code, Problems
from orchestra.location import Location, point
from orchestra.resolve.model import NamedSchema

if TYPE_CHECKING:
    from orchestra.declared.model import ParameterSchema
    from orchestra.values import ParameterValue

_PATIENT = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
_AT = Location(point("x.launch.yaml"))


class Colour(Enum):
    RED = "red"
    GREEN = "green"


class Wheel(BaseModel):
    model_config = ConfigDict(extra="forbid")
    radius: float = Field(gt=0)
    names: list[str] = []


class Robot(BaseModel):
    """What a robot is told."""

    speed: float = Field(1.0, ge=0, le=5)
    count: int = 3
    mode: Literal["fast", "slow"] = "fast"
    colour: Colour = Colour.RED
    either: int | str = 1
    wheel: Wheel | None = None
    limits: dict[str, float] = {}
    pair: tuple[float, float] = (0.0, 0.0)

    @field_validator("count")
    @classmethod
    def odd(cls, value: int) -> int:
        if value % 2 == 0:
            raise ValueError("must be odd")
        return value

    @model_validator(mode="after")
    def together(self) -> Robot:
        if self.mode == "slow" and self.speed > 1:
            raise ValueError("slow is not that fast")
        return self


class Strict(Robot):
    model_config = ConfigDict(extra="forbid")
    name: str


class Open(Robot):
    model_config = ConfigDict(extra="allow")


class Fails(BaseModel):
    a: int = 1

    @field_validator("a")
    @classmethod
    def fail(cls, value: int) -> int:
        raise RuntimeError(f"no {value}")


def _schema(model: object) -> ParameterSchema:
    problems = Problems()
    read = read_model(NamedSchema("m:M", _AT, model=model), problems)
    assert list(problems) == []
    assert read is not None
    return read


def _faults(model: object, **values: ParameterValue) -> list[tuple[str, str, str | None, bool]]:
    every = {name.replace("__", "."): value for name, value in values.items()}
    return [(fault.kind, fault.name, fault.meant, fault.certain) for fault in _schema(model).faults(every)]


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ({"speed": 2.0, "count": 5, "mode": "slow", "colour": "green"}, [("value", "", None, True)]),
        ({"speed": 7.0}, [("value", "speed", None, True)]),
        ({"speed": "fast"}, [("type", "speed", None, True)]),
        ({"speed": 2}, [("type", "speed", "2.0", False)]),
        ({"count": 2}, [("value", "count", None, True)]),
        ({"count": 3.5}, [("type", "count", None, True)]),
        ({"mode": "fsat"}, [("value", "mode", "fast", True)]),
        ({"colour": "gren"}, [("value", "colour", "green", True)]),
        ({"either": "a"}, []),
        ({"either": True}, [("type", "either", '"true"', False)]),
        ({"wheel__radius": 0.1}, []),
        ({"wheel__radius": -0.1}, [("value", "wheel.radius", None, True)]),
        ({"wheel__names": ("a",)}, [("missing", "wheel.radius", None, True)]),
        ({"wheel__radius": 0.1, "wheel__nmaes": "a"}, [("undeclared", "wheel.nmaes", "wheel.names", True)]),
        ({"limits__left": 1.0, "limits__right": 2.0}, []),
        ({"limits__left": "x"}, [("type", "limits.left", None, True)]),
        ({"pair": (1.0, 2.0)}, []),
        ({"pair": (1.0,)}, [("value", "pair", None, True)]),
        ({"pair": (1.0, 2.0, 3.0)}, [("value", "pair", None, True)]),
        ({"sped": 1.0}, [("undeclared", "sped", "speed", False)]),
        ({"use_sim_time": 1}, [("type", "use_sim_time", "true", True)]),
    ],
)
def test_what_pydantic_says(values: dict[str, Any], expected: list[Any]) -> None:
    found = _faults(Robot, **values)
    assert found == expected


def test_what_the_model_says_of_others() -> None:
    assert _faults(Strict, name="a", sped=1.0) == [("undeclared", "sped", "speed", True)]
    assert _faults(Strict, naem="a") == [("undeclared", "naem", "name", True)]
    assert _faults(Strict) == [("missing", "name", None, True)]
    assert _faults(Open, sped=1.0) == []


def test_code_of_a_model_that_fails_is_told() -> None:
    (fault,) = _schema(Fails).faults({"a": 1})
    assert fault.told == "the model 'Fails' fails: RuntimeError: no 1"


def test_what_a_validator_raises_is_told_in_its_words() -> None:
    assert [fault.told for fault in _schema(Robot).faults({"count": 2, "pair": (1.0,)})] == [
        "'count': must be odd",
        "'pair' has too few items",
    ]


def test_what_is_no_model_is_told() -> None:
    problems = Problems()
    assert read_model(NamedSchema("m:M", _AT, model=Colour), problems) is None
    assert [(problem.code, problem.message) for problem in problems] == [
        (Code.BROKEN_DECLARATION, "'m:M' is no model of pydantic")
    ]


_values = st.dictionaries(
    st.sampled_from(["speed", "count", "mode", "colour", "either", "other"]),
    st.integers(-2, 9) | st.sampled_from([0.5, 2.0, "fast", "slow", "green", "3"]) | st.booleans(),
    max_size=4,
)


@_PATIENT
@given(_values)
def test_what_pydantic_takes_is_taken(values: dict[str, Any]) -> None:
    try:
        Robot.model_validate(values)
        taken = True
    except ValidationError:
        taken = False
    certain = [fault for fault in _schema(Robot).faults(values) if fault.certain]
    assert (not certain) == taken
