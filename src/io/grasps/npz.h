// Arrays of NumPy in a file: .npy arrays of numbers or texts in a zip archive, as np.savez and
// np.savez_compressed write it.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace clench {

/// An array, the last index running fastest: of numbers, or of texts.
struct NpyArray {
  std::vector<size_t> shape = {};
  std::vector<double> numbers = {};
  std::vector<std::string> texts = {};
  bool is_text = false;
};

/// Numbers as float64, texts as UTF-32. The same arrays give the same bytes.
/// compress  as np.savez_compressed does
/// source    NumPy enhancement proposal 1 (format 1.0 of .npy)
std::string npz_bytes(const std::map<std::string, NpyArray>& arrays, bool compress = false);

/// Numbers of all of NumPy's real types become doubles. Arrays take at most the memory of a
/// MemoryBudget, as no two of them share bytes of the file.
/// Rows of an array without numbers are not counted: its shape may have any number of them.
/// throws Error  "g.npz: poses: the array's checksum is wrong"
std::map<std::string, NpyArray> read_npz(const std::string& file, std::string_view bytes);

}  // namespace clench
