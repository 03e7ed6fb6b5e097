#!/usr/bin/env bash
# scripts/bench configures again after it has installed the libraries for comparison, and writes a table only
# on request: run in a separate folder, with a simulated dpkg-query, cmake and bench program.
#   bash tests/scripts/bench_test.sh       from the project's root
set -eu
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
cp -r scripts "$root/"
mkdir -p "$root/bin" "$root/build/release/tests"
export CALLS="$root/calls" PATH="$root/bin:$PATH"

fake() { printf '#!/usr/bin/env bash\n%s\n' "$2" >"$root/$1" && chmod +x "$root/$1"; }
run() { : >"$CALLS"; status=0; said=$(bash "$root/scripts/bench" "$@" 2>&1 </dev/null) || status=$?; }
wants() {
  if [[ "$2" != $3 ]]; then printf 'FAILED %s\n  expected: %s\n  got:    %s\n' "$1" "$3" "$2"; exit 1; fi
  echo "ok     $1"
}

fake bin/apt-get 'exit 1'
fake bin/dpkg-query 'shift 3; for p in "$@"; do echo "installed $p"; done'
fake bin/cmake 'echo "cmake $*" >>"$CALLS"'
for what in geometry quality; do
  fake build/release/tests/bench_$what 'echo "bench $*" >>"$CALLS"; exit 3'
done
# a build that was configured with the tests, as by scripts/test
: >"$root/build/release/build.ninja"
echo "CLENCH_TESTS:BOOL=ON" >"$root/build/release/CMakeCache.txt"

for what in geometry quality; do
  run $what --check
  wants "$what configures anew, then builds" "$(cat "$CALLS")" "cmake --preset release *cmake --build * bench_$what*"
  wants "$what --check writes no table" "$(tail -n 1 "$CALLS")" "bench --check"
  wants "$what --check fails as its program does" "$status" 3
  run $what --check --record
  wants "$what --record writes one" "$(tail -n 1 "$CALLS")" "bench --check --csv docs/benchmarks/$what.csv"
  run $what
  wants "$what alone writes none" "$(tail -n 1 "$CALLS")" "bench "
done
# the viewer's bench is a script that the command runs
fake build/release/clench 'echo "clench $* $XDG_CONFIG_HOME" >>"$CALLS"; exit 3'
DISPLAY=:7 run view --check --record
wants "view runs with the settings of a new user" "$(tail -n 1 "$CALLS")" "clench -q run tests/bench/view.lua --check --csv docs/benchmarks/view.csv */build/bench_view"
wants "view fails as its program does" "$status" 3
run geometry --chekc
wants "a misspelt option is rejected" "$status $said$(cat "$CALLS")" "2 usage: scripts/bench geometry \[--check\] \[--record\]"
