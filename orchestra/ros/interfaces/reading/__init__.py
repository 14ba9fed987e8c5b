"""Definitions of messages, services and actions as text: what they say, and where they are wrong.

What is read is what the rosidl parser makes of the same definition: its own classes, `rosidl_parser.definition`.
"""
