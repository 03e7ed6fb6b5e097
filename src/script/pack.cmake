# cmake -DFOLDER=stdlib -DOUT=packed_files.cpp -P pack.cmake: the folder's Lua files as one C++ source.
file(GLOB_RECURSE paths RELATIVE ${FOLDER} ${FOLDER}/*.lua)
list(SORT paths)
set(entries "")
foreach(path IN LISTS paths)
  file(READ ${FOLDER}/${path} text)
  string(FIND "${text}" ")clench_lua\"" clash)
  if(NOT clash EQUAL -1)
    message(FATAL_ERROR "${path}: contains the raw string's closing mark )clench_lua\"")
  endif()
  string(APPEND entries "    {\"${path}\", R\"clench_lua(${text})clench_lua\"},\n")
endforeach()
file(WRITE ${OUT}.new "#include \"clench/script/lua/packed.h\"

namespace clench {

std::span<const PackedFile> packed_files() {
  static const PackedFile files[] = {
${entries}    {\"\", \"\"},
  };
  return {files, std::size(files) - 1};
}

}  // namespace clench
")
file(COPY_FILE ${OUT}.new ${OUT} ONLY_IF_DIFFERENT)
