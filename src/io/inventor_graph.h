// Inventor and VRML files as Coin's scene graphs, with the files that they include in their places.
// Included by the inventor files only.
#pragma once
#include <Inventor/errors/SoError.h>
#include <Inventor/nodes/SoSeparator.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "io/read.h"

namespace clench {

/// Coin keeps global state: one reader at a time, its messages caught, a host's handlers put back.
class CoinLease {
 public:
  CoinLease();
  ~CoinLease();
  CoinLease(const CoinLease&) = delete;
  CoinLease& operator=(const CoinLease&) = delete;

  std::string error;  ///< first message of the reader

 private:
  static void on_read_error(const SoError* error, void* self);

  std::lock_guard<std::mutex> lock_;
  SoErrorCB* read_;
  void* read_data_;
  SoErrorCB* debug_;
  void* debug_data_;
};

/// Counts a reference to a node.
template <class T>
class Ref {
 public:
  Ref(T* node = nullptr) : node_(node) {
    if (node_) node_->ref();
  }
  Ref(const Ref& other) : Ref(other.node_) {}
  Ref& operator=(Ref other) {
    std::swap(node_, other.node_);
    return *this;
  }
  ~Ref() {
    if (node_) node_->unref();
  }
  T* get() const { return node_; }

 private:
  T* node_;
};

struct InventorGraph {
  Ref<SoSeparator> root;
  std::map<const SoNode*, std::string> places;  ///< of shapes: "part.iv:31", where that is known

  /// For a sentence on a node: "box.iv:31", "box.iv: part.iv:31" of one in a file that it includes,
  /// or "box.iv" alone.
  std::string place(const SoNode* node, const std::string& file) const;
};

/// The graph of a file. Its lines are `text`; what is not used is told to `warnings`.
/// throws Error  "box.iv:31: ..." when the file or one that it includes is malformed, missing or
/// includes itself
InventorGraph load_graph(CoinLease& coin, const std::filesystem::path& path,
                         const std::string& text, const ReadOptions& options,
                         std::vector<std::string>& warnings);

}  // namespace clench
