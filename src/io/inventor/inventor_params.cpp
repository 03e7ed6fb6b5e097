#include "clench/io/inventor/inventor_params.h"

#include <algorithm>

#include "clench/base/text.h"
#include "clench/base/units.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/text/repairs.h"
#include "clench/spec/inertia.h"
#include "clench/spec/material_names.h"
#include "clench/spec/plausibility.h"

namespace clench {

namespace {

constexpr const char* keys[] = {"material", "youngs", "useFlockOfBirds",
                                "mass",     "cog",    "inertia_matrix"};

/// absent  value used instead of 0; 0: no replacement
double number_of(const Line& line, const Quantity& quantity, Repairs& repairs, double absent = 0) {
  const Place subject = line.place().of(quantity.name);
  double value = repairs.magnitude(line.number(1, quantity.name), subject);
  if (absent > 0) value = repairs.not_zero(value, absent, subject);
  check(quantity, value, line.place().text());
  return value;
}

/// Empty, with a warning, if the inertia is not positive definite.
std::optional<Eigen::Matrix3d> inertia_rows(LineReader& lines, const Line& head,
                                            const ReadOptions& options) {
  // three rows on the next three lines, each after a '#'
  Eigen::Matrix3d rows;
  for (int i = 0; i < 3; ++i) {
    const Line line = lines.next();
    if (!line.text().starts_with('#') || line.number() == head.number())
      line.fail("inertia_matrix: expected row {} of 3 as '#a b c', got {}", i + 1,
                in_quotes(line.text()));
    const Line row = Line(&lines.file(), line.number(), line.text().substr(1)).before('#');
    if (row.size() > 3)
      line.fail("inertia_matrix: expected 3 numbers in a row, got {}", row.size());
    for (int j = 0; j < 3; ++j) {
      const auto value = parse_number(row.word(j));
      if (!value)
        line.fail("inertia_matrix: expected three numbers [mm^2], got {}", in_quotes(row.word(j)));
      rows(i, j) = *value * units::square_millimeter;
    }
  }
  return checked_inertia(rows, head.place(), options.diagnostics);
}

}  // namespace

void read_inventor_params(const std::string& text, const std::string& file,
                          const ReadOptions& options, BodySpec& body) {
  LineReader lines(file, text);
  Repairs repairs(options.diagnostics);
  while (lines.skip_to('#')) {
    const bool marked = lines.begins_with('#');  // without a blank before it
    const Line line = lines.next();
    if (!line.text().starts_with('#')) continue;
    const std::string_view key = line.word(0).substr(1);
    if (!marked) {
      if (std::ranges::count(keys, key))
        options.diagnostics.warn(line.place(),
                                 "#{} is a comment, because it does not begin its line", key);
      continue;
    }
    if (key == "material") {
      errors_at(line, [&] { check_material(line.word(1)); });
      body.material = line.word(1);
      body.material_from = Origin::file;
    } else if (key == "youngs") {
      body.elastic_modulus = number_of(line, elastic_modulus_rule.called("youngs"), repairs);
      if (const std::string doubt = doubt_modulus(*body.elastic_modulus); !doubt.empty())
        options.diagnostics.suspected(line.place(), "youngs {}", doubt);
    } else if (key == "useFlockOfBirds") {
      body.tracker = repairs.count(line.word(1), line.place().of("useFlockOfBirds"));
    } else if (key == "mass") {
      body.mass =
          number_of(line, mass_rule.in("g", units::gram), repairs, BodySpec().mass / units::gram) *
          units::gram;
      body.mass_from = Origin::file;
    } else if (key == "cog") {
      body.com =
          Eigen::Vector3d(line.number(1, "cog"), line.number(2, "cog"), line.number(3, "cog")) *
          units::millimeter;
      check(coordinate_rule.called("cog"), *body.com, line.place().text());
    } else if (key == "inertia_matrix") {
      body.inertia_per_mass = inertia_rows(lines, line, options);
    }
  }
  repairs.tell();
}

}  // namespace clench
