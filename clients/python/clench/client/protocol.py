"""JSON-RPC 2.0, one message per line, without any input or output."""
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
        raise ClenchError(f"the server has sent what is no message: {line[:60]!r}")
    return message


def result_of(message):
    """The result of a response; its error is raised."""
    if "error" in message:
        raise error_of(message["error"])
    return message.get("result")


def hello_params(token):
    params = {"client": "python"}
    if token is not None:
        params["token"] = token
    return params
