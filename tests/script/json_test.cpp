#include "script_state.h"

using clench::test::Script;

TEST_CASE("JSON reproduces values: numbers bit-exactly, integers as integers, floats as floats") {
  Script lua;
  CHECK(lua.run(R"(
    local json = clench.json
    for _, x in ipairs{0, -1, 1.0, 0.1, 1 / 3, 1e300, 5e-324, 2^53, math.maxinteger, math.mininteger, math.pi} do
      local back = json.decode(json.encode(x))
      if back ~= x or math.type(back) ~= math.type(x) then return x, back end
    end
    local zero = json.decode(json.encode(-0.0))
    return 1 / zero)") == "-inf");
  CHECK(lua.text("clench.json.encode(clench.json.decode "
                 "'[1,2.5,\"x\",true,false,null,{},[],{\"a\":{\"b\":[]}}]')") ==
        "[1,2.5,\"x\",true,false,null,{},[],{\"a\":{\"b\":[]}}]");
}

TEST_CASE("equal values give equal text: keys are sorted") {
  Script lua;
  CHECK(lua.text("clench.json.encode{b = 1, a = {z = 1, y = 2}, c = {}}") ==
        R"({"a":{"y":2,"z":1},"b":1,"c":[]})");
  CHECK(lua.text("clench.json.encode({a = {1, 2}, b = {}}, {indent = 2})") ==
        "{\n  \"a\": [\n    1,\n    2\n  ],\n  \"b\": []\n}");
}

TEST_CASE("text of any writing system is preserved, and escapes are read") {
  Script lua;
  CHECK(lua.text(R"(clench.json.encode 'a"\\\n\0\127é€😀')") == R"("a\"\\\n\u0000\u007fé€😀")");
  CHECK(lua.text(R"==(clench.json.decode '"\\u00e9\\u20AC\\ud83d\\ude00\\/\\t"')==") == "é€😀/\t");
  CHECK(lua.text("clench.json.decode(clench.json.encode 'a\\0b') == 'a\\0b'") == "true");
  CHECK(lua.text("clench.json.decode '\\xEF\\xBB\\xBF [1]'[1]") == "1");
}

TEST_CASE("values of Clench are written as the arguments that construct them") {
  Script lua;
  CHECK(lua.text("clench.json.encode{clench.vec3(1, 2, 3)}") == "[[1.0,2.0,3.0]]");
  CHECK(lua.text("clench.pose(clench.json.decode(clench.json.encode(clench.pose{rpy = {1, 2, "
                 "3}}))) == clench.pose{rpy "
                 "= {1, 2, 3}}") == "true");
  CHECK(lua.run(
            "return clench.json.encode(setmetatable({}, {__json = function() return {1} end}))") ==
        "[1]");
}

TEST_CASE("a null is absent from an object and kept in a list") {
  Script lua;
  CHECK(lua.text("clench.json.decode '{\"a\": null, \"b\": 1}'.a") == "nil");
  CHECK(lua.text("clench.json.decode '[null, 2]'[1] == clench.json.null") == "true");
  CHECK(lua.text("clench.json.encode(clench.json.decode '{\"a\": null}')") == "{}");
}

TEST_CASE("data that JSON cannot represent are rejected with their place") {
  Script lua;
  const auto refused = [&](const std::string& value) {
    return lua.text("clench.json.encode(" + value + ")");
  };
  const std::string at = "test:1: clench.json.encode: ";
  CHECK(
      refused("{a = {1, print}}") ==
      at + "value.a[2]: expected a number, string, boolean, table or clench value, got a function");
  CHECK(refused("0 / 0").find("value: expected a finite number, got") != std::string::npos);
  CHECK(refused("{x = math.huge}") == at + "value.x: expected a finite number, got inf");
  CHECK(refused("{1, 2, a = 3}") ==
        at + "value: expected a list or names, got both: 2 items and the name 'a'");
  CHECK(
      refused("{[1] = 1, [3] = 3, [-1] = 0}").find("expected names, or items 1..n without holes") !=
      std::string::npos);
  CHECK(refused("{[1.5] = 1}") ==
        at + "value: expected names, or items 1..n without holes, got the key 1.5");
  CHECK(refused("'\\xff'") == at + "value: expected text in UTF-8, got the byte 255");
  CHECK(refused("'\\xed\\xa0\\x80'").find("UTF-8") != std::string::npos);
  CHECK(refused("io.stdout") == at + "value: expected a value that JSON can hold, got a FILE*");
  CHECK(refused("clench.random(1)") ==
        at + "value: expected a value that JSON can hold, got a random");
  CHECK(refused("") == at + "value: expected a value, got nothing");
  CHECK(refused("1, {indent = 99}") == at + "indent must be 0 to 16, got 99");
  CHECK(lua.run("local t = {} t.t = {t} return clench.json.encode(t)") ==
        at + "value.t[1]: expected no table within itself");
  CHECK(lua.run("local t = {} for i = 1, 1000 do t = {t} end return clench.json.encode(t)")
            .find("at most 100 levels") != std::string::npos);
  CHECK(lua.run("return clench.json.encode(setmetatable({}, {__json = function(t) return t end}))")
            .find("finite chain of __json values") != std::string::npos);
  CHECK(lua.run("return clench.json.encode(setmetatable({}, {__json = function(t) error('mine', 0) "
                "end}))") == "mine");
}

TEST_CASE("a text that is not JSON is rejected with line and column") {
  Script lua;
  const auto refused = [&](const std::string& text) {
    return lua.text("clench.json.decode [==[" + text + "]==]");
  };
  const std::string at = "test:1: clench.json.decode: line ";
  CHECK(refused("") == at + "1, column 1: expected a value, got the end of the text");
  CHECK(refused("{\"a\": 1,\n \"b\" 2}") == at + "2, column 6: expected ':', got '2'");
  CHECK(refused("[1, 2") == at + "1, column 6: expected ',' or ']', got the end of the text");
  CHECK(refused("[1 2]") == at + "1, column 4: expected ',' or ']', got '2'");
  CHECK(refused("[1,]") == at + "1, column 4: expected a value, got ']'");
  CHECK(refused("{a: 1}") == at + "1, column 2: expected a name in double quotes, got 'a'");
  CHECK(refused("[1] x") == at + "1, column 5: expected the end, got 'x'");
  CHECK(refused("nul") == at + "1, column 1: expected a value, got 'n'");
  CHECK(refused("NaN").find("expected a value") != std::string::npos);
  CHECK(refused("01") == at + "1, column 2: expected a number without leading zeros");
  CHECK(refused("-") == at + "1, column 2: expected a digit, got the end of the text");
  CHECK(refused("1.") == at + "1, column 3: expected a digit, got the end of the text");
  CHECK(refused("1e+") == at + "1, column 4: expected a digit, got the end of the text");
  CHECK(refused("1e999") == at + "1, column 1: a number too large for 64 bits: 1e999");
  CHECK(refused("\"abc") == at + "1, column 1: a string that never ends");
  CHECK(refused("\"a\nb\"") ==
        at + "1, column 3: expected no control character in a string, got byte 10");
  CHECK(refused("\"\\x\"").find("after a backslash, got 'x'") != std::string::npos);
  CHECK(refused("\"\\u12g4\"") == at + "1, column 6: expected a hexadecimal digit, got 'g'");
  CHECK(refused("\"\\ud800\"") == at + "1, column 2: half of a surrogate pair");
  CHECK(refused("\"\\udc00x\"") == at + "1, column 2: half of a surrogate pair");
  CHECK(refused(std::string(1000, '[')).find("nested deeper than 100 levels") != std::string::npos);
  CHECK(lua.text("clench.json.decode(5)") ==
        "test:1: clench.json.decode: text: expected a string, got 5");
  CHECK(lua.text("clench.json.decode '1e-999'") == "0.0");
}

TEST_CASE("the parts of a split text are decoded to the parts of the whole") {
  Script lua;
  CHECK(lua.run(R"==(
    local json = clench.json
    local whole = {"a,]}\"", {1, {2, "["}, {}}, {["x:\"]"] = {{}, "}"}, y = "\\"}, true, json.null, -1.5e-7, "é\n"}
    local function same(a, b) return json.encode(a) == json.encode(b) end
    for _, indent in ipairs{0, 1, 3} do
      local items = json.split(" " .. json.encode(whole, {indent = indent}) .. "\n")
      if #items ~= #whole then return #items end
      for i, item in ipairs(items) do
        if item:find "^%s" or item:find "%s$" or not same(json.decode(item), whole[i]) then return i, item end
      end
      local named = {}
      for i, item in ipairs(whole) do named["n\"" .. i] = item end
      local fields, count = json.split(json.encode(named, {indent = indent})), 0
      for name, field in pairs(fields) do
        count = count + 1
        if not same(json.decode(field), named[name]) then return name, field end
      end
      if count ~= #whole then return count end
    end
    return #json.split "[ ]", next(json.split "{ }"), json.split '{"id":null}'.id, json.split '{"a":1,"a":2}'.a)==") ==
        "0, nil, null, 2");
}

TEST_CASE("a text that cannot be split is rejected with line and column") {
  Script lua;
  const auto refused = [&](const std::string& text) {
    return lua.text("clench.json.split [==[" + text + "]==]");
  };
  const std::string at = "test:1: clench.json.split: line 1, column ";
  CHECK(refused("") == at + "1: expected '[' or '{', got the end of the text");
  CHECK(refused("5") == at + "1: expected '[' or '{', got '5'");
  CHECK(refused("[1, 2") == at + "6: expected ',' or ']', got the end of the text");
  CHECK(refused("[1,]") == at + "4: expected a value, got ']'");
  CHECK(refused("[1}") == at + "3: expected ',' or ']', got '}'");
  CHECK(refused("{\"a\" 1}") == at + "6: expected ':', got '1'");
  CHECK(refused("{a: 1}") == at + "2: expected a name in double quotes, got 'a'");
  CHECK(refused("[[]] x") == at + "6: expected the end, got 'x'");
  CHECK(refused("[\"a\\") == at + "2: a string that never ends");
  CHECK(lua.run(R"(
    local text = clench.json.encode{1, {2.5, "x\n😀"}, {a = {b = {}}}}
    for cut = 0, #text - 1 do
      if pcall(clench.json.split, text:sub(1, cut)) then return cut end
    end)") == "");
}

TEST_CASE("a text with more values than permitted is refused, as an error of its own kind") {
  Script lua;
  const auto limited = [&](const std::string& call) {
    return lua.run("local ok, problem = pcall(clench.json." + call +
                   ") return ok or problem.kind, ok and clench.json.encode(problem) or "
                   "tostring(problem)");
  };
  CHECK(limited("decode, '[1,{\"a\":null}]', {max_values = 4}") == "true, [1,{}]");
  CHECK(limited("decode, '[1,{\"a\":null}]', {max_values = 3}").find("limit, ") == 0);
  CHECK(limited("decode, '[1,{\"a\":null}]', {max_values = 3}")
            .find("clench.json.decode: expected at most 3 values") != std::string::npos);
  CHECK(limited("split, '[1,[2,3,4]]', {max_values = 2}") == "true, [\"1\",\"[2,3,4]\"]");
  CHECK(limited("split, '[1,2,3]', {max_values = 2}")
            .find("clench.json.split: expected at most 2 values") != std::string::npos);
  CHECK(limited("decode, '[1', {max_values = 9}").find("input, ") == 0);
}

TEST_CASE("a text truncated anywhere is rejected or read, and never crashes") {
  Script lua;
  CHECK(lua.run(R"(
    local text = clench.json.encode{a = {1, 2.5, "x\n😀", true, {b = {}}}, c = clench.pose{rpy = {1, 2, 3}}}
    local refused = 0
    for cut = 0, #text - 1 do
      local ok, message = pcall(clench.json.decode, text:sub(1, cut))
      if not ok and message:find("line 1, column", 1, true) then refused = refused + 1 end
    end
    return refused == #text)") == "true");
}
