#!/usr/bin/env bash
# A batch of the fuzzers stores each fault once, and reduces the list of calls: run in a separate folder
# with a simulated program that fails for a bad call and a bad file.
#   bash tests/scripts/fuzz_test.sh       from the project's root
set -eu
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root/tests" "$root/build/fuzz/api-tree" "$root/build/fuzz/files-tree"
cp -r tests/fuzz "$root/tests/"
cp -r scripts "$root/"
cd "$root"

cat >program <<'E2'
#!/usr/bin/env bash
# -q run SCRIPT ARGUMENTS: fails in the way named by $BREAKS
breaks() {
  case "$BREAKS" in
    summary) echo "SUMMARY: AddressSanitizer: heap-use-after-free /x/src/io/a.cpp:7 in f(int)"; exit 1 ;;
    overflow) echo "/x/src/io/a.cpp:7:3: runtime error: 1e+30 is outside the range"; exit 1 ;;
    signal) kill -SEGV $$ ;;
    wait) exit 124 ;;
    finding) echo "FINDING 3 message: f: vector::N"; exit 3 ;;
    *) exit 0 ;;
  esac
}
case "$3" in
  */api.lua)
    printf 'call("v[%d] = f(%d)", "f", %d, true)\n' 1 1 1 2 2 2 >calls.lua
    echo 'call("v[3] = bad(v[1])", "bad", 3, true)' >>calls.lua
    echo 'CALLS 3'
    breaks ;;
  */repeat.lua) if grep -q bad "$4"; then breaks; fi; exit 0 ;;
  */files.lua)
    echo bad >"fuzz-$4.obj"
    if [ "$BREAKS" = finding ]; then mv "fuzz-$4.obj" "found-$4-3.obj"; fi
    breaks ;;
esac
E2
chmod +x program

# batch MODE SEED HOW: its output in `said`, and the stored files in `kept`
batch() { said=$(BREAKS=$3 bash tests/fuzz/batch.sh "$root/program" "$1" "$2" 1000 2>/dev/null); kept=$(ls build/fuzz/found); }
wants() {
  if [[ "$2" != $3 ]]; then printf 'FAILED %s\n  expected: %s\n  got:    %s\n' "$1" "$3" "$2"; exit 1; fi
  echo "ok     $1"
}

batch api 1 nothing
wants "a batch without faults stores nothing" "$said|$kept" "CALLS 3|"
for how in summary overflow signal wait finding; do
  rm -rf build/fuzz/found
  batch api 1 $how
  wants "a $how is found" "$said" "FOUND api-*CALLS 3"
  wants "the calls are reduced to the one that ends in a $how" "$(cat build/fuzz/found/*.lua)" 'call("v\[3\] = bad(v\[1\])", "bad", 3, true)'
  batch api 2 $how
  wants "an equal fault is stored once" "$said" "CALLS 3"
  batch files 1 $how
  wants "the file that causes a $how is stored" "$said|$(cat build/fuzz/found/*.obj)" "FOUND files-*|bad"
  wants "and other files are removed" "$(find build/fuzz/files-tree -name 'fuzz-*' -o -name 'found-*')" ""
done

# the random input of the viewer is one process in a scratch folder
mkdir -p models worlds tests/data/seeds
wanted="-q run $root/tests/fuzz/viewer.lua 5 70 $root/build/fuzz/viewer-tree"
printf '#!/usr/bin/env bash\necho "$* $PWD"; exit 3\n' >program
status=0
said=$(FUZZ_CLENCH=program FUZZ_SEED=5 bash scripts/fuzz viewer 70) || status=$?
wants "the viewer is tested in a scratch folder" "$status $said" "3 $wanted"
