--- Is this the name or an address of the machine itself, as its programs see it?
return function(host) return host == "localhost" or host == "::1" or host:find "^127%.%d+%.%d+%.%d+$" ~= nil end
