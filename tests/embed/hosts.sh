#!/bin/sh
# Installed headers are complete: a host that includes all of them builds with the installed package, and runs. The
# programs of the guide page on embedding build with the build folder, and run.
#   hosts.sh BUILD CMAKE GENERATOR
set -eu
build=$1 cmake=$2 generator=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
step() { "$@" > "$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }; }
build_hosts() {  # NAME SOURCES OPTION...
  name=$1 sources=$2
  shift 2
  step "$cmake" -S tests/embed -B "$folder/$name" -G "$generator" -DHOSTS="$sources" "$@"
  step "$cmake" --build "$folder/$name"
}
step "$cmake" --install "$build" --prefix "$folder/clench"
build_hosts installed host.cpp -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$folder/clench"
grep -q "$folder/clench" "$folder/installed/CMakeCache.txt"
"$folder/installed/host"

# the page's blocks of C++, in their order
awk -v folder="$folder" '/^```cpp$/ { file = folder "/" (++count == 1 ? "engine" : "scripts") ".cpp"; next }
  /^```$/ { file = "" }
  file { print > file }
  END { if (count != 2) { print "docs/guide/embedding.md: expected 2 blocks of C++, got " count + 0; exit 1 } }' docs/guide/embedding.md
build_hosts beside "$folder/engine.cpp;$folder/scripts.cpp" -DCMAKE_BUILD_TYPE=Debug -Dclench_DIR="$build"
"$folder/beside/engine"
"$folder/beside/scripts"

# headers that no public header includes are not installed
if test -e "$folder/clench/include/clench/io/text/xml.h"; then
  echo "io/text/xml.h is installed, which no public header includes"
  exit 1
fi
echo "$(find "$folder/clench/include" -name '*.h' | wc -l) headers"
