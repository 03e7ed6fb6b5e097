"""Errors reported by a server, one class per code."""


class ClenchError(Exception):
    """An error that a server has reported: `code`, and `kind` as of errors in Lua ("input", "limit", ...)."""

    def __init__(self, message, code=None, data=None):
        super().__init__(message)
        self.code = code
        self.data = data
        self.kind = data.get("kind") if isinstance(data, dict) else None


class ParseError(ClenchError):
    """The line was not valid JSON."""


class InvalidRequest(ClenchError):
    """The message was not a valid request."""


class MethodNotFound(ClenchError):
    """The server has no such method."""


class InvalidParams(ClenchError):
    """Arguments are missing, unknown, of a wrong type or out of range."""


class InternalError(ClenchError):
    """A fault of the server."""


class Failed(ClenchError):
    """The request was valid, but could not be executed."""


class Unauthorized(ClenchError):
    """The token is missing or wrong."""


class Refused(ClenchError):
    """The server does not allow the request, or it exceeds one of its limits."""


class ConnectionLost(ClenchError):
    """There is no connection: the server has closed it, or cannot be reached."""


_classes = {-32700: ParseError, -32600: InvalidRequest, -32601: MethodNotFound, -32602: InvalidParams,
            -32603: InternalError, -32000: Failed, -32001: Unauthorized, -32002: Refused}


def error_of(value):
    """The exception for the field `error` of a response."""
    code = value.get("code")
    return _classes.get(code, ClenchError)(value.get("message", "unknown error"), code, value.get("data"))
