// Triangles of an Inventor or VRML file as read and cut by the Coin library, for comparison with
// our reader. Only for trusted files, because Coin is not safe with others.
#pragma once
#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace clench::test {

struct CoinTriangle {
  std::array<Eigen::Vector3f, 3> corners;  ///< counter-clockwise seen from outside
  Eigen::Vector3f color;
  float transparency;
};

struct CoinTriangles {
  std::vector<CoinTriangle> list;
  std::string error;  ///< first message of Coin, empty if it read the complete file
};

CoinTriangles read_by_coin(const std::filesystem::path& path);
/// Reads a text, which begins with its header.
CoinTriangles read_by_coin(const std::string& text);

}  // namespace clench::test
