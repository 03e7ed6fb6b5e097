-- stdlib/port/init.lua
--- Ports: streams of bytes to devices and programs. Reads and writes wait in `clench.loop`: in a function of `loop.spawn`, other coroutines
--- run meanwhile, elsewhere the loop runs.
return require "clench.lazy"("port", {"serial", "connect", "listen", "pty", "pair", "replay"})
