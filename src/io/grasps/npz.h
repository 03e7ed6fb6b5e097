// Files of NumPy arrays: .npy arrays of numbers or texts in a zip archive, as written by np.savez
// and np.savez_compressed.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace clench {

/// An array of numbers or of texts; the last index varies fastest.
struct NpyArray {
  std::vector<size_t> shape = {};
  std::vector<double> numbers = {};
  std::vector<std::string> texts = {};
  bool is_text = false;
};

/// Writes numbers as float64 and texts as UTF-32. Equal arrays give equal bytes.
/// compress  as np.savez_compressed does
/// source    NumPy enhancement proposal 1 (format 1.0 of .npy)
std::string npz_bytes(const std::map<std::string, NpyArray>& arrays, bool compress = false);

/// Numbers of all real types of NumPy are converted to double. The memory of arrays is limited by a
/// MemoryBudget; no two arrays may share bytes of the file. Rows of an array without numbers are
/// not counted: its shape may contain any number of them.
/// throws Error  "g.npz: poses: the array's checksum is wrong"
std::map<std::string, NpyArray> read_npz(const std::string& file, std::string_view bytes);

}  // namespace clench
