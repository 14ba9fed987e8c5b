"""What a container answers with where it does not do as it is asked."""


class RefusalError(Exception):
    """The text is the answer."""
