"""Addresses and tokens of servers."""
import os
from urllib.parse import parse_qs, urlsplit

DEFAULT_PORT = 4765


def _stored_token(name):
    # where `clench serve` keeps it
    folder, home = os.environ.get("XDG_RUNTIME_DIR"), os.environ.get("HOME")
    path = f"{folder}/clench-{name}.token" if folder else f"{home}/.clench-{name}.token" if home else None
    if path is None or not os.path.exists(path):
        return None
    with open(path, encoding="ascii") as file:
        return file.read().strip()


class Address:
    """Address of a TCP server (`host`, `port`) or a Unix socket (`path`), and the token of the server."""

    def __init__(self, url=None, host=None, port=None, path=None, token=None):
        if url is not None:
            if host is not None or port is not None or path is not None:
                raise ValueError("expected either a URL, or host and port, or a path")
            parts = urlsplit(url)
            if parts.scheme == "tcp" and parts.hostname and parts.port:
                host, port = parts.hostname, parts.port
            elif parts.scheme == "unix" and parts.path.rstrip("/"):
                path = parts.path.rstrip("/")
            else:
                raise ValueError(f"expected a URL such as tcp://127.0.0.1:4765/?token=..., got {url!r}")
            token = token or parse_qs(parts.query).get("token", [None])[0]
        if path is not None and (host is not None or port is not None):
            raise ValueError("expected either a path, or host and port")
        self.path = path
        self.host = host or "127.0.0.1"
        self.port = DEFAULT_PORT if port is None else port
        self.token = token or _stored_token("socket" if path else self.port)

    def __str__(self):
        return self.path or f"{self.host}:{self.port}"
