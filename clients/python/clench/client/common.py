"""Methods that both clients and their jobs share. An asynchronous client returns what they return as awaitables."""
from .entities import Group, arguments


class CommonClient:
    """Methods by the names of the server, for a client with `call` and `methods`."""

    def __getattr__(self, name):
        if name.startswith("_") or not any(method.startswith(name + ".") for method in self.methods):
            raise AttributeError(f"a client has no {name}, nor has its server methods of that group")
        return Group(self, name)

    def call_by_name(self, method, args, kwargs):
        return self.call(method, **arguments(method, self.methods[method], args, kwargs))

    def subscribe(self, event):
        """Notifications of an event from now on; returns a number for `unsubscribe`."""
        return self.call("subscribe", event=event)

    def subscribe_state(self, rate):
        """Notifications with the latest state, at most `rate` per second; returns a number for `unsubscribe`."""
        return self.call("subscribe_state", rate=rate)


class CommonJob:
    """A search in the background, by its number."""

    ENDED = ("done", "failed", "stopped")

    def __init__(self, client, number):
        self._client, self.number = client, number

    def state(self):
        return self._client.call("job.state", job=self.number)

    def stop(self):
        return self._client.call("job.stop", job=self.number)

    def pause(self):
        return self._client.call("job.pause", job=self.number)

    def resume(self):
        return self._client.call("job.resume", job=self.number)
