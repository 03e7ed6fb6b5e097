-- Runs the Lua blocks of a Markdown page as one script, in order: a page tells one story. Everything else on the page becomes empty
-- lines, so an error names the page's own line.
--   clench run tests/docs/run_page.lua PAGE
os.tmpname = require "clench.test".path  -- what a page writes there is removed at the end
local page = assert(arg[1], "usage: run_page.lua PAGE")
local lines, inside, blocks = {}, false, 0
for text in io.lines(page) do
  local fence = text:match "^%s*```(%w*)"
  if fence then
    inside = fence == "lua" and not inside
    blocks = blocks + (inside and 1 or 0)
    text = ""
  end
  lines[#lines + 1] = inside and text or ""
end
assert(not inside, page .. ": the last Lua block is not closed")
assert(load(table.concat(lines, "\n"), "@" .. page))()
print(("%s: %d blocks ran"):format(page, blocks))
