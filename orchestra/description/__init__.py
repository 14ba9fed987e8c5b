"""What a user may write, as frozen models without behaviour."""
