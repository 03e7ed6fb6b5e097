-- Names and messages with control characters of terminals or markup.
local clench = require "clench"
local test = require "test"
local printable = require "clench.printable"
local text = require "clench.page.text"

local hostile = {"\27[31m", "\r", "\n", "\0", "\127", "\u{85}", "\u{9B}31m", "\u{2028}", "\u{2029}", "\u{202A}", "\u{202E}", "\u{2066}", "\u{2069}"}
local kept = {"a", "é", "\u{A0}", "\u{2027}", "\u{202F}", "\u{2065}", "\u{206A}", "\u{10FFFF}", "日本", "\xE9"}

test("each control character of terminals is replaced by one mark, and no others are", function(t)
  for _, word in ipairs(hostile) do
    local shown = printable("a" .. word .. "b")
    t.ok(not shown:find(word, 1, true), word)
    t.equal(shown, "a?" .. word:gsub("^[\1-\127]", ""):gsub("^[\0]", ""):gsub("^[\xC2\xE2][\x80-\xBF]+", "") .. "b")
  end
  for _, word in ipairs(kept) do t.equal(printable(word), word) end
  t.equal(printable("a\n\tb\27", "\n\t"), "a\n\tb?")
end)

test("names contain no control characters", function(t)
  local world = clench.world {}
  for _, word in ipairs(hostile) do
    t.fails(function() world:add_object(clench.shapes.box {1, 1, 1}, {name = "a" .. word .. "b"}) end,
            word == "\0" and "name: expected a string without zero bytes, got 'a?b'" or "name: expected no control characters, got 'a?")
  end
  for i, word in ipairs(kept) do
    if word ~= "\xE9" then t.equal(world:add_object(clench.shapes.box {1, 1, 1}, {name = word .. i}).name, word .. i) end
  end
end)

test("messages, JSON, pages and figures contain no control characters", function(t)
  for _, word in ipairs(hostile) do
    local message = t.fails(function() clench.load("no" .. word .. "file.wld") end, word == "\0" and "without zero bytes" or "no such file")
    t.ok(not message:find(word, 1, true), message)
    local json = clench.json.encode(word)
    t.ok(not json:find(word, 1, true), json)
    t.equal(clench.json.decode(json), word)
    local shown = require "clench.show" {word}
    t.ok(word == "\n" or not shown:find(word, 1, true), shown)
    t.ok(word == "\n" or not text.escaped(word):find(word, 1, true))
    t.ok(not text.json({name = word}):find(word, 1, true))
    t.ok(word:byte() < 0x80 or not text.json({name = word}):find "\\u[28]0")
    if word == "\0" then goto continue end  -- no title has a zero byte
    local path = test.path ".svg"
    clench.plot({series = {{x = {0, 1}, y = {0, 1}}}, title = "a" .. word .. "b<i>&"}):save(path)
    local svg = clench.files.read_text(path)
    t.ok(word == "\n" or not svg:find(word, 1, true), word)
    t.ok(svg:find("b&lt;i&gt;&amp;", 1, true))
    ::continue::
  end
  t.ok(not text.json({"</script><!--"}):find "[<>]")
end)
