-- Chromium without a window, commanded by its DevTools protocol over a WebSocket, for tests.
local clench = require "clench"
local web_client = dofile "tests/lua/web_client.lua"
local loop = clench.loop

local Browser = {}
Browser.__index = Browser

--- Is there a browser?
local function is_installed()
  local found <close> = io.popen "command -v chromium"
  return found:read "l" ~= nil
end

local function first_line(path)
  local file <close> = io.open(path)
  return file and file:read "l"
end

-- waits until f() returns something
local function await(f, seconds, what)
  local last = loop.time() + seconds
  while true do
    local found = f()
    if found then return found end
    assert(loop.time() < last, what .. " did not come in time")
    loop.sleep(0.05)
  end
end

--- Evaluates an expression in the page; a promise is awaited.
function Browser:evaluate(expression)
  local response = self.call("Runtime.evaluate", {expression = expression, awaitPromise = true, returnByValue = true})
  local result = assert(response.result, response.error and response.error.message)
  assert(not result.exceptionDetails, result.exceptionDetails and result.exceptionDetails.exception.description)
  return result.result.value
end

--- Waits until an expression is true.
function Browser:await(expression, seconds)
  return await(function() return self:evaluate(expression) end, seconds or 20, expression)
end

--- Exceptions of the page's scripts, as text.
function Browser:faults()
  self:evaluate "1"
  local out = {}
  for _, note in ipairs(self.notes) do
    if note.method == "Runtime.exceptionThrown" then out[#out + 1] = clench.json.encode(note.params.exceptionDetails) end
  end
  return table.concat(out, "\n")
end

--- Takes a picture of the page: base64 of a PNG.
function Browser:picture() return self.call("Page.captureScreenshot", {format = "png"}).result.data end

function Browser:close()
  if self.port then self.port:close() end
  os.execute(("{ kill %s; while kill -0 %s; do sleep 0.05; done; sleep 0.2; rm -rf %s; } 2>/dev/null"):format(self.process, self.process, self.folder))
end

Browser.__close = Browser.close

-- where the browser's page is commanded; nil: nowhere yet
local function find_page(folder)
  local number = first_line(folder .. "/DevToolsActivePort")
  if not number then return nil end
  local asked <close> = clench.port.connect("127.0.0.1", tonumber(number))
  asked:write(("GET /json/list HTTP/1.1\r\nHost: localhost:%s\r\nConnection: close\r\n\r\n"):format(number))
  local path = web_client.read_all(asked, 5):match '"webSocketDebuggerUrl": "ws://[^/]*(/devtools/page/[^"]*)"'
  return path and {port = tonumber(number), path = path}
end

local function start(url, folder, size)
  os.execute(("mkdir -p %s; chromium --headless --no-sandbox --disable-gpu-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader "
    .. "--disable-dev-shm-usage --no-first-run --disable-background-networking --window-size=%s --remote-debugging-port=0 --user-data-dir=%s '%s' >%s/log 2>&1 & "
    .. "echo $! >%s/process"):format(folder, size or "1300,900", folder, url, folder, folder))
  return first_line(folder .. "/process")
end

--- Opens a page. Raises an error if the browser does not start.
---@param url string
---@param folder string  of the browser; it is removed at the end
local function open(url, folder, size)
  local self = setmetatable({folder = folder, process = start(url, folder, size)}, Browser)
  local ok, problem = pcall(function()
    local page = await(function() return find_page(folder) end, 60, "the browser")
    self.port = web_client.open(page.port, page.path)
    self.call, self.notes = web_client.caller(self.port, false)
    self.call("Runtime.enable", {})
    self:await("document.readyState === 'complete'", 60)
  end)
  if not ok then
    self:close()
    error(problem, 0)
  end
  return self
end

return {is_installed = is_installed, open = open, await = await}
