#include "clench/math/matrix_game.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "clench/base/random.h"

using namespace clench;

namespace {

// payoff guaranteed to the column player's mixture: a lower bound of the value
double against(const std::vector<GameRow>& rows, const GameSolution& s, int columns) {
  double least = std::numeric_limits<double>::infinity();
  for (const GameRow& row : rows) {
    double sum = 0;
    for (int j = 0; j < columns; ++j) sum += s.columns[j] * row[j];
    least = std::min(least, sum);
  }
  return least;
}

}  // namespace

TEST_CASE("matching pennies is fair, and a saddle point has pure strategies") {
  const std::vector<GameRow> pennies = {{1, -1}, {-1, 1}};
  const GameSolution fair = solve_game(pennies, 2);
  CHECK(fair.value == doctest::Approx(0));
  CHECK(fair.rows[0] == doctest::Approx(0.5));
  CHECK(fair.columns[1] == doctest::Approx(0.5));
  const std::vector<GameRow> saddle = {{5, 3, 7}, {2, 1, 0}};
  const GameSolution pure = solve_game(saddle, 3);
  CHECK(pure.value == 2);
  CHECK(pure.rows[1] == 1);
  CHECK(pure.columns[0] == 1);
}

TEST_CASE("random games: both players' mixtures guarantee the same value") {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const int columns = 1 + i % max_game_columns;
    // with degenerate ones: equal rows, rows of few values, of any scale and sign
    const double scale = i % 3 == 0 ? 1e-9 : 1e3;
    std::vector<GameRow> rows(1 + random.bits() % max_game_rows);
    for (GameRow& row : rows)
      for (double& x : row)
        x = scale * (i % 2 ? random.normal() : static_cast<double>(random.bits() % 3) - 1);
    if (i % 5 == 0) rows.back() = rows.front();
    const GameSolution s = solve_game(rows, columns);
    double sum_rows = 0, sum_columns = 0;
    for (const double w : s.rows) CHECK(w >= 0), sum_rows += w;
    for (const double w : s.columns) CHECK(w >= 0), sum_columns += w;
    CHECK(sum_rows == doctest::Approx(1));
    CHECK(sum_columns == doctest::Approx(1));
    CHECK(std::abs(against(rows, s, columns) - s.value) < 1e-10 * scale);
  }
}
