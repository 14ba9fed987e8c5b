"""A program: looks up HOST PORT and writes the addresses as JSON, as pairs of family and address."""

import json
import socket
import sys


def main() -> int:
    """Return 0 where there is an address, else write why not."""
    host, port = sys.argv[1:]
    try:
        found = socket.getaddrinfo(host, int(port), type=socket.SOCK_STREAM)
    except (OSError, UnicodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        sys.stderr.write(f"{host}: {reason}\n")
        return 1
    sys.stdout.write(json.dumps([(family, address) for family, _, _, _, address in found]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
