#!/usr/bin/env bash
# A test case without assertions fails, and a skipped one ends with the exit code that ctest expects.
#   bash tests/scripts/watched_test.sh PROGRAM     the program of tests/support/watched_cases.cpp
set -eu
program="$1"

# wants CASES CODE TEXT: runs these test cases together
wants() {
  local status=0 said
  said=$("$program" "--test-case=$1" 2>&1) || status=$?
  if [ "$status" != "$2" ] || [[ "$said" != *"$3"* ]]; then
    printf 'FAILED %s\n  expected: %s %s\n  got:    %s %s\n' "$1" "$2" "$3" "$status" "$said"
    exit 1
  fi
  echo "ok     $1"
}

wants "one that checks" 0 "1 passed"
wants "one without a check" 1 "FAILED: 'one without a check' checks nothing"
wants "one that cannot run here" 77 "skipped: for an example"
wants "one that fails before*" 1 "ERROR"
wants "one that checks,one that cannot run here" 77 "skipped: for an example"
wants "one that ch*,one with*,one that cannot*" 1 "checks nothing"
