--- Folders of the user in which the viewer stores files: settings, and unsaved work.
local user_files = {}

local function quoted(word) return "'" .. word:gsub("'", "'\\''") .. "'" end

-- <variable>/clench, else <home>/<otherwise>/clench; nil without a home
local function folder(variable, otherwise)
  local given, home = os.getenv(variable), os.getenv "HOME"
  if given and given:sub(1, 1) == "/" then return given .. "/clench" end
  return home and home ~= "" and ("%s/%s/clench"):format(home, otherwise) or nil
end

--- Folder of settings: $XDG_CONFIG_HOME/clench, else ~/.config/clench.
---@return string? folder
function user_files.settings() return folder("XDG_CONFIG_HOME", ".config") end

--- Folder of unsaved work: $XDG_STATE_HOME/clench, else ~/.local/state/clench.
---@return string? folder
function user_files.state() return folder("XDG_STATE_HOME", ".local/state") end

local function make_folder(path) return ("mkdir -p -m 700 %s 2>/dev/null"):format(quoted(path:match "^(.*)/")) end

--- Writes a file, and creates its folder if necessary.
---@param path string
---@param text string
function user_files.save(path, text)
  if pcall(clench.files.save_text, path, text) then return end
  os.execute(make_folder(path))
  clench.files.save_text(path, text)
end

local max_size = 1 << 26  -- [bytes]

--- The text of a file; nil if there is none, or none that can be read, or more than 64 MiB.
function user_files.read(path)
  local file <close> = io.open(path, "rb")
  local text = file and (file:read(max_size + 1) or file:read "a")
  return text and #text <= max_size and text or nil
end

-- is there nothing under this name, neither a file nor a folder?
local function is_free(path)
  local file <close>, _, code = io.open(path, "rb")
  return not file and (code == 2 or code == 20)  -- ENOENT, ENOTDIR: its folder is none
end

--- May this process use a name? It creates an empty file, and of several processes that do so at once only one may. A name where no file can be created is
--- free, too: writing it tells why.
---@return boolean
function user_files.claim(path)
  if not is_free(path) then return false end
  return os.execute(("%s; set -C; { : > %s; } 2>/dev/null"):format(make_folder(path), quoted(path))) == true or is_free(path)
end

--- The absolute path, so that it can be opened from any folder.
function user_files.absolute(path)
  local here = os.getenv "PWD"
  if path:sub(1, 1) == "/" or not here then return path end
  return here .. "/" .. path:gsub("^%./", "")
end

return user_files
