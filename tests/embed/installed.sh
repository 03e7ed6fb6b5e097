#!/bin/sh
# Installed headers are whole: a source that includes all of them compiles against nothing else.
#   installed.sh BUILD COMPILER
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$1" --prefix "$folder" > "$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
printf '#include <clench/clench.h>\nint main() { return static_cast<int>(clench::World().bodies().size()); }\n' > "$folder/host.cpp"
"$2" -std=c++20 -fsyntax-only -I"$folder/include" $(pkg-config --cflags eigen3) "$folder/host.cpp"
# what no public header includes is nobody's affair
! test -e "$folder/include/clench/io/text/xml.h"
echo "$(find "$folder/include" -name '*.h' | wc -l) headers"
