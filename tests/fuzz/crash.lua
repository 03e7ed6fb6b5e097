-- Signature of a failed run, equal for runs with the same cause: the sanitizer's summary, else the exit code.
--   lua5.4 tests/fuzz/crash.lua OUTPUT CODE       also returned as a function(text, code)
local function signature(text, code)
  local summary = text:match "([^\n]*: runtime error: [^\n]*)" or text:match "SUMMARY: ([^\n]*)"
    or text:match "(hard rss limit exhausted)" or text:match "ERROR: (AddressSanitizer: [^\n]*)"
  if summary then return (summary:gsub("0x%x+", "N"):gsub("%d%d%d+", "N"):gsub("^.*/src/", "src/"):gsub("%(.-%)", "")) end
  -- exit codes of ulimit -t, of SIGXCPU or SIGKILL after it, and of timeout
  if code == 152 or code == 137 or code == 124 then return "no end" end
  return ("exit code %d"):format(code)
end

if arg and arg[0] and arg[0]:find "crash%.lua$" then
  local file = io.open(arg[1], "rb")
  print(signature(file and file:read "a" or "", tonumber(arg[2])))
end
return signature
