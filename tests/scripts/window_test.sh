#!/bin/bash
# The viewer's window on a display without a screen, driven by mouse and keys: orbit, autograsp, undo, and closing with the question about changes.
# window_test.sh COMMAND: exits with 77 if Xvfb or xdotool is missing
clench=$1
for program in Xvfb xdotool; do
  command -v $program >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
folder=$(mktemp -d)
export WINDOW_TEST=$folder XDG_STATE_HOME=$folder/state XDG_CONFIG_HOME=$folder/config HOME=$folder
children=()
finish() {
  for child in "${children[@]}"; do kill "$child" 2>/dev/null; done
  wait 2>/dev/null
  rm -rf "$folder"
}
trap finish EXIT
fail() { echo "FAILED: $1"; cat "$folder/state.txt" "$folder/said" 2>/dev/null; exit 1; }

Xvfb -displayfd 3 -screen 0 1280x1000x24 3>"$folder/display" >/dev/null 2>&1 &
children+=($!)
for _ in $(seq 100); do [ -s "$folder/display" ] && break; sleep 0.1; done
[ -s "$folder/display" ] || { echo "skipped: Xvfb does not start"; exit 77; }
export DISPLAY=:$(cat "$folder/display")

# an OpenGL version that is too old is rejected in one sentence
said=$(MESA_GL_VERSION_OVERRIDE=2.1 timeout 60 "$clench" view 2>&1)
code=$?
if [ $code != 1 ] || [ "$(wc -l <<<"$said")" != 1 ] || [[ "$said" != *"the viewer needs OpenGL 3.3"* ]]; then fail "OpenGL 2.1: $code $said"; fi
# a console with a window, which it draws
said=$(echo 'view:frame() print(view.frames > 0, session.world)' | timeout 60 "$clench" repl --view 2>&1)
code=$?
if [ $code != 0 ] || [[ "$said" != "true"*"world"* ]]; then fail "repl --view: $code $said"; fi

start() {
  rm -f "$folder/state.txt" "$folder/items.txt"
  "$clench" view "$@" --script tests/scripts/window.lua >"$folder/said" 2>&1 &
  viewer=$!
  children+=($viewer)
}
start worlds/barrett_mug.wld --root .

value() { sed -n "s/^$1 //p" "$folder/state.txt" 2>/dev/null; }
# waits until VALUE is, or is not, a text; at most a minute
until_value() {
  for _ in $(seq 600); do
    now=$(value "$1")
    if [ -n "$now" ]; then
      if [ "$2" = is ] && [ "$now" = "$3" ]; then return; fi
      if [ "$2" = is_not ] && [ "$now" != "$3" ]; then return; fi
    fi
    kill -0 $viewer 2>/dev/null || fail "the window closed before '$1' $2 '$3'"
    sleep 0.1
  done
  fail "expected '$1' $2 '$3', got '$now'"
}
click() {
  for _ in $(seq 600); do
    at=$(sed -n "s/ $1\$//p" "$folder/items.txt" 2>/dev/null | tail -1)
    [ -n "$at" ] && break
    sleep 0.1
  done
  [ -n "$at" ] || fail "there is no '$1' on screen"
  xdotool mousemove $at && sleep 0.3 && xdotool mousedown 1 && sleep 0.1 && xdotool mouseup 1
}

# the title names the file
until_value hash is_not ""
first=$(value hash)
xdotool search --sync --onlyvisible --name '^barrett_mug.wld - Clench$' >/dev/null || fail "the title names the file"

# a picture can be drawn within a frame of the window
until_value picture is "picture of 64 x 48 pixels"

# a drag with the left button turns the camera, and the wheel moves it closer
eye=$(value eye)
xdotool mousemove 500 400 && sleep 0.3 && xdotool mousedown 1 && sleep 0.1 && xdotool mousemove 580 420 && sleep 0.3 && xdotool mouseup 1
until_value eye is_not "$eye"
eye=$(value eye)
xdotool click 4
until_value eye is_not "$eye"

# an idle window draws no frames, and takes little processor time
sleep 1
frames=$(value frames)
ticks() { awk '{print $14 + $15}' /proc/$viewer/stat; }
before=$(ticks)
sleep 3
spent=$(($(ticks) - before))
[ "$(value frames)" = "$frames" ] || fail "an idle window drew frames: $frames, then $(value frames)"

# a key closes the hand, and another reverts that
xdotool key ctrl+g
until_value hash is_not "$first"
until_value modified is true
closed=$(value hash)
xdotool key ctrl+z
until_value hash is "$first"
xdotool key ctrl+shift+z
until_value hash is "$closed"

# text that is typed while frames are slow arrives completely and in order: after a shortcut in the dialog that it opens, after Enter in the console
touch "$folder/slow"
xdotool key ctrl+z
until_value hash is "$first"
xdotool key --delay 5 ctrl+p
xdotool type --delay 5 'auto grasp'
xdotool key --delay 5 Return
until_value hash is "$closed"
click Console
at=$(awk 'NF == 2 && $2 > 800 {print}' "$folder/items.txt" | tail -1)
[ -n "$at" ] || fail "the console has no input line"
xdotool mousemove $at && xdotool click 1
for line in 'first = 12' 'second = "Text, AND text"'; do xdotool type --delay 5 "$line" && xdotool key Return; done
xdotool type --delay 5 'second .. first'
until_value typed is 'second .. first'
drawn=$(value drawn)
xdotool type --delay 5 ' .. "!"'
until_value typed is 'second .. first .. "!"'
[ "$(value drawn)" = "$drawn" ] || fail "typing drew the picture"
xdotool key Return
until_value last is 'Text, AND text12!'
rm "$folder/slow"

# a crash leaves the unsaved work, which the next start offers
for _ in $(seq 300); do ls "$XDG_STATE_HOME"/clench/autosave-*.lua >/dev/null 2>&1 && break; sleep 0.1; done
kill -9 $viewer
wait $viewer 2>/dev/null
start
click Restore
until_value hash is "$closed"
until_value modified is true

# closing asks about unsaved changes: first the window stays, then it closes
xdotool key ctrl+q
click Cancel
sleep 0.5
kill -0 $viewer 2>/dev/null || fail "Cancel closed the window"
xdotool key ctrl+q
click "Don't Save"
for _ in $(seq 100); do kill -0 $viewer 2>/dev/null || break; sleep 0.1; done
kill -0 $viewer 2>/dev/null && fail "the window stays after Don't Save"
wait $viewer
code=$?
[ $code = 0 ] || fail "exit code $code"
[ -s "$folder/said" ] && fail "the window printed something"
echo "the window was opened, used and closed; when idle it took $spent hundredths of a second in 3 s"
