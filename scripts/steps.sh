# Sourced by the other scripts: a step is one line with its duration; its output is written to a log, which is
# shown if the step fails.

if [ -t 1 ]; then on_terminal=1; else on_terminal=; fi

microseconds() { local now="$EPOCHREALTIME"; echo "${now/[.,]/}"; }

# since START: seconds since START, a value of `microseconds`, with one decimal
since() {
  local tenths=$((($(microseconds) - $1 + 50000) / 100000))
  echo "$((tenths / 10)).$((tenths % 10)) s"
}

# report NAME TEXT: prints the line of a finished step
report() { printf '%-16s %s\n' "$1" "$2"; }

# step NAME LOG COMMAND...: runs the command; the terminal shows its last line of output meanwhile
step() {
  local name="$1" log="$2" start status=0
  shift 2
  start=$(microseconds)
  mkdir -p "$(dirname "$log")"
  if [ "$on_terminal" ]; then
    "$@" 2>&1 </dev/null | tee "$log" | last_line "$name"
    status=${PIPESTATUS[0]}
  else
    printf '%-16s ' "$name"
    "$@" >"$log" 2>&1 </dev/null || status=$?
  fi
  if [ "$status" -ne 0 ]; then
    echo "failed after $(since "$start"); from $log:"
    # compilers and ctest name the fault after FAILED, other programs at the end
    if grep -q '^FAILED' "$log"; then grep -m1 -A60 '^FAILED' "$log"; else tail -n 60 "$log"; fi
    exit 1
  fi
  if [ "$on_terminal" ]; then printf '\r\e[K%-16s ' "$name"; fi
  since "$start"
}

# last_line NAME: shows each line of its input in place of the previous one, cut to the terminal's width
last_line() {
  local line width
  width=$(tput cols 2>/dev/null || echo 80)
  printf '%-16s ' "$1"
  while IFS= read -r line; do printf '\r\e[K%-16s %s' "$1" "${line:0:width-18}"; done
  printf '\r\e[K%-16s ' "$1"
}

# configure PRESET: writes the build files, with the tests, if there are none, or if they lack the tests
configure() {
  if [ ! -f "build/$1/build.ninja" ] || [ CMakePresets.json -nt "build/$1/build.ninja" ] ||
     ! grep -q '^CLENCH_TESTS:BOOL=ON$' "build/$1/CMakeCache.txt"; then
    configure_anew "$1"
  fi
}

# configure_anew PRESET: writes the build files, with all libraries that are installed now
configure_anew() { step "configure $1" "build/configure_$1.log" cmake --preset "$1" -DCLENCH_TESTS=ON; }
