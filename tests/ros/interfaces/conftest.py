from __future__ import annotations

import warnings

with warnings.catch_warnings():
    # The parser that comes with the message classes uses modules that Python has deprecated.
    warnings.simplefilter("ignore", DeprecationWarning)
    import rosidl_generator_py  # type: ignore[import-untyped]  # noqa: F401  # untyped as every ROS package
