#!/bin/sh
# Installed headers are whole: a host that includes all of them builds with the installed package, and runs. A build
# folder is found as well.
#   installed.sh BUILD CMAKE GENERATOR
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
step() { "$@" > "$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }; }
step "$2" --install "$1" --prefix "$folder/clench"
step "$2" -S tests/embed -B "$folder/found" -G "$3" -Dclench_DIR="$1"
step "$2" -S tests/embed -B "$folder/host" -G "$3" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$folder/clench"
grep -q "$folder/clench" "$folder/host/CMakeCache.txt"
step "$2" --build "$folder/host"
"$folder/host/host"
# what no public header includes is nobody's affair
if test -e "$folder/clench/include/clench/io/text/xml.h"; then
  echo "io/text/xml.h is installed, which no public header includes"
  exit 1
fi
echo "$(find "$folder/clench/include" -name '*.h' | wc -l) headers"
