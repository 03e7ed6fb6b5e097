"""A client whose calls are awaited, several at a time."""
import asyncio

from . import protocol
from .address import Address
from .common import CommonClient, CommonJob
from .entities import World, plain
from .errors import ClenchError, ConnectionLost, error_of

MAX_LINE = 1 << 28  # [bytes]


class AsyncClient(CommonClient):
    """As Client; fields and calls are awaited."""

    is_asynchronous = True

    def __init__(self, reader, writer, timeout=None):
        self._reader, self._writer, self._timeout = reader, writer, timeout
        self._number, self._waiting, self._notifications = 0, {}, asyncio.Queue()
        self._problem = None
        self.methods, self.version, self.world = {}, None, World(self)
        self._task = asyncio.ensure_future(self._read())

    async def __aenter__(self):
        return self

    async def __aexit__(self, *_):
        await self.close()

    async def close(self):
        self._task.cancel()
        self._end(ConnectionLost("the client is closed"))
        self._writer.close()
        try:
            await self._writer.wait_closed()
        except OSError:
            pass  # the connection is already lost

    def _end(self, problem):
        self._problem = self._problem or problem
        for waiting in self._waiting.values():
            if not waiting.done():
                waiting.set_exception(problem)
        self._waiting.clear()
        self._notifications.put_nowait(None)

    def _take(self, message):
        if "method" in message:
            self._notifications.put_nowait(message)
        elif message.get("id") is None:
            raise error_of(message.get("error", {}))
        else:
            waiting = self._waiting.pop(message["id"], None)
            if waiting and not waiting.done():
                waiting.set_result(message)

    async def _read(self):
        try:
            while True:
                line = await self._reader.readline()
                if not line.endswith(b"\n"):
                    return self._end(ConnectionLost("the server has closed the connection"))
                self._take(protocol.decode(line))
        except (OSError, ValueError) as problem:
            self._end(ConnectionLost(f"the connection is lost: {problem}"))
        except ClenchError as problem:
            self._end(problem)

    async def call(self, method, /, **params):
        """The result of a method. Errors are raised by their classes."""
        if self._problem:
            raise self._problem
        self._number += 1
        number = self._number
        request = protocol.encode(number, method, plain(params))
        waiting = asyncio.get_running_loop().create_future()
        self._waiting[number] = waiting
        try:
            self._writer.write(request)
            message = await asyncio.wait_for(waiting, self._timeout)
        except asyncio.TimeoutError:
            raise TimeoutError("the server has not answered in time") from None
        finally:
            self._waiting.pop(number, None)
        return protocol.result_of(message)

    async def then(self, result, change):
        """`change` of the result of a call."""
        return change(await result)

    async def next_notification(self):
        """(method, params) of the next notification."""
        message = await self._notifications.get()
        if message is None:
            self._notifications.put_nowait(None)  # for other waiting coroutines
            raise self._problem
        return message["method"], message.get("params")

    async def plan(self, planner, **options):
        """Starts a search in the background."""
        return AsyncJob(self, (await self.call("plan.start", planner=planner, options=options))["job"])


class AsyncJob(CommonJob):
    """A search in the background; its methods are awaited."""

    async def result(self):
        """Waits until the search has ended, and returns its result."""
        while (await self.state())["state"] not in self.ENDED:
            await asyncio.sleep(0.05)
        return await self._client.call("job.result", job=self.number)


async def connect_async(url=None, *, host=None, port=None, path=None, token=None, timeout=None):
    """As connect; the client is closed by `await client.close()` or at the end of `async with`."""
    address = Address(url, host, port, path, token)
    try:
        if address.path:
            streams = await asyncio.open_unix_connection(address.path, limit=MAX_LINE)
        else:
            streams = await asyncio.open_connection(address.host, address.port, limit=MAX_LINE)
    except OSError as problem:
        raise ConnectionLost(f"no server at {address}: {problem}") from None
    client = AsyncClient(*streams, timeout)
    try:
        client.version = (await client.call("hello", **protocol.hello_params(address.token)))["version"]
        client.methods = {one["name"]: one["parameters"] for one in await client.call("describe")}
    except BaseException:
        await client.close()
        raise
    return client
