// Zip archives of .npy files in memory, stored or deflated, as written by NumPy.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "clench/io/text/memory_budget.h"

namespace clench {

/// A file in an archive.
struct ZipEntry {
  std::string name;         ///< without the ending .npy
  std::string_view packed;  ///< its bytes in the archive, which must outlive it
  size_t size = 0;          ///< of its contents
  uint32_t checksum = 0;    ///< of its contents
  bool is_deflated = false;
};

/// files     by their names without the ending .npy
/// compress  deflates files that become smaller by it; the others are stored
/// Equal files give equal bytes (compressed ones with the same version of zlib).
/// throws    Error if there are more than 65,000 files or 4 GB
/// source    PKWARE's APPNOTE (zip); RFC 1951 (deflate)
std::string zip_bytes(const std::map<std::string, std::string>& files, bool compress);

/// The files of an archive in the order of its directory. No two share bytes.
/// throws  Error "g.npz: poses: the array shares bytes of the archive with others"
std::vector<ZipEntry> zip_entries(const std::string& archive, std::string_view bytes);

/// Decompresses the files of an archive one by one into one buffer.
class Unzipper {
 public:
  explicit Unzipper(MemoryBudget& budget) : budget_(budget) {}

  /// The contents, valid until the next call.
  /// place   of the file, for errors
  /// throws  Error if they are corrupt, or take more memory than the budget has left
  std::string_view contents_of(const ZipEntry& entry, const std::string& place);

 private:
  MemoryBudget& budget_;
  std::string buffer_;
};

}  // namespace clench
