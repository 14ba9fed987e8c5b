"""Signs that a process is ready and alive."""
