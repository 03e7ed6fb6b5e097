-- The pages that clench doc writes, and their parts.
local test, doc = require "test", require "clench.host.doc"

local text = [[
Closes the fingers
until contact.
@param options? {speed?: number, norm?: "L1"|"Linf"}  how fast
@param ... any
@return table result  `moved`
> hand:open()
> hand:autograsp().moved  --> true
> hand:autograsp{sped = 1}  --> error: unknown key]]

test("an entry's doc is parsed into its parts", function(t)
  local parsed = doc.parse(text)
  t.equal(parsed.text, "Closes the fingers until contact.")
  t.equal(parsed.params[1], {name = "options?", type = '{speed?: number, norm?: "L1"|"Linf"}', text = "how fast", limits = ""})
  t.equal(parsed.params[2], {name = "...", type = "any", text = "", limits = ""})
  t.equal(parsed.returns[1], {type = "table result", text = "`moved`"})
  t.equal(parsed.examples[1], {prepare = {"hand:open()"}, code = "hand:autograsp().moved", result = "true"})
  t.equal(parsed.examples[2].result, "error: unknown key")
  t.equal(parsed.unused, 0)
  t.equal(doc.signature("hand:autograsp", parsed), "hand:autograsp(options, ...)")
  t.equal(doc.parse("x\n> code").unused, 1)
end)

test("pages are pairs of name and text, and the stub is valid Lua", function(t)
  local pages = table.pack(doc.pages())
  t.equal(pages.n % 2, 0)
  local by_name = {}
  for i = 1, pages.n, 2 do by_name[pages[i]] = pages[i + 1] end
  t.ok(by_name["pose.md"]:find("### `pose:inverse()`", 1, true))
  t.ok(by_name["clench.md"]:find("### `clench.rad(degrees)`", 1, true))
  t.ok(by_name["stdlib.md"]:find("### `clench.shapes.box(options)`", 1, true))
  t.ok(by_name["stdlib.md"]:find("### `clench.report.of(path, options)`", 1, true))
  t.ok(by_name["stdlib.md"]:find('r = clench.report.of "models/hands/barrett/barrett.cfg"', 1, true))
  t.ok(by_name["clench.lua"]:find("function pose:inverse() end", 1, true))
  t.ok(assert(load(by_name["clench.lua"], "=stub", "t", {}))())
end)
