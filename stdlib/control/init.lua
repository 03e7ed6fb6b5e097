-- stdlib/control/init.lua
--- Control by other programs: a server that executes their commands.
return require "clench.lazy"("control", {"server"})
