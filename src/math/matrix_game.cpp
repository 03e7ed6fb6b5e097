#include "clench/math/matrix_game.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace clench {

namespace {

// The game as a linear program: maximize sum y subject to A'y <= 1 and y >= 0, where A' is the
// transpose with all entries shifted above 0. Its solution is w / value, that of the dual program
// the strategy of the columns over the value.
class GameTableau {
 public:
  GameTableau(std::span<const GameRow> rows, int columns)
      : rows_(static_cast<int>(rows.size())), columns_(columns) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const GameRow& row : rows)
      for (int j = 0; j < columns; ++j) low = std::min(low, row[j]), high = std::max(high, row[j]);
    // entries from 1 to 2: the scale of the game does not matter
    const double span = high > low ? high - low : 1;
    for (int j = 0; j < columns_; ++j) {
      for (int i = 0; i < rows_; ++i) table_[j][i] = 1 + (rows[i][j] - low) / span;
      table_[j][rows_ + j] = 1;
      table_[j][rows_ + columns_] = 1;
      basis_[j] = rows_ + j;
    }
    for (int i = 0; i < rows_; ++i) gain_[i] = 1;
  }

  void solve() {
    // few pivots are needed; the bound of the solution holds after any number of them
    constexpr int max_pivots = 64;
    for (int i = 0; i < max_pivots; ++i)
      if (!improve(i < max_pivots / 2)) return;
  }

  GameSolution strategies() const {
    GameSolution out;
    double sum = 0, dual_sum = 0;
    for (int j = 0; j < columns_; ++j) {
      const double value = std::max(0.0, table_[j][rows_ + columns_]);
      if (basis_[j] < rows_) sum += out.rows[basis_[j]] = value;
      dual_sum += out.columns[j] = std::max(0.0, -gain_[rows_ + j]);
    }
    if (!(sum > 0)) sum = out.rows[0] = 1;
    if (!(dual_sum > 0)) dual_sum = out.columns[0] = 1;
    for (double& w : out.rows) w /= sum;
    for (double& x : out.columns) x /= dual_sum;
    return out;
  }

 private:
  // one pivot; the variable of largest gain enters, or the first of any gain, which cannot cycle
  bool improve(bool largest) {
    constexpr double nothing = 1e-13;
    const int count = rows_ + columns_;
    int enters = -1;
    double most = nothing;
    for (int i = 0; i < count; ++i)
      if (gain_[i] > most) {
        enters = i;
        if (!largest) break;
        most = gain_[i];
      }
    if (enters < 0) return false;
    int leaves = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int j = 0; j < columns_; ++j) {
      if (!(table_[j][enters] > nothing)) continue;
      const double ratio = table_[j][count] / table_[j][enters];
      if (ratio < least || (ratio == least && basis_[j] < basis_[leaves]))
        least = ratio, leaves = j;
    }
    if (leaves < 0) return false;
    pivot(leaves, enters);
    return true;
  }

  void pivot(int row, int column) {
    const int count = rows_ + columns_;
    const double by = table_[row][column];
    for (int i = 0; i <= count; ++i) table_[row][i] /= by;
    for (int j = 0; j < columns_; ++j) {
      const double times = table_[j][column];
      if (j == row || times == 0) continue;
      for (int i = 0; i <= count; ++i) table_[j][i] -= times * table_[row][i];
    }
    const double times = gain_[column];
    for (int i = 0; i < count; ++i) gain_[i] -= times * table_[row][i];
    basis_[row] = column;
  }

  int rows_, columns_;
  double table_[max_game_columns][max_game_rows + max_game_columns + 1] = {};
  double gain_[max_game_rows + max_game_columns] = {};
  int basis_[max_game_columns] = {};
};

}  // namespace

GameSolution solve_game(std::span<const GameRow> rows, int columns) {
  assert(!rows.empty() && rows.size() <= max_game_rows);
  assert(columns >= 1 && columns <= max_game_columns);
  GameTableau tableau(rows, columns);
  tableau.solve();
  GameSolution out = tableau.strategies();
  out.value = -std::numeric_limits<double>::infinity();
  for (int j = 0; j < columns; ++j) {
    double mixed = 0;
    for (size_t i = 0; i < rows.size(); ++i) mixed += out.rows[i] * rows[i][j];
    out.value = std::max(out.value, mixed);
  }
  return out;
}

}  // namespace clench
