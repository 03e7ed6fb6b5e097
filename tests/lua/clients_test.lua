-- Clients in other languages with `clench serve`: their own tests, if the language is installed.
local test = require "test"

local function run(command)
  local pipe = assert(io.popen(command .. " 2>&1"))
  local text = pipe:read "a"
  local ok = pipe:close()
  return ok == true, text
end

-- this program in the form in which its clients start it
local program = run "readlink /proc/$PPID/exe" and select(2, run "readlink /proc/$PPID/exe"):gsub("%s+$", "")

test("the Python client passes its tests", function(t)
  if not run "python3 -c 'import asyncio, sys; sys.exit(sys.version_info < (3, 8))'" then t.skip "python3, of at least version 3.8, is not installed" end
  local ok, text = run("CLENCH='" .. program .. "' PYTHONDONTWRITEBYTECODE=1 python3 -W error::ResourceWarning clients/python/tests/client_test.py")
  t.ok(ok and text:find "\nOK\n" ~= nil, text)
end)

test("the Python client example of the guide runs as printed", function(t)
  if not run "python3 --version" then t.skip "python3 is not installed" end
  local page = io.open("docs/guide/server.md"):read "a"
  local blocks = {}
  for block in page:gmatch "```python\n(.-)```" do blocks[#blocks + 1] = block end
  t.equal(#blocks, 2)
  local path, url = test.path(), nil
  local server = io.popen(("echo $$; exec '%s' -q serve worlds/barrett_mug.wld --port 0 --token-file %s"):format(program, path .. ".token"))
  local process = server:read "l"
  server:read "l"
  url = server:read("l"):match "%S+$"
  local file = io.open(path, "w")
  file:write(blocks[1]:gsub("connect%(%)", ("connect(%q)"):format(url)), "\nimport asyncio\nasync def main():\n")
  for line in blocks[2]:gmatch "[^\n]+" do file:write("    ", (line:gsub("connect_async%(%)", ("connect_async(%q)"):format(url))), "\n") end
  file:write "asyncio.run(main())\nprint('finished')\n"
  file:close()
  local _, text = run("PYTHONPATH=clients/python PYTHONDONTWRITEBYTECODE=1 python3 " .. path)
  os.execute("kill " .. process)
  server:close()
  t.ok(text:find "\nfinished\n" ~= nil, text)
end)
