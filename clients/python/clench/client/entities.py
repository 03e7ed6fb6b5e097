"""Worlds, robots and bodies by the names of the Lua API.

A field is read from the server whenever it is used. Methods are those of the server: `hand.autograsp(speed=1)` is
`grasp.autograsp` with `hand`. With an asynchronous client, fields and calls are awaited.
"""
# fields that can be set: the command, its parameter for the address, and that for the value
_setters = {"dofs": ("grasp.dofs", "hand", "dofs"), "pose": ("body.move", "body", "pose"),
            "mass": ("body.mass", "body", "mass"), "material": ("body.material", "body", "material")}
# names of fields, even if there is a command of the same name
_fields = set(_setters) | {"contacts"}


def arguments(method, parameters, args, kwargs):
    """Positional and keyword arguments of a method, by name. None counts as not given."""
    names = [parameter["name"] for parameter in parameters]
    if len(args) > len(names):
        raise TypeError(f"{method} takes at most {len(names)} arguments ({', '.join(names)}), got {len(args)}")
    out = {name: plain(value) for name, value in zip(names, args)}
    for name, value in kwargs.items():
        if name in out:
            raise TypeError(f"{method}: {name} is given twice")
        out[name] = plain(value)
    return {name: value for name, value in out.items() if value is not None}


def plain(value):
    """Converts bodies and robots to their addresses, and arrays to lists."""
    if isinstance(value, Entity):
        return value.address
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    return value.tolist() if hasattr(value, "tolist") else value


class Group:
    """Methods that begin with the same words: `c.grasp.autograsp(hand="barrett")`."""

    def __init__(self, client, prefix):
        self._client, self._prefix = client, prefix

    def __getattr__(self, name):
        method = f"{self._prefix}.{name}"
        if method not in self._client.methods:
            raise AttributeError(f"the server has no method {method}")
        return lambda *args, **kwargs: self._client.call_by_name(method, args, kwargs)


class Entity:
    """A world, robot or body, named by its address."""

    _groups = ()  # groups of its methods, each with the parameter for the address

    def __init__(self, client, address):
        self.__dict__.update(_client=client, address=address)

    def __repr__(self):
        return f"<{type(self).__name__.lower()} {self.address!r}>"

    def get(self, *names):
        """Fields as a dict, in one call."""
        return self._client.call("get", of=self.address, fields=list(names))

    def set(self, **fields):
        """Sets one field by its command, which can be undone."""
        if len(fields) != 1:
            raise TypeError("set: expected one field")
        (name, value), = fields.items()
        if name not in _setters or not self.address:
            raise AttributeError(f"{name} of {self!r} cannot be set")
        method, of, parameter = _setters[name]
        return self._client.call(method, **{of: self.address, parameter: plain(value)})

    def __setattr__(self, name, value):
        if self._client.is_asynchronous:
            raise AttributeError(f"a field of an asynchronous client is set by: await entity.set({name}=...)")
        self.set(**{name: value})

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        method, of = self._method(name)
        if method is None:
            return self._client.then(self.get(name), lambda found: found[name])

        def call(*args, **kwargs):
            parameters = [p for p in self._client.methods[method] if p["name"] != of]
            given = arguments(method, parameters, args, kwargs)
            if of is not None:
                given[of] = self.address
            return self._client.call(method, **given)

        return call

    def _method(self, name):
        for group, of in self._groups:
            parameters = self._client.methods.get(f"{group}.{name}")
            if parameters is None or name in _fields:
                continue
            if of is None or any(parameter["name"] == of for parameter in parameters):
                return f"{group}.{name}", of
        return None, None


class Body(Entity):
    _groups = (("body", "body"), ("body", "a"))


class Robot(Entity):
    _groups = (("robot", "robot"), ("grasp", "hand"), ("body", "body"), ("body", "a"))

    def link(self, name):
        return Body(self._client, f"{self.address}/{escaped(name)}")


class World(Entity):
    _groups = (("world", None), ("dynamics", None))

    def __init__(self, client):
        super().__init__(client, "")

    def robot(self, name):
        return Robot(self._client, escaped(name))

    def body(self, address):
        """A body by its name, or a link by its address, "barrett/chain0_link2"."""
        return Body(self._client, address)


def escaped(name):
    """A name as a part of an address."""
    return name.replace("/", "\\/")
