-- stdlib/control/init.lua
--- Control from outside: a server that other programs command.
return require "clench.lazy"("control", {"server"})
