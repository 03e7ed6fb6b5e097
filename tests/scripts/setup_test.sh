#!/usr/bin/env bash
# scripts/setup installs exactly the missing packages, and reports in one sentence why it cannot: run with a
# simulated dpkg-query, apt-get, id and sudo, so that nothing is installed.
#   bash tests/scripts/setup_test.sh       from the project's root
set -eu
bin=$(mktemp -d)
trap 'rm -rf "$bin"' EXIT
for tool in bash cat date dirname env grep mkdir sed tail tee tr true; do ln -s "$(type -P $tool)" "$bin/$tool"; done
export FAKES="$bin"

fake() { printf '#!%s/bash\n%s\n' "$bin" "$2" >"$bin/$1" && chmod +x "$bin/$1"; }
run() { status=0; said=$(PATH="$bin" bash scripts/setup "$@" 2>&1 </dev/null) || status=$?; }
calls() { cat "$bin/calls" 2>/dev/null; rm -f "$bin/calls"; }
wants() {
  if [[ "$2" != *"$3"* ]]; then printf 'FAILED %s\n  expected: %s\n  got:    %s\n' "$1" "$3" "$2"; exit 1; fi
  echo "ok     $1"
}

run
wants "a machine without apt is told what to do" "$status $said" "1 scripts/setup supports Debian 12 with apt-get, which this machine does not have."

fake id 'echo 0'
fake dpkg-query 'shift 3; for p in "$@"; do [[ $p == ccache || $p == doctest-dev ]] || echo "installed $p"; done'
fake apt-get 'echo "apt-get $*" >>"$FAKES/calls"'
run
wants "what is missing is named" "$status $said" "0 Missing Debian packages, to be installed now by apt-get: ccache"
wants "only what is missing is installed" "$(calls)" "install -y --no-install-recommends ccache"
run --test
wants "tests need more" "$(calls)" "install -y --no-install-recommends ccache doctest-dev"

fake apt-get 'echo "apt-get $*" >>"$FAKES/calls"; case "$*" in
  *update*) : >"$FAKES/lists" ;; *) [ -e "$FAKES/lists" ] ;; esac'
run
wants "package lists are fetched when apt does not know a package" "$status $(calls | wc -l)" "0 3"
rm "$bin/lists"
fake apt-get 'echo "no such mirror" >&2; exit 100'
run
wants "a failure shows the output of apt-get" "$status $said" "no such mirror"

fake id 'echo 1000'
run
wants "without root the command to run is given" "$status $said" \
  "run as root: apt-get update && apt-get install -y --no-install-recommends ccache"
fake apt-get 'echo "apt-get $*" >>"$FAKES/calls"'
fake sudo 'echo sudo >>"$FAKES/calls"; exec "$@"'
run
wants "sudo is used where there is one" "$status $(calls | tr '\n' ' ')" "0 sudo sudo apt-get"

fake dpkg-query 'shift 3; for p in "$@"; do echo "installed $p"; done'
run
wants "nothing missing: nothing is called" "$status $said$(calls)" "installed"
run --tset
wants "a misspelt option is rejected" "$status $said" "2 usage: scripts/setup [--test | --bench]"
