"""Definitions as they are written for controllers: nested levels, maps over lists, groups that others declare."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.declared.test_rules import faults

if TYPE_CHECKING:
    from orchestra.values import ParameterValue

_ARM = """
arm_controller:
  joints: {
    type: string_array,
    default_value: [],
    description: "Which joints are moved,
      in their order",
    read_only: true,
    validation: {
      unique<>: null,
      size_gt<>: [0],
      "arm_controller::known_joints": null,
    }
  }
  interfaces: {type: string_array, default_value: [position, velocity]}
  tolerance:
    goal:
      type: double
      default_value: .inf
      additional_constraints: "{ type: 'number' }"
    time: {type: double, default_value: 0.0, validation: {gt_eq: [0.0]}}
    __map_joints:
      path: {type: double, default_value: .NAN}
  gains:
    __map_joints:
      __map_interfaces:
        p: {type: double}
  sensors:
    names: {type: string_array, default_value: [left]}
    __map_names:
      frame: {type: string, default_value: ""}
  __map_joints:
    effort: {type: double, default_value: 1.0}
  filters: {type: none, description: "What the filters declare"}
"""


def _told(**values: ParameterValue) -> list[tuple[str, str, str | None]]:
    every = {name.replace("__", "."): value for name, value in values.items()}
    return [(fault.kind, fault.name, fault.meant) for fault in faults(_ARM, **every)]


def test_what_lists_name_is_declared_for_each_item() -> None:
    assert _told(joints=("a",), gains__a__position__p=1.0, gains__a__velocity__p=2.0, a__effort=3.0) == []


def test_a_name_that_the_list_does_not_have_is_not_declared() -> None:
    found = _told(
        joints=("elbow",),
        tolerance__elbwo__path=0.1,
        gains__elbow__position__p=1.0,
        gains__elbow__velocity__p=1.0,
    )
    assert found == [("undeclared", "tolerance.elbwo", "tolerance.elbow")]


def test_a_value_that_each_item_needs_is_missing() -> None:
    found = _told(joints=("a",), gains__a__position__p=1.0)
    assert found == [("missing", "gains.a.velocity.p", None)]


def test_the_list_beside_the_map_is_the_one_that_counts() -> None:
    assert _told(joints=("a",), interfaces=(), sensors__left__frame="x") == []
    found = _told(joints=("a",), interfaces=(), sensors__names=("right",), sensors__left__frame="x")
    assert found == [("undeclared", "sensors.left", None)]


def test_below_a_group_of_others_anything_may_be() -> None:
    assert _told(joints=("a",), interfaces=(), filters__first__type="low_pass", filters__first__rate=3) == []


def test_a_slip_in_a_level_is_one_mistake() -> None:
    found = _told(joints=("a",), interfaces=(), tolerence__goal=1.0, tolerence__time=1.0)
    assert set(found) == {("undeclared", "tolerence", "tolerance")}


def test_a_slip_in_a_name_is_not_told_as_missing_too() -> None:
    found = _told(joints=("a",), interfaces=("position",), gains__a__position__q=1.0)
    assert [kind for kind, *_ in found] == ["undeclared"]


def test_a_group_is_no_parameter_and_a_parameter_no_group() -> None:
    assert _told(joints=("a",), interfaces=(), tolerance=1.0) == [("undeclared", "tolerance", None)]
    assert _told(joints=("a",), interfaces=(), tolerance__time__x=1.0) == [
        ("undeclared", "tolerance.time.x", None)
    ]


def test_a_default_that_is_refused_says_that_a_value_must_be_given() -> None:
    definition = "demo: {radius: {type: double, default_value: 0.0, validation: {gt<>: [0.0]}}}"
    assert [fault.told for fault in faults(definition)] == [
        "the node needs a value for its parameter 'radius', whose default it refuses"
    ]
    assert faults(definition, radius=0.1) == []


def test_what_older_definitions_say_is_read() -> None:
    definition = """
arm:
  method: {type: string, default_value: splines, validation: [validate_method]}
  mass: {type: double_array, fixed_size: 6, bounds: [0.1, 10.0], default_value: []}
  twice: {type: bool, default_value: True}
  twice: {type: bool, default_value: False}
  damping: {type: double, default_value: 5, validation: {gt_eq: [0.0], "arm::gt_or_nan<>": [0.0]}}
"""
    assert faults(definition, method="any") == []


def test_without_a_value_for_the_list_anything_may_be_in_the_map() -> None:
    definition = "demo: {joints: {type: string_array}, gains: {__map_joints: {p: {type: double}}}}"
    found = faults(definition, **{"gains.a.p": 1.0})
    assert [(fault.kind, fault.name) for fault in found] == [("missing", "joints")]


def test_parameters_of_every_node_are_known() -> None:
    found = faults(
        "demo: {x: {type: int, default_value: 1}}",
        use_sim_time=True,
        start_type_description_service=False,
        **{"qos_overrides./tf.publisher.depth": 3},
    )
    assert found == []
    (fault,) = faults("demo: {x: {type: int, default_value: 1}}", use_sim_time="true")
    assert (fault.kind, fault.meant) == ("type", "true")
