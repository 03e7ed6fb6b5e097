// Values of a text file as a tree: scalars, lists and maps, with their lines. Takes 16 bytes per
// value in addition to its text: a tree of "0,0,0" takes eight times the size of the file.
#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "clench/base/error.h"
#include "clench/base/watched.h"

namespace clench {

enum class ValueKind : uint8_t { scalar, list, map };

class ValueTree;

/// A value of a tree, which must outlive it.
class ValueNode {
 public:
  ValueKind kind() const;
  std::string_view text() const;  ///< of a scalar, without its quotes; otherwise empty
  bool quoted() const;
  int line() const;
  size_t size() const;                   ///< items of a list, entries of a map; otherwise 0
  ValueNode item(size_t i) const;        ///< i-th item of a list, or i-th value of a map
  std::string_view key(size_t i) const;  ///< of a map, in the file's order
  /// empty: the map has no such key, or this is not a map
  std::optional<ValueNode> find(std::string_view key) const;
  /// For a message: the scalar in quotes, otherwise "a list of 3", "a map".
  std::string described() const;

 private:
  friend class ValueTree;
  ValueNode(const ValueTree& tree, uint32_t at) : tree_(&tree), at_(at) {}

  const ValueTree* tree_;
  uint32_t at_;
};

/// A tree built value by value in the order of the file; each key of a map is added as a scalar
/// before its value.
class ValueTree {
 public:
  /// file  named in errors; must outlive the construction of the tree
  explicit ValueTree(const std::string& file) : file_(&file) {}

  void scalar(std::string_view text, bool quoted, int line);
  /// throws  Error if lists and maps are nested too deeply
  void open(ValueKind kind, int line);
  /// throws  Error if a key of the map is not a scalar, or appears twice
  void close();
  /// True if a complete value has been read.
  bool complete() const { return open_.empty() && pending_.size() == 1; }
  ValueNode root() const { return {*this, root_at}; }
  /// Call once, after the last value and before the tree is read.
  void finish();

 private:
  friend class ValueNode;
  // lists and maps: first item and number of items; scalars: range of the text
  struct Cell {
    uint32_t begin = 0, size = 0, line = 0;
    ValueKind kind = ValueKind::scalar;
    bool quoted = false;
  };
  struct Open {
    size_t first;  // its first item in pending_
    uint32_t line;
    ValueKind kind;
  };

  static constexpr uint32_t root_at = UINT32_MAX;

  const Cell& cell(uint32_t at) const;
  std::string_view text_of(const Cell& cell) const {
    return std::string_view(texts_).substr(cell.begin, cell.size);
  }
  std::string described(const Cell& cell) const;
  void push(const Cell& cell);
  void check_keys(size_t first) const;

  const std::string* file_;
  std::deque<Cell> cells_, pending_;  // items of a list are contiguous
  std::deque<Open> open_;
  std::string texts_;
  Cell root_;
  StopCheck check_{64};  // per value
};

}  // namespace clench
