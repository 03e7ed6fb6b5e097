// Triangles of an Inventor or VRML file as the Coin library reads and cuts them: what our reader is
// held against. Only for files that are trusted, for Coin is not made for others.
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
  std::string error;  ///< what Coin said first, empty when it read all
};

CoinTriangles read_by_coin(const std::filesystem::path& path);
/// Of a text, which begins with its header.
CoinTriangles read_by_coin(const std::string& text);

}  // namespace clench::test
