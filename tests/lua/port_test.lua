-- Ports: serial lines, sockets, pseudo-terminals; their ends are results, and a slow one does not block others.
local test, clench = require "test", require "clench"
local loop, port = clench.loop, clench.port

-- runs functions as coroutines of the loop until all have ended
local function together(...)
  local tasks = {}
  for i, f in ipairs {...} do tasks[i] = loop.spawn(f) end
  for _, task in ipairs(tasks) do
    local last = loop.time() + 20
    while task.status ~= "done" and loop.time() < last do loop.run(0.01) end
    assert(task.status == "done", task.status)
  end
end

test("bytes are read by count, by line, up to a delimiter, or as they arrive", function(t)
  local a, b = port.pair()
  t.equal(a:write("abc\nde\r\n\n=> f=> \0\255"), true)
  t.equal(b:read(2, 1), "ab")
  t.equal(b:read_line(1), "c")
  t.equal(b:read_line(1), "de")
  t.equal(b:read_line(1), "")
  t.equal(b:read_until("=> ", 1), "")
  t.equal(b:read_until("=> ", 1), "f")
  t.equal({b:read(3, 0)}, {nil, "timeout"})
  t.equal(b:read_some(0), "\0\255")
  t.equal({b:read_some(0)}, {nil, "timeout"})
  a:write "rest"
  t.equal(b:discard(), "rest")
  a:write "unfinished"
  a:close()
  t.equal({b:read_line(1)}, {nil, "closed"})
  t.equal(b:read_some(1), "unfinished")
  t.equal({b:read_some(1)}, {nil, "closed"})
  t.equal({b:write "x"}, {nil, "closed"})
  t.equal({b:send "x"}, {nil, "closed"})
  t.ok(not b:is_open())
end)

test("in coroutines a read lets others run, and outside of them it runs the loop", function(t)
  local a, b = port.pair()
  local order = {}
  together(function()
    local line = b:read_line()
    order[#order + 1] = line
  end, function()
    for _ = 1, 3 do
      loop.sleep(0.005)
      order[#order + 1] = "other"
    end
    a:write "line\n"
  end)
  t.equal(order, {"other", "other", "other", "line"})
  loop.after(0.02, function() a:send "late\n" end)
  t.equal(b:read_line(5), "late")
  local began = loop.time()
  t.equal({b:read_line(0.03)}, {nil, "timeout"})
  t.ok(loop.time() - began >= 0.03)
end)

test("closing wakes all waiting coroutines", function(t)
  local a, b = port.pair()
  local c = port.pair()
  local listener = port.listen {}
  local said = {}
  together(function() said.read = {c:read(1)} end, function() said.accept = {listener:accept()} end, function()
    said.write = {a:write(("x"):rep(10000000))}
  end, function()
    loop.sleep(0.02)
    b:close()
    c:close()
    listener:close()
  end)
  t.equal(said, {read = {nil, "closed"}, accept = {nil, "closed"}, write = {nil, "closed"}})
  t.ok(not b:is_open() and not listener:is_open())
end)

test("a long message is sent while others continue, and arrives complete and in order", function(t)
  local a, b = port.pair()
  local long, got, ticks = ("0123456789"):rep(500000), nil, 0
  together(function() t.equal(a:write(long), true) t.equal(a:write "end\n", true) end, function()
    for _ = 1, 5 do loop.sleep(0.002) ticks = ticks + 1 end
    got = b:read(#long, 10)
    t.equal(b:read_line(1), "end")
  end)
  t.ok(got == long)
  t.equal(ticks, 5)
  -- without waiting
  a.max_queue = 10000000
  t.equal(a:send(long), true)
  t.equal(a:send "tail\n", true)
  t.ok(b:read(#long, 10) == long)
  t.equal(b:read_line(5), "tail")
  t.equal(a:drain(1), true)
end)

test("the length of a queue is limited, and so is that of a line", function(t)
  local a, b = port.pair()
  a.max_queue = 1000000
  local taken = 0
  while a:send(("x"):rep(100000)) do taken = taken + 1 end
  t.equal({a:send "xx"}, {true})
  t.equal({a:send(("x"):rep(100000))}, {nil, "full"})
  t.equal({a:write(("x"):rep(100000), 0.02)}, {nil, "timeout"})
  t.equal(#b:read(taken * 100000 + 2, 5), taken * 100000 + 2)
  b.max_line = 100
  a:write(("y"):rep(100) .. "\nshort\n")
  t.equal(b:read_line(1), ("y"):rep(100))
  t.equal(b:read_line(1), "short")
  a:write(("y"):rep(101) .. "\nshort\n")
  t.equal({b:read_line(1)}, {nil, "too long"})
  t.equal(b:read_line(1), "short")
  -- the end of the line comes later
  a:write(("y"):rep(300))
  t.equal({b:read_line(1)}, {nil, "too long"})
  t.equal({b:read_line(0)}, {nil, "timeout"})
  a:write(("y"):rep(300))
  t.equal({b:read_line(0)}, {nil, "timeout"})
  a:write "yy\nshort\n"
  t.equal(b:read_line(1), "short")
  t.equal(b:discard(), "")
end)

test("clients and servers connect by TCP and by a Unix socket", function(t)
  local path = os.tmpname()
  os.remove(path)
  for _, options in ipairs {{}, {host = "localhost"}, {path = path}} do
    local listener <close> = port.listen(options)
    local function talk(client)
      local server = listener:accept(5)
      client:write "ask\n"
      t.equal(server:read_line(5), "ask")
      server:write "answer\n"
      server:close()
      t.equal(client:read_line(5), "answer")
      t.equal({client:read_line(5)}, {nil, "closed"})
    end
    for _ = 1, 2 do talk(options.path and port.connect(path) or port.connect("127.0.0.1", listener.port)) end
    if not options.path then talk(port.connect("localhost", listener.port, 5)) end
  end
  t.fails(function() port.connect(path) end, "clench.port.connect: ", "No such file or directory")
end)

test("a terminal's clients connect and disconnect, and unplugging it is a result", function(t)
  local device = port.pty()
  for i = 1, 3 do
    local line <close> = port.serial {path = device.path, baud = 38400}
    t.fails(function() port.serial {path = device.path} end, "another process uses this serial line")
    line:write("G" .. i)
    t.equal(device:read(2, 1), "G" .. i)
    device:write "\0\1\13\10\17\19\255"
    t.equal(line:read(7, 1), "\0\1\13\10\17\19\255")
  end
  local line = port.serial {path = device.path}
  local why
  together(function() why = {line:read(1, 5)} end, function() loop.sleep(0.01) device:close() end)
  t.equal(why, {nil, "unplugged"})
  t.equal({line:write "x"}, {nil, "unplugged"})
  t.fails(function() port.serial {path = device.path} end, "No such file or directory")
end)

test("a recording is replayed with the same bytes, in the same order and no faster", function(t)
  local path = os.tmpname()
  local a, b = port.pair()
  a:record(path)
  a:write "who\n"
  b:write "I am "
  t.equal(a:read(5, 1), "I am ")
  loop.sleep(0.05)
  b:write "\0\200\n"
  t.equal(a:read_line(1), "\0\200")
  a:write "bye\n"
  a:close()
  for _, speed in ipairs {1, math.huge} do
    local device = port.replay(path, {speed = speed})
    t.equal({device:read_some(0.01)}, {nil, "timeout"})  -- it only answers
    device:write "wh"
    device:write "o\n"
    local began = loop.time()
    t.equal(device:read_line(1), "I am \0\200")
    t.ok((loop.time() - began >= 0.045) == (speed == 1), loop.time() - began)
    t.equal({device:read(1, 0)}, {nil, "timeout"})
    t.fails(function() device:write "bie\n" end, "has 'bye?' here, got 'bie?'")
    device:write "bye\n"
    t.equal({device:read(1, 1)}, {nil, "closed"})
  end
  local device = port.replay(path)
  device:close()
  loop.run()
  for _, text in ipairs {"", "clench port recording 1\n0.1 < 0\n", "clench port recording 1\n0.1 = 00\n", "clench port recording 1\n0.2 < 00\n0.1 < 00\n"} do
    clench.files.save_text(path, text)
    t.fails(function() port.replay(path) end, path, text:find "0.2" and "before that of the line above" or "expected")
  end
  os.remove(path)
end)

test("arguments of ports are checked", function(t)
  local a, b = port.pair()
  t.fails(function() a:read(0) end, "port:read: count: expected an integer from 1 to 67108864, got 0")
  t.fails(function() a:read(1, -1) end, "port:read: seconds: expected a time >= 0, got -1")
  t.fails(function() a:write(5) end, "port:write: bytes: expected a string, got 5")
  t.fails(function() a:read_until("", 1) end, "port:read_until: delimiter: expected a string, got ''")
  t.fails(function() a.read_line() end, "port:read_line: expected a port before the colon")
  t.fails(function() port.serial {path = "/dev/ttyS0", bauds = 3} end, "unknown key 'bauds'", "did you mean 'baud'?")
  t.fails(function() port.serial {} end, "path: expected a string, got nil")
  t.fails(function() port.listen {port = 70000} end, "port: expected an integer from 0 to 65535, got 70000")
  t.fails(function() port.listen {path = "x", port = 1} end, "expected either a path or host and port")
  t.fails(function() port.connect("127.0.0.1", 0) end, "port: expected an integer from 1 to 65535, got 0")
  t.fails(function() port.connect("no host", 1) end, "expected a name or an address")
  t.fails(function() port.serail {} end, "there is no 'serail'")
  loop.spawn(function() b:read_line() end)
  loop.run(0)
  t.fails(function() b:read_line(0) end, "another coroutine reads from pair")
  b:close()
  loop.run()
end)

test("methods of ports and listeners reject invalid arguments in one sentence", function(t)
  local a = port.pair()
  local listener = port.listen {}
  a:close()
  listener:close()
  local junk = {{}, {5}, {-1}, {0 / 0}, {"x"}, {""}, {true}, {{}}, {print}, {a}, {nil, 5}, {5, -1}, {"x", "y"}, {5, math.huge}}
  local faults = {}
  for _, value in ipairs {a, listener} do
    for name, method in pairs(debug.getmetatable(value).__index) do
      if type(method) == "function" and name ~= "record" then
        for _, arguments in ipairs(junk) do
          local ok, problem = pcall(method, value, table.unpack(arguments, 1, 2))
          local text = tostring(problem)
          if not ok and (text:find "attempt to" or text:find "bad argument") then faults[#faults + 1] = name .. ": " .. text end
        end
      end
    end
  end
  t.equal(table.concat(faults, "\n"), "")
  t.fails(function() a:record(5) end, "port:record: path: expected a string, got 5")
end)
