"""The parameters that well-known nodes declare: a row for each kind of value, names apart by blanks.

`sized` are patterns of names with a type and with a number of items, None for any. Source: the nodes' own code, where
every row is of one type from Humble to Jazzy.
"""

from __future__ import annotations

from typing import Final

from orchestra.dataclass import dataclass
from orchestra.declared.model import RosType
from orchestra.fields import replace


@dataclass(frozen=True, slots=True)
class Known:
    """What one node declares; below `groups` may be anything.

    `only_where` are patterns of names that the node declares only where the first group, or else the second item, is a
    parameter that is given, and not false: of others it reads nothing.
    """

    truths: tuple[str, ...] = ()
    integers: tuple[str, ...] = ()
    doubles: tuple[str, ...] = ()
    texts: tuple[str, ...] = ()
    lists: tuple[str, ...] = ()
    sized: tuple[tuple[str, RosType, int | None], ...] = ()
    groups: tuple[str, ...] = ()
    only_where: tuple[tuple[str, str | None], ...] = ()


def _names(text: str) -> tuple[str, ...]:
    return tuple(text.split())


_LIFECYCLE: Final = _names("bond_heartbeat_period")
_FILTER: Final = Known(
    truths=_names(
        """debug disabled_at_startup dynamic_process_noise_covariance permit_corrected_publication
        predict_to_current_time print_diagnostics publish_acceleration publish_tf reset_on_time_jump
        smooth_lagged_data stamped_control two_d_mode use_control"""
    ),
    doubles=_names(
        """control_timeout frequency gravitational_acceleration history_length sensor_timeout
        transform_time_offset transform_timeout"""
    ),
    texts=_names(
        """base_link_frame base_link_frame_output debug_out_file map_frame odom_frame tf_prefix
        world_frame"""
    ),
    sized=(
        (r"^(?:imu|odom|pose|twist)\d+$", "string", None),
        (r"^(?:imu|odom|pose|twist)\d+_config$", "bool_array", 15),
        (r"^(?:imu|odom|pose|twist)\d+_queue_size$", "integer", None),
        (r"^(?:imu|odom|pose|twist)\d+_(?:differential|relative)$", "bool", None),
        (r"^odom\d+_pose_use_child_frame$", "bool", None),
        (r"^imu\d+_remove_gravitational_acceleration$", "bool", None),
        (r"^(?:imu|odom)\d+_(?:pose|twist)_rejection_threshold$", "double", None),
        (r"^imu\d+_linear_acceleration_rejection_threshold$", "double", None),
        (r"^(?:pose|twist)\d+_rejection_threshold$", "double", None),
        (r"^control_config$", "bool_array", 6),
        (r"^(?:acceleration|deceleration)_(?:gains|limits)$", "double_array", 6),
        (r"^initial_state$", "double_array", 15),
        (r"^(?:initial_estimate|process_noise)_covariance$", "double_array", None),
    ),
    only_where=(
        (r"^((?:imu|odom|pose|twist)\d+)_", None),
        (r"^(?:control_config|(?:acceleration|deceleration)_(?:gains|limits))$", "use_control"),
        (r"^debug_out_file$", "debug"),
    ),
)
_UNSCENTED: Final = replace(_FILTER, doubles=(*_FILTER.doubles, "alpha", "beta", "kappa"))
_NAVSAT: Final = Known(
    truths=_names(
        """broadcast_cartesian_transform broadcast_cartesian_transform_as_parent_frame broadcast_utm_transform
        broadcast_utm_transform_as_parent_frame publish_filtered_gps use_local_cartesian use_odometry_yaw
        wait_for_datum zero_altitude"""
    ),
    doubles=_names("delay frequency magnetic_declination_radians transform_timeout yaw_offset"),
)
_AMCL: Final = Known(
    truths=_names(
        """always_reset_initial_pose do_beamskip first_map_only freespace_downsampling set_initial_pose
        tf_broadcast"""
    ),
    integers=_names("max_beams max_particles min_particles resample_interval"),
    doubles=_names(
        """alpha1 alpha2 alpha3 alpha4 alpha5 beam_skip_distance beam_skip_error_threshold beam_skip_threshold
        initial_pose.x initial_pose.y initial_pose.yaw initial_pose.z lambda_short laser_likelihood_max_dist
        laser_max_range laser_min_range pf_err pf_z recovery_alpha_fast recovery_alpha_slow save_pose_rate sigma_hit
        transform_tolerance update_min_a update_min_d z_hit z_max z_rand z_short"""
    )
    + _LIFECYCLE,
    texts=_names(
        """base_frame_id global_frame_id laser_model_type map_topic odom_frame_id robot_model_type scan_topic"""
    ),
)
_LIFECYCLE_MANAGER: Final = Known(
    truths=_names("attempt_respawn_reconnection autostart"),
    doubles=_names("bond_respawn_max_duration bond_timeout"),
    lists=_names("node_names"),
)
_MAP_SERVER: Final = Known(texts=_names("frame_id topic_name yaml_filename"), doubles=_LIFECYCLE)
_JOY: Final = Known(
    truths=_names("sticky_buttons"),
    integers=_names("coalesce_interval_ms device_id"),
    doubles=_names("autorepeat_rate deadzone"),
    texts=_names("device_name"),
)
_TELEOP: Final = Known(
    truths=_names("inverted_reverse publish_stamped_twist require_enable_button"),
    integers=_names(
        """axis_angular.pitch axis_angular.roll axis_angular.yaw axis_linear.x axis_linear.y axis_linear.z
        enable_button enable_turbo_button"""
    ),
    doubles=_names(
        """scale_angular.pitch scale_angular.roll scale_angular.yaw scale_angular_turbo.pitch
        scale_angular_turbo.roll scale_angular_turbo.yaw scale_linear.x scale_linear.y scale_linear.z
        scale_linear_turbo.x scale_linear_turbo.y scale_linear_turbo.z"""
    ),
    texts=_names("frame"),
)
_STATE_PUBLISHER: Final = Known(
    truths=_names("ignore_timestamp"),
    doubles=_names("publish_frequency"),
    texts=_names("frame_prefix robot_description"),
)

# By package, and executable or class.
NODES: Final[dict[tuple[str, str], Known]] = {
    ("joy", "joy_node"): _JOY,
    ("joy", "joy::Joy"): _JOY,
    ("nav2_amcl", "amcl"): _AMCL,
    ("nav2_amcl", "nav2_amcl::AmclNode"): _AMCL,
    ("nav2_lifecycle_manager", "lifecycle_manager"): _LIFECYCLE_MANAGER,
    ("nav2_lifecycle_manager", "nav2_lifecycle_manager::LifecycleManager"): _LIFECYCLE_MANAGER,
    ("nav2_map_server", "map_server"): _MAP_SERVER,
    ("nav2_map_server", "nav2_map_server::MapServer"): _MAP_SERVER,
    ("robot_localization", "ekf_node"): _FILTER,
    ("robot_localization", "navsat_transform_node"): _NAVSAT,
    ("robot_localization", "ukf_node"): _UNSCENTED,
    ("robot_state_publisher", "robot_state_publisher"): _STATE_PUBLISHER,
    ("robot_state_publisher", "robot_state_publisher::RobotStatePublisher"): _STATE_PUBLISHER,
    ("teleop_twist_joy", "teleop_node"): _TELEOP,
    ("teleop_twist_joy", "teleop_twist_joy::TeleopTwistJoy"): _TELEOP,
}
