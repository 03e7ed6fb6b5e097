-- Runs the Lua blocks of a Markdown page as one script, in order: a page tells one story. Everything else on the page becomes empty lines, so that
-- errors name the page's own line. Then runs each block of commands that is followed by a block of output, in an empty folder, and compares the two:
-- "..." matches any number of lines, and seconds may differ.
--   clench run tests/docs/run_page.lua PAGE
local new_path = require "clench.test".path
os.tmpname = new_path  -- files that a page writes there are removed at the end
local page = assert(arg[1], "usage: run_page.lua PAGE")
local lines, blocks, last = {}, {}, nil
for text in io.lines(page) do
  local fence = text:match "^%s*```(%w*)"
  if fence and last then
    last = nil
  elseif fence then
    last = {language = fence, line = #lines + 2}
    blocks[#blocks + 1] = last
  elseif last then
    last[#last + 1] = text
  end
  lines[#lines + 1] = not fence and last and last.language == "lua" and text or ""
end
assert(not last, page .. ": the last block is not closed")
assert(load(table.concat(lines, "\n"), "@" .. page))()

-- the first line at which output differs from a pattern, or nil
local function difference(pattern, output)
  local at, skipping = 1, false
  for i, text in ipairs(pattern) do
    if text == "..." then
      skipping = true
    else
      while skipping and output[at] and output[at] ~= text do at = at + 1 end
      if output[at] ~= text then return i, output[at] or "nothing" end
      at, skipping = at + 1, false
    end
  end
  if not skipping and output[at] then return #pattern + 1, output[at] end
end

local function without_times(text) return (text:gsub("%d+%.?%d* s%f[%W]", "N s")) end

-- output of the commands of a block, with this program as `clench`
local function output_of(commands)
  local folder = new_path()
  os.remove(folder)
  local script = ([[
exec 2>&1
program=$(readlink /proc/$PPID/exe)
mkdir -p '%s/bin' && ln -s "$program" '%s/bin/clench' && cd '%s' && PATH="$PWD/bin:$PATH"
%s
cd / && rm -rf '%s']]):format(folder, folder, folder, table.concat(commands, "\n"), folder)
  local pipe, output = assert(io.popen(script)), {}
  for text in pipe:lines() do output[#output + 1] = without_times(text) end
  pipe:close()
  return output
end

local compared = 0
for i = 1, #blocks - 1 do
  local commands, expected = blocks[i], blocks[i + 1]
  if commands.language == "sh" and expected.language == "" then
    local pattern = {}
    for k, text in ipairs(expected) do pattern[k] = without_times(text) end
    local output = output_of(commands)
    local where, got = difference(pattern, output)
    if where then
      error(("%s:%d: expected '%s', got '%s' in\n%s"):format(page, expected.line + where - 1, expected[where] or "the end", got, table.concat(output, "\n")), 0)
    end
    compared = compared + 1
  end
end
local count = 0
for _, block in ipairs(blocks) do count = count + (block.language == "lua" and 1 or 0) end
print(("%s: %d blocks ran, %d outputs compared"):format(page, count, compared))
