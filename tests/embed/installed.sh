#!/bin/sh
# Installed headers are whole: a host that includes all of them builds with the installed package, and with the build
# folder, and runs.
#   installed.sh BUILD CMAKE GENERATOR
set -eu
build=$1 cmake=$2 generator=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
step() { "$@" > "$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }; }
step "$cmake" --install "$build" --prefix "$folder/clench"
build_host() {  # NAME OPTION...
  name=$1
  shift
  step "$cmake" -S tests/embed -B "$folder/$name" -G "$generator" "$@"
  step "$cmake" --build "$folder/$name"
  "$folder/$name/host"
}
build_host installed -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$folder/clench"
grep -q "$folder/clench" "$folder/installed/CMakeCache.txt"
build_host beside -DCMAKE_BUILD_TYPE=Debug -Dclench_DIR="$build"
# what no public header includes is nobody's affair
if test -e "$folder/clench/include/clench/io/text/xml.h"; then
  echo "io/text/xml.h is installed, which no public header includes"
  exit 1
fi
echo "$(find "$folder/clench/include" -name '*.h' | wc -l) headers"
