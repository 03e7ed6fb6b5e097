// JSON and buffers of a glTF file; every index, count and byte range is checked before use.
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "clench/base/error.h"
#include "clench/io/mesh/mesh_input.h"
#include "clench/io/text/byte_reader.h"

namespace clench {

/// A value of the file with its path for errors: "meshes[2].primitives[0]".
struct GltfValue {
  const nlohmann::json* json = nullptr;
  std::string name;

  explicit operator bool() const { return json; }
};

class GltfDocument {
 public:
  /// throws Error if it is not glTF 2, or requires an extension that changes its geometry
  explicit GltfDocument(const MeshInput& input);

  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw Error(file_ + ": " + fmt::format(format, std::forward<Args>(args)...));
  }
  /// A member of an object, or null.
  GltfValue member(const GltfValue& object, const char* key) const;
  /// Item i of the file's array of that name, for example "meshes".   throws Error if there is none
  GltfValue item(const char* array, int i, const std::string& expected_by) const;
  int count(const char* array) const;  ///< 0 if there is no such array
  /// Items of an array; empty if there is none.
  std::vector<GltfValue> items(const GltfValue& array) const;
  GltfValue root() const { return {&json_, ""}; }

  int integer(const GltfValue& object, const char* key, int fallback, int low = 0) const;
  int expected_integer(const GltfValue& object, const char* key, int low = 0) const;
  /// `count` finite numbers
  std::vector<double> numbers(const GltfValue& array, int count) const;

  /// Contents of an accessor: `components` finite numbers per element, in order.
  std::vector<double> read_floats(int accessor, int components, const std::string& expected_by);
  std::vector<int> read_indices(int accessor, const std::string& expected_by);

  /// Bytes of an image from a buffer, from the JSON, or from a file.
  std::string image_bytes(int image, const std::string& expected_by);
  /// Total size of the file and of the buffers read so far.
  size_t bytes() const { return bytes_; }

 private:
  struct Span {
    const char* first;
    int count, stride;
    NumberType type;
    bool normalized;
    std::string name;
  };
  Span span(int accessor, const char* shape, int components, const std::string& expected_by);
  std::string bytes_at(const GltfValue& uri) const;
  const std::string& buffer(int i, const std::string& expected_by);
  void split_glb(const std::string& bytes, std::string& text);
  void check_version() const;

  const MeshInput& input_;
  std::string file_;
  nlohmann::json json_;
  bool binary_ = false;     // true for .glb
  std::string glb_buffer_;  // buffer 0 of a .glb
  std::map<int, std::string> buffers_;
  size_t bytes_;
};

}  // namespace clench
