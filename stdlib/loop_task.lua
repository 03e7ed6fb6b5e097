--- The coroutine of `clench.loop` that runs, as the field `thread`; nil outside of them.
return {}
