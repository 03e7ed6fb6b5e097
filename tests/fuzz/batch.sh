#!/usr/bin/env bash
# One batch of the fuzzer of the API or of files, in a separate process with limits of time and memory. Faults are
# stored in build/fuzz/found, once per signature: the output, and the file or the reduced list of calls.
#   tests/fuzz/batch.sh PROGRAM api|files SEED CALLS     from the project's root, by scripts/fuzz
# The last line gives the number of calls: CALLS 1000; for files also the format and the number of parsed files: CALLS 1000 iv 300.
set -u
program=$1 mode=$2 seed=$3 calls=$4
root=$PWD found=$PWD/build/fuzz/found
mkdir -p "$found"

export CLENCH_MODELS=. ASAN_OPTIONS=hard_rss_limit_mb=3000:max_allocation_size_mb=3000:allocator_may_return_null=1:handle_sigill=1
export LSAN_OPTIONS=suppressions=$root/tests/support/lsan.supp:print_suppressions=0
# processor time; a batch normally stops after some seconds and its last call. The timeout also ends a batch that waits
# for something else
ulimit -t 100
limited=(timeout 600)
ulimit -c 0

case $mode in
  api)
    folder=build/fuzz/api/$seed
    rm -rf "$folder" && mkdir -p "$folder" && cp -r build/fuzz/api-tree/. "$folder" && cd "$folder" || exit 1
    "${limited[@]}" "$program" -q run "$root/tests/fuzz/api.lua" "$seed" "$calls" >"out" 2>&1
    ;;
  files)
    folder=build/fuzz/files-tree
    cd "$folder" && mkdir -p "../files" || exit 1
    "${limited[@]}" "$program" -q run "$root/tests/fuzz/files.lua" "$seed" "$calls" list >"../files/$seed.out" 2>&1
    ;;
esac
status=$?
out=$([ $mode = api ] && echo out || echo "../files/$seed.out")

# keep SIGNATURE [FILE or STATEMENT]: stores a fault, unless another batch has found the same
keep() {
  local name
  name=$mode-$(printf '%s' "$1" | md5sum | cut -c1-8)
  ( set -o noclobber; printf '%s\n' "$1" >"$found/$name.txt" ) 2>/dev/null || return 0
  printf 'seed %s, exit code %s\n' "$seed" "$status" >>"$found/$name.txt"
  grep -av '^COVERED\|^clench: ' "$out" | tail -c 6000 >>"$found/$name.txt"
  echo "FOUND $name $1"
  if [ $mode = api ]; then
    FUZZ_CLENCH="$program" lua5.4 "$root/tests/fuzz/reduce.lua" "$root/tests/fuzz/repeat.lua" calls.lua "$1" "$found/$name.lua" ${2:-}
  elif [ -f "${2:-}" ]; then
    mv "$2" "$found/$name.${2##*.}"
  fi
}

if [ $status -eq 3 ]; then
  while read -r _ number signature; do
    if [ $mode = api ]; then keep "$signature" "$number"; else keep "$signature" "$(echo found-$seed-$number.*)"; fi
  done < <(grep -a '^FINDING' "$out")
elif [ $status -ne 0 ] && grep -qa 'LeakSanitizer has encountered a fatal error' "$out"; then
  : # the leak checker itself has crashed, as may happen when threads of a driver end
elif [ $status -ne 0 ]; then
  signature=$(lua5.4 "$root/tests/fuzz/crash.lua" "$out" $status)
  case $mode in
    api) keep "$signature" ;;
    files) keep "$signature" "$(find . -name "fuzz-$seed.*" | head -n 1)" ;;
  esac
fi
if [ $mode = api ]; then
  made=$(sed -n 's/^CALLS //p' out)
  grep -a '^COVERED' out
  echo "CALLS ${made:-$(wc -l <calls.lua)}"
  cd "$root" && rm -rf "$folder"
else
  echo "CALLS $(sed -n 's/^CALLS //p' "$out" | grep . || echo 1)"
  find . -name "fuzz-$seed.*" -o -name "found-$seed-*" | xargs -r rm -f
  rm -f "$out"
fi
