// Two-person zero-sum matrix games of at most four columns.
// source  Dantzig (1951), A proof of the equivalence of the programming and the game problem
#pragma once
#include <array>
#include <span>

namespace clench {

inline constexpr int max_game_columns = 4;
inline constexpr int max_game_rows = 32;

using GameRow = std::array<double, max_game_columns>;

/// Mixed strategies of the row player, who minimizes, and of the column player, who maximizes: both
/// are >= 0 and sum to 1.
struct GameSolution {
  /// the largest payoff of the column player against `rows`: an upper bound of the game's value
  /// even for an inexact solution, and equal to it up to rounding
  double value = 0;
  std::array<double, max_game_rows> rows{};
  GameRow columns{};
};

/// Minimum over mixtures of rows of the largest entry of the mixture.
/// rows     1 to max_game_rows, finite; only the first `columns` entries of each are read
/// columns  1 to max_game_columns
GameSolution solve_game(std::span<const GameRow> rows, int columns);

}  // namespace clench
