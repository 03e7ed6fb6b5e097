-- Numbers of an experiment: tables to files and back, and statistics.
local clench = require "clench"
local test = require "test"
local csv, stats = clench.csv, clench.stats

local function with_file(text, run)
  run(test.path("", text))
end

test("a table of results reproduces values, with their types", function(t)
  local texts = {"mug", "", "1", "1.5", "true", "nan", "-inf", " a", "b ", 'say "x"', "a,b", "two\nlines\n\nend", "0x10", "é", "1e5", "+1"}
  local numbers = {0, 1, -7, math.mininteger, math.maxinteger, 0.1, 1.0, -0.0, 1e300, 5e-324, 1 / 3, math.huge, -math.huge, 2.0 ^ 53}
  local rows = {}
  for i = 1, math.max(#texts, #numbers) do rows[i] = {text = texts[i], number = numbers[i], yes = i % 3 == 0, seldom = i == 4 and 4 or nil} end
  for _, separator in ipairs {",", ";", "\t"} do
    with_file(nil, function(path)
      csv.write(path, rows, {separator = separator, columns = {"text", "seldom", "number", "yes"}})
      local back = csv.read(path, {separator = separator})
      t.equal(back.columns, {"text", "seldom", "number", "yes"})
      t.equal(#back, #rows)
      for i, row in ipairs(rows) do
        for _, name in ipairs(back.columns) do
          t.ok(row[name] == back[i][name] and math.type(row[name]) == math.type(back[i][name]),
               ("%s of row %d: %s is %s"):format(name, i, tostring(row[name]), tostring(back[i][name])))
        end
      end
      t.equal(1 / back[8].number, -math.huge)
    end)
  end
end)

test("a single column keeps its empty cells, and a NaN is not empty", function(t)
  with_file(nil, function(path)
    csv.write(path, {{a = 1}, {}, {a = 0 / 0}, {}}, {columns = {"a"}})
    local back = csv.read(path)
    t.equal(#back, 4)
    t.ok(back[1].a == 1 and back[2].a == nil and back[3].a ~= back[3].a and back[4].a == nil)
  end)
end)

test("files of other programs are read", function(t)
  with_file("\xEF\xBB\xBFname,value\r\n\"a \"\"b\"\"\",1\r\n\r\nplain text, 2\r\nlast,", function(path)
    local rows = csv.read(path)
    t.equal(rows.columns, {"name", "value"})
    t.equal(#rows, 3)
    t.equal({rows[1].name, rows[1].value}, {'a "b"', 1})
    t.equal({rows[2].name, rows[2].value}, {"plain text", " 2"})
    t.equal(rows[3].value, nil)
  end)
end)

test("faults of a table are reported with file and line", function(t)
  local function refused(text, message)
    with_file(text, function(path) t.fails(function() csv.read(path) end, message) end)
  end
  refused("", ":1: expected names of columns, got an empty file")
  refused("a,a\n1,2\n", ":1: column 'a' appears twice")
  refused("a,b\n1,2\n3\n", ":3: expected 2 cells, got 1")
  refused("a,b\n\"x\ny\",2\n3,4,5\n", ":4: expected 2 cells, got 3")
  refused("a,b\n1,\"x\n", ":2: a quote that is not closed")
  refused("a,b\n1,\"x\"y\n", ":2: expected a separator or the line's end behind the quote, got 'y'")
  refused("a,b\n1,x\"y\n", ":2: a quote within 'x\"y', which does not begin with one")
  t.fails(function() csv.read "no/such.csv" end, "csv.read: no such file: no/such.csv")
  with_file("kept", function(path)
    t.fails(function() csv.write(path, {{a = {}}}) end, "rows[1].a: expected a number, a text, true or false, got an empty table")
    t.fails(function() csv.write(path, {{a = clench.vec3(1, 2, 3)}}) end, "rows[1].a: expected a number, a text, true or false, got a vec3")
    t.fails(function() csv.write(path, {{1, 2}}) end, "rows[1]: expected names of columns as keys, got 1")
    t.fails(function() csv.write(path, {3}) end, "rows[1]: expected a table of names and values, got 3")
    t.fails(function() csv.write(path, {{a = 1, b = 2}}, {columns = {"a"}}) end, "rows have 'b', which is not one of the columns")
    t.fails(function() csv.write(path, {{a = 1}}, {columns = {"a", "a"}}) end, "column 'a' appears twice")
    t.fails(function() csv.write(path, {{a = 1}}, {separator = "|"}) end, "separator must be ',', ';' or a tab, got '|'")
    t.fails(function() csv.write(path, {}) end, "expected rows with columns, or `columns`, got neither")
    t.fails(function() csv.write(path, {{a = 1}}, {columms = {}}) end, "unknown key 'columms'")
    t.equal(io.open(path):read "a", "kept")
  end)
end)

test("a histogram counts each number once, compared with a slow count", function(t)
  local random = clench.random(3)
  for _ = 1, 50 do
    local values = {}
    for i = 1, random:integer(1, 60) do values[i] = random:integer(-5, 5) * 0.1 end
    local bins = random:integer(1, 12)
    local h = stats.histogram(values, {bins = bins, low = -0.3, high = 0.4})
    t.equal(#h.edges, bins + 1)
    t.equal({h.edges[1], h.edges[bins + 1]}, {-0.3, 0.4})
    local below, above = 0, 0
    for _, x in ipairs(values) do
      if x < -0.3 then below = below + 1 elseif x > 0.4 then above = above + 1 end
    end
    t.equal({h.below, h.above}, {below, above})
    for b = 1, bins do
      local count = 0
      for _, x in ipairs(values) do
        if h.edges[b] <= x and (x < h.edges[b + 1] or b == bins and x == h.edges[b + 1]) then count = count + 1 end
      end
      t.equal(h.counts[b], count)
    end
  end
  t.equal(#stats.histogram({1, 2, 3, 4, 5, 6, 7, 8}).counts, 4)
  t.equal(stats.histogram({2, 2, 2}, {bins = 1}).counts, {3})
end)

test("quantiles and summaries agree with their definitions", function(t)
  local values = {}
  for i = 1, 101 do values[i] = (i * 37) % 101 end
  for part = 0, 1, 0.25 do t.close(stats.quantile(values, part), 100 * part, 1e-12) end
  local s = stats.summary(values)
  t.equal({s.count, s.min, s.max}, {101, 0, 100})
  t.close({s.mean, s.median, s.p05, s.p95}, {50, 50, 5, 95}, 1e-12)
  t.close(s.std, math.sqrt(101 * 102 / 12), 1e-12)
  t.equal({stats.mean(values), stats.std(values)}, {s.mean, s.std})
  -- far from 0, where squares would lose their digits
  t.close(stats.std {1e9 + 1, 1e9 + 2, 1e9 + 3}, 1, 1e-12)
  t.equal(stats.std {1e200, -1e200, 0}, 1e200)
  t.equal(stats.std {4, 4, 4}, 0)
end)

test("values that are not lists of numbers are rejected", function(t)
  t.fails(function() stats.mean {1, 0 / 0} end, "stats.mean: values[2]: expected a finite number, got nan")
  t.fails(function() stats.std {1, nil, 3} end, "stats.std: values[2]: expected a finite number, got nothing")
  t.fails(function() stats.summary "x" end, "stats.summary: expected a list of numbers, got 'x'")
  t.fails(function() stats.histogram({1}, {bins = 0}) end, "bins must be a whole number from 1 to 100000, got 0")
  t.fails(function() stats.histogram({1}, {low = 2, high = 1}) end, "expected low below high, got 2 and 1")
  t.fails(function() stats.interval(3, 2) end, "at most as many successes as trials, got 3 of 2")
end)

test("figures of numbers are drawn and saved, and sheets contain them", function(t)
  local line = clench.plot {series = {{name = "a", y = {1, false, 3, 0 / 0, 5}}, {kind = "points", x = {0, 9}, y = {2, 2}}},
                            title = "t", x_label = "x [m]", y_label = "y", y_range = {0, 4}, width = 300, height = 200}
  t.equal(tostring(line), "plot of 300 x 200 pixels")
  t.ok(line.picture == line.picture and line.picture.width == 300)
  local bars = clench.plot {series = {clench.stats.histogram({1, 2, 2, 5}, {low = 1, high = 4})}, width = 200, height = 200}
  for _, ending in ipairs {".svg", ".png"} do
    local path = test.path(ending)
    line:save(path)
    local file = assert(io.open(path, "rb"))
    local head = file:read(5)
    file:close()
    t.equal(head, ending == ".svg" and "<svg " or "\x89PNG\r")
  end
  local sheet = clench.sheet {pictures = {line.picture, bars.picture}, captions = {"line", "bars"}, columns = 1, gap = 10}
  t.equal({sheet.width, sheet.height}, {320, 10 + 2 * (200 + 22 + 10)})
  t.fails(function() clench.plot {series = {{y = {1, "2"}}}} end, "series[1]: y[2]: expected a number, or false, got '2'")
  t.fails(function() clench.plot {series = {{y = {1}, kind = "bar"}}} end, "did you mean 'bars'?")
  t.fails(function() clench.plot {series = {{edges = {0, 1}}}} end, "counts")
  t.fails(function() clench.plot {series = {{y = {1}}}, x_range = {1}} end, "x_range: expected 2 numbers, got 1")
  t.equal(clench.sheet {pictures = {line, line.picture}}, clench.sheet {pictures = {line.picture, line}})
  t.fails(function() clench.sheet {pictures = {1}} end, "pictures[1]: expected a picture, got 1")
  t.fails(function() clench.sheet {pictures = {line.picture}, columns = 0} end, "columns must be 1 to 16384, got 0")
end)

test("bars over names, and charts, are saved as PNG and as SVG", function(t)
  local bars = clench.plot {categories = {"Barrett", "Shadow"}, series = {{name = "random", y = {12, 7}}, {name = "antipodal", y = {30, false}}},
                            title = "Grasps found", y_label = "grasps", width = 300, height = 200}
  local chart = clench.chart {series = {{name = "epsilon", values = {0.1, 0.3}}}, labels = {"Barrett", "Shadow"}, width = 300, height = 200}
  for _, figure in ipairs {bars, chart} do
    local path = test.path()
    figure:save(path .. ".svg")
    figure:save(path .. ".png")
    local svg = assert(io.open(path .. ".svg")):read "a"
    t.ok(svg:find ">Barrett</text>" and svg:find ">Shadow</text>", svg)
    t.ok(assert(io.open(path .. ".png", "rb")):read "a":find "^\x89PNG")
    t.equal(figure.picture.width, 300)
    t.equal(figure.width, 300)
    t.equal(figure.height, 200)
  end
  t.ok(bars ~= chart)
  t.fails(function() clench.plot {categories = {"a", "b"}, series = {{y = {1}}}} end, "series 1: expected 2 values, one per category, got 1")
  t.fails(function() clench.plot {categories = {"a"}, series = {{x = {1}, y = {1}}}} end, "series 1: expected no x, because categories are along that axis")
  t.fails(function() clench.plot {categories = {"a"}, series = {{y = {1}}}, x_range = {0, 1}} end, "x_range: not allowed with categories")
  t.fails(function() clench.plot {categories = {"a"}, series = {{y = {1}}}, x_scale = "log"} end, "x_scale: not allowed with categories")
  t.fails(function() clench.plot {categories = {}, series = {{y = {1}}}} end, "categories: expected at least one, got none")
  t.fails(function() clench.plot {categories = {1}, series = {{y = {1}}}} end, "categories[1]: expected a string, got 1")
end)

test("a table whose values take far more memory than its text is rejected", function(t)
  with_file(("1\n"):rep(1000000), function(path) t.fails(function() csv.read(path) end, "its contents take more than 102 MB of memory: 20 times the file and 64 MB") end)
end)
