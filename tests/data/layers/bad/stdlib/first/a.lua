local b = require "clench.second.b"
return b
