-- Tables for papers.
local test, clench = require "test", require "clench"
local latex = clench.latex

test("a table has a line per row, numbers aligned right, and special characters escaped", function(t)
  local rows = {{object = "mug_2 & co", epsilon = 0.123456, held = 6, ok = true}, {object = "50%", epsilon = -1.5e-7}}
  t.equal(latex.table(rows, {columns = {"object", "epsilon", "held", "ok"}, formats = {epsilon = "%.2g"}}), [[
\begin{tabular}{lrrl}
\toprule
object & epsilon & held & ok \\
\midrule
mug\_2 \& co & 0.12 & 6 & yes \\
50\% & $-1.5 \times 10^{-7}$ & -- & -- \\
\bottomrule
\end{tabular}
]])
end)

test("every special character of LaTeX is escaped once", function(t)
  local text = latex.table {{a = "\\ { } $ & # % _ ^ ~"}}
  t.ok(text:find("\\textbackslash{} \\{ \\} \\$ \\& \\# \\% \\_ \\textasciicircum{} \\textasciitilde{}", 1, true), text)
end)

test("NaN is a dash, and infinite numbers are LaTeX symbols", function(t)
  local text = latex.table({{a = 0 / 0, b = math.huge, c = -math.huge, d = 3.0}}, {columns = {"a", "b", "c", "d"}})
  t.ok(text:find("-- & $\\infty$ & $-\\infty$ & 3 \\\\", 1, true), text)
end)

test("a caption makes a floating table", function(t)
  local text = latex.table({{a = 1}}, {caption = "10 % more", label = "tab:more"})
  t.ok(text:find "^\\begin{table}\n\\centering\n\\caption{10 \\%% more}\n\\label{tab:more}\n\\begin{tabular}{r}", text)
  t.equal(text:sub(-12), "\\end{table}\n")
end)

test("arguments that are not tables are rejected by name", function(t)
  local function fails(rows, options, message) t.fails(function() latex.table(rows, options) end, message) end
  fails(3, nil, "latex.table: rows: expected a list, got 3")
  fails({3}, nil, "latex.table: rows[1]: expected a table of names and values, got 3")
  fails({{[1] = 2}}, nil, "expected names of columns as keys, got 1")
  fails({{a = {}}}, nil, "rows[1].a: expected a number, a text, true or false")
  fails({}, nil, "expected rows with columns, or `columns`, got neither")
  fails({{a = 1}}, {formats = {a = "%s"}}, "formats.a must be a format of one number, such as %.3f, got '%s'")
  fails({{a = 1}}, {formats = {b = "%d"}}, "formats: 'b' is not one of the columns")
  fails({{a = 1}}, {colums = {"a"}}, "unknown key 'colums'")
end)

test("a LaTeX processor accepts the table", function(t)
  local found = io.popen "command -v pdflatex 2>/dev/null"
  local program = found:read "l"
  found:close()
  if not program then t.skip "pdflatex is not installed" end
  local folder = os.tmpname()
  os.remove(folder)
  os.execute("mkdir " .. folder)
  clench.files.save_text(folder .. "/a.tex", "\\documentclass{article}\\usepackage{booktabs}\\begin{document}\n" ..
    latex.table({{a = "\\ { } $ & # % _ ^ ~", b = -1e-9}}, {caption = "a_b"}) .. "\\end{document}\n")
  t.ok(os.execute(("cd %s && pdflatex -interaction=batchmode -halt-on-error a.tex > /dev/null"):format(folder)))
  os.execute("rm -r " .. folder)
end)
