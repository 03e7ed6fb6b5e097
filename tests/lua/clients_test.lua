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

-- `clench serve` in the background: calls use(url, port, process)
local function with_server(use)
  local path = test.path()
  local server = io.popen(("echo $$; exec '%s' -q serve worlds/barrett_mug.wld --port 0 --token-file %s"):format(program, path .. ".token"))
  local process = server:read "l"
  server:read "l"
  local url = server:read("l"):match "%S+$"
  local ok, problem = pcall(use, url, url:match ":(%d+)/", process)
  os.execute("kill " .. process .. " 2>/dev/null")
  server:close()
  if not ok then error(problem, 0) end
end

-- the blocks of a language on the page
local function blocks_of(language)
  local blocks, file <close> = {}, assert(io.open "docs/guide/server.md")
  for block in file:read("a"):gmatch("```" .. language .. "\n(.-)```") do blocks[#blocks + 1] = block end
  return blocks
end

test("the Python client example of the guide runs as printed", function(t)
  if not run "python3 --version" then t.skip "python3 is not installed" end
  local blocks, path = blocks_of "python", test.path()
  t.equal(#blocks, 2)
  with_server(function(url)
    local file = io.open(path, "w")
    file:write(blocks[1]:gsub("connect%(%)", ("connect(%q)"):format(url)), "\nimport asyncio\nasync def main():\n")
    for line in blocks[2]:gmatch "[^\n]+" do file:write("    ", (line:gsub("connect_async%(%)", ("connect_async(%q)"):format(url))), "\n") end
    file:write "asyncio.run(main())\nprint('finished')\n"
    file:close()
    local _, text = run("PYTHONPATH=clients/python PYTHONDONTWRITEBYTECODE=1 python3 " .. path)
    t.ok(text:find "\nfinished\n" ~= nil, text)
  end)
end)

local octave = "timeout -s KILL 120 octave-cli --no-gui -q --no-history --eval "
local function need_octave(t)
  if not run "octave-cli --version" then t.skip "Octave is not installed (octave, octave-instrument-control)" end
end

test("the MATLAB clients pass their tests in Octave", function(t)
  need_octave(t)
  with_server(function(url, _, process)
    local _, text = run(("CLENCH_URL='%s' CLENCH_PROCESS=%s %s'addpath clients/matlab/tests; client_test'"):format(url, process, octave))
    t.ok(text:find "passed by bash\n" ~= nil, text)
    t.ok(text:find "passed at the end of the server\n" ~= nil, text)
    local has_tcpclient = run(octave .. "'pkg load instrument-control'")
    if has_tcpclient then t.ok(text:find "passed by tcpclient\n" ~= nil, text) end
  end)
end)

test("the MATLAB example of the guide runs in Octave as printed", function(t)
  need_octave(t)
  local blocks, path = blocks_of "matlab", test.path()
  t.equal(#blocks, 2)
  with_server(function(url, port)
    local file = io.open(path, "w")
    file:write("addpath clients/matlab\n", (blocks[1]:gsub("ClenchClient%(%)", ("ClenchClient('%s')"):format(url))))
    file:write(("graspitServer('open', '127.0.0.1', %s)\n"):format(port), blocks[2], "disp('finished')\n")
    file:close()
    local _, text = run(octave .. ("'source %s'"):format(path))
    t.ok(text:find "finished\n" ~= nil, text)
  end)
end)
