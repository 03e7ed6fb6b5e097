--- A table whose field `thread` is the running coroutine of `clench.loop`; nil outside of its coroutines.
return {}
