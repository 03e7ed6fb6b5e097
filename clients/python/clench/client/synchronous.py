"""A client whose calls return when the server has answered."""
import socket
import time
from collections import deque

from . import protocol
from .address import Address
from .common import CommonClient, CommonJob
from .entities import World, plain
from .errors import ConnectionLost, error_of


def _open(address, timeout):
    opened = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) if address.path else None
    try:
        if opened:
            opened.settimeout(timeout)
            opened.connect(address.path)
            return opened
        opened = socket.create_connection((address.host, address.port), timeout)
        opened.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return opened
    except OSError as problem:
        if opened:
            opened.close()
        raise ConnectionLost(f"no server at {address}: {problem}") from None


class Client(CommonClient):
    """A connection to a server: `world`, `call`, groups of methods such as `grasp`, `plan`, subscriptions."""

    is_asynchronous = False

    def __init__(self, address, timeout=None):
        self._timeout, self._buffer, self._number = timeout, bytearray(), 0
        self._notifications = deque()
        self._socket = _open(address, timeout)
        self.methods = {}
        try:
            self.version = self.call("hello", **protocol.hello_params(address.token))["version"]
            self.methods = {one["name"]: one["parameters"] for one in self.call("describe")}
        except BaseException:
            self.close()
            raise
        self.world = World(self)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._socket.close()

    def _read_line(self, last):
        while True:
            end = self._buffer.find(b"\n")
            if end >= 0:
                line = bytes(self._buffer[:end])
                del self._buffer[:end + 1]
                return line
            left = None if last is None else last - time.monotonic()
            if left is not None and left <= 0:
                raise TimeoutError("the server has not answered in time")
            try:
                self._socket.settimeout(left)
                received = self._socket.recv(1 << 16)
            except socket.timeout:
                raise TimeoutError("the server has not answered in time") from None
            except OSError as problem:
                raise ConnectionLost(f"the connection is lost: {problem}") from None
            if not received:
                raise ConnectionLost("the server has closed the connection")
            self._buffer += received

    def call(self, method, /, **params):
        """The result of a method. Errors are raised by their classes."""
        self._number += 1
        number = self._number
        request = protocol.encode(number, method, plain(params))
        last = None if self._timeout is None else time.monotonic() + self._timeout
        try:
            self._socket.settimeout(self._timeout)
            self._socket.sendall(request)
        except socket.timeout:
            self.close()  # part of the request may have been sent
            raise ConnectionLost("the server does not read") from None
        except OSError as problem:
            raise ConnectionLost(f"the connection is lost: {problem}") from None
        while True:
            message = protocol.decode(self._read_line(last))
            if "method" in message:
                self._notifications.append(message)
            elif message.get("id") == number:
                return protocol.result_of(message)
            elif message.get("id") is None:
                raise error_of(message.get("error", {}))
            # otherwise it is the answer to a call that has timed out

    def then(self, result, change):
        """`change` of the result of a call."""
        return change(result)

    def next_notification(self, timeout=None):
        """(method, params) of the next notification."""
        last = None if timeout is None else time.monotonic() + timeout
        while not self._notifications:
            message = protocol.decode(self._read_line(last))
            if "method" in message:
                self._notifications.append(message)
        message = self._notifications.popleft()
        return message["method"], message.get("params")

    def plan(self, planner, **options):
        """Starts a search in the background."""
        return Job(self, self.call("plan.start", planner=planner, options=options)["job"])


class Job(CommonJob):
    """A search in the background."""

    def result(self, timeout=None):
        """Waits until the search has ended, and returns its result."""
        last = None if timeout is None else time.monotonic() + timeout
        while self.state()["state"] not in self.ENDED:
            if last is not None and time.monotonic() > last:
                raise TimeoutError(f"job {self.number} has not ended yet")
            time.sleep(0.05)
        return self._client.call("job.result", job=self.number)


def connect(url=None, *, host=None, port=None, path=None, token=None, timeout=None):
    """Connects to a server; by default to `clench serve` on this machine, which keeps its token in a file of the user.

    url      as `clench serve` prints it, "tcp://127.0.0.1:4765/?token=..."; or host and port, or path
    timeout  for each answer [s]; without one, calls wait as long as the server works
    raises   ConnectionLost if there is no server, Unauthorized if the token is missing or wrong
    """
    return Client(Address(url, host, port, path, token), timeout)
