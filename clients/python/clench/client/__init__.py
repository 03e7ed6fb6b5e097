"""Client of a Clench server (`clench serve`), with the names of the Lua API.

    import clench.client
    with clench.client.connect() as c:
        hand = c.world.robot("barrett")
        hand.autograsp()
        print(hand.dofs, hand.quality())

`connect_async` returns a client whose calls are awaited. The package needs only the standard library.
"""
from .asynchronous import AsyncClient, AsyncJob, connect_async
from .errors import (ClenchError, ConnectionLost, Failed, InternalError, InvalidParams, InvalidRequest,
                     MethodNotFound, ParseError, Refused, Unauthorized)
from .synchronous import Client, Job, connect

__all__ = ["connect", "connect_async", "Client", "AsyncClient", "Job", "AsyncJob", "ClenchError", "ConnectionLost",
           "Failed", "InternalError", "InvalidParams", "InvalidRequest", "MethodNotFound", "ParseError", "Refused",
           "Unauthorized"]
