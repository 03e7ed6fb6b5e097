--- Finds the library three.js, which pages with a 3-D view include, as installed by Debian's package libjs-three.
local places = {"/usr/share/javascript/three/three.min.js", "/usr/share/javascript/three/build/three.min.js",
                "/usr/share/nodejs/three/build/three.min.js"}

---@param candidates? string[]  files to look for, in order
---@return string? text, string? missing  message if no file was found
return function(candidates)
  for _, path in ipairs(candidates or places) do
    local file = io.open(path, "rb")
    local text = file and file:read "a"
    if file then file:close() end
    if text and text:find("THREE", 1, true) then return text end
  end
  return nil, "a page with a 3-D view needs three.js, which is not installed: apt-get install libjs-three"
end
