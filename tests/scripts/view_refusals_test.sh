#!/bin/bash
# Without a display, OpenGL or space on the disk, and after its file has vanished, the viewer prints one sentence, exits with 1 and leaves no part of a file.
#   view_refusals_test.sh COMMAND       from the project's root
clench=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export FOLDER=$folder
picture=$folder/picture.png
draw=("$clench" view worlds/barrett_mug.wld --root . --size 320x240 --screenshot "$picture")

# refused NAME SENTENCE COMMAND...: the command prints one line, which contains the sentence, and exits with 1
refused() {
  local name="$1" sentence="$2" said code
  shift 2
  said=$(timeout 100 "$@" 2>&1)
  code=$?
  said=$(grep -v '^libEGL warning: \|^$' <<<"$said")  # printed by the driver
  if [ $code != 1 ] || [ "$(wc -l <<<"$said")" != 1 ] || [[ "$said" != "clench view: "*"$sentence"* ]]; then
    printf 'FAILED %s: exit code %s\n%s\n' "$name" "$code" "$said"
    exit 1
  fi
  echo "ok     $name"
}

refused "no display" "the viewer cannot open a window: " env -u DISPLAY -u WAYLAND_DISPLAY "$clench" view worlds/barrett_mug.wld --root .

# libraries that cannot be loaded, and drivers that are missing or too old
for library in libEGL.so.1 libGL.so.1; do
  mkdir "$folder/$library"
  echo "no library" >"$folder/$library/$library"
done
cp "$folder/libGL.so.1/libGL.so.1" "$folder/libGL.so.1/libOpenGL.so.0"
refused "no EGL" "libEGL.so.1 was not found; install the packages libegl1" env LD_LIBRARY_PATH="$folder/libEGL.so.1" "${draw[@]}"
refused "no OpenGL" "neither libOpenGL.so.0 nor libGL.so.1 was found; install the packages libegl1" env LD_LIBRARY_PATH="$folder/libGL.so.1" "${draw[@]}"
refused "no driver" "pictures need EGL and OpenGL 3.3, and " env LIBGL_DRIVERS_PATH=/none __EGL_VENDOR_LIBRARY_DIRS=/none "${draw[@]}"
[ -e "$picture" ] && { echo "FAILED a picture was written"; exit 1; }

# a file that vanishes between two loads, and one that cannot be written
cp worlds/barrett_mug.wld "$folder/gone.wld"
echo 'os.remove(os.getenv "FOLDER" .. "/gone.wld") session:open(os.getenv "FOLDER" .. "/gone.wld", {root = "."})' >"$folder/vanish.lua"
if "${draw[@]}" >/dev/null 2>&1; then
  refused "the file has vanished" "no such file: $folder/gone.wld" "$clench" view "$folder/gone.wld" --root . --script "$folder/vanish.lua" --screenshot "$picture"
  # a limit of the file size, as on a full disk
  echo 'session:run "grasp.autograsp" session:save(os.getenv "FOLDER" .. "/full.wld")' >"$folder/save.lua"
  printf 'ulimit -f 0\nexec "$@"\n' >"$folder/limited.sh"
  refused "the disk is full" "full.wld: the file cannot be written: " bash "$folder/limited.sh" "$clench" view worlds/barrett_mug.wld --root . --script "$folder/save.lua" --screenshot "$picture.png"
  if ls "$folder" | grep -q 'full\|png.png'; then echo "FAILED a part of a file is left"; exit 1; fi
  # what was there before stays
  before=$(md5sum <"$picture")
  refused "the disk is full at a picture" "picture.png: the file cannot be written: " bash "$folder/limited.sh" "${draw[@]}"
  [ "$(md5sum <"$picture")" = "$before" ] || { echo "FAILED the picture has changed"; exit 1; }
else
  echo "skipped: there is no OpenGL"
fi
