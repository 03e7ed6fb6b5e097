"""Messages of JSON-RPC 2.0, one per line: conversion to and from bytes."""
import json

from .errors import ClenchError, error_of


def encode(number, method, params):
    """A request as bytes."""
    message = {"jsonrpc": "2.0", "id": number, "method": method}
    if params:
        message["params"] = params
    try:
        return json.dumps(message, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode() + b"\n"
    except (TypeError, ValueError) as problem:
        raise TypeError(f"{method}: arguments cannot be sent: {problem}") from None


def decode(line):
    """The message of a line."""
    try:
        message = json.loads(line)
    except ValueError:
        message = None
    if not isinstance(message, dict):
        raise ClenchError(f"the server has sent a line that is not a message: {line[:60]!r}")
    return message


def result_of(message):
    """The result of a response. An error is raised as its exception."""
    if "error" in message:
        raise error_of(message["error"])
    return message.get("result")


def hello_params(token):
    """Parameters of the first request, which identifies the client."""
    params = {"client": "python"}
    if token is not None:
        params["token"] = token
    return params
