#include "clench/io/graspit/grasp_lists.h"
#include "clench/io/text/file_errors.h"

#include "clench/base/convert.h"
#include "clench/base/file.h"
#include "clench/base/text.h"
#include "clench/base/units.h"
#include "clench/io/text/named_number.h"
#include "clench/io/text/number_reader.h"

namespace clench {

namespace fs = std::filesystem;
using Eigen::Vector3d;

static Vector3d direction(const Line& line, const double* x, const char* what) {
  const Vector3d v(x[0], x[1], x[2]);
  const double length = v.stableNorm();
  if (!(length > 1e-9) || !std::isfinite(length))
    line.fail("{}: expected a direction, got ({}, {}, {})", what, x[0], x[1], x[2]);
  return v / length;
}

static Pregrasp read_pregrasp(const Line& line) {
  // find the brackets in order, then the numbers between them
  std::string shape;
  for (const char c : line.text())
    if (c == '[' || c == ']') shape += c;
  const auto words = split_words(line.text(), "[],", 11);
  if (shape != "[][][]" || words.size() != 10 || line.text().front() != '[')
    line.fail("expected [x y z][x y z][x y z] and a spread angle, got {}", in_quotes(line.text()));
  double x[10];
  for (int i = 0; i < 10; ++i) {
    const auto value = parse_number(words[i]);
    if (!value) line.fail("expected a number, got {}", in_quotes(words[i]));
    x[i] = *value;
  }
  return {.point = Vector3d(x[0], x[1], x[2]) * units::millimeter,
          .direction = direction(line, x + 3, "approach direction"),
          .thumb = direction(line, x + 6, "thumb direction"),
          .spread = x[9] * units::degree};
}

std::vector<Pregrasp> read_pregrasps(const fs::path& path, const ReadOptions&) {
  return of_file([&] {
    LineReader lines(path.filename().string(), read_text(path));
    std::vector<Pregrasp> out;
    while (lines.skip_to_full()) out.push_back(read_pregrasp(lines.next().before('#')));
    return out;
  });
}

void write_pregrasps(const std::vector<Pregrasp>& pregrasps, const fs::path& path) {
  std::string out;
  for (const Pregrasp& p : pregrasps) {
    for (const Vector3d& v : {Vector3d(p.point / units::millimeter), p.direction, p.thumb})
      out += fmt::format("[{} {} {}]", v.x(), v.y(), v.z());
    out += fmt::format("{}\n", p.spread / units::degree);
  }
  write_file(path, out);
}

// --- results ---

static constexpr int max_runs = 1'000'000;
static constexpr const char* run_mark = "0 0 0 0 0 0 0 0 -2";

std::vector<GraspSpec> read_planned_grasps(const fs::path& path, const ReadOptions& options) {
  std::vector<GraspSpec> out;
  read_planned_grasps(path.filename().string(), read_text(path),
                      {.add = [&](GraspSpec&& g) { out.push_back(std::move(g)); }}, options);
  return out;
}

void read_planned_grasps(const std::string& file, std::string text, const GraspSink& sink,
                         const ReadOptions& options) {
  of_file([&] {
    GraspCollector list(file, text.size(), sink);
    // nine numbers with separators
    list.expect(text.size() / 17);
    LineReader lines(file, std::move(text));
    int run = -1;
    while (lines.skip_to_full()) {
      options.progress.check();
      const Line line = lines.next().before('#');
      if (line.size() < 9)
        line.fail("expected 9 numbers: x y z qw qx qy qz spread quality, got {}", line.size());
      warn_of_surplus(line, 9, options.diagnostics);
      constexpr const char* names[] = {"x", "y", "z", "qw", "qx", "qy", "qz", "spread", "quality"};
      double x[9];
      for (int i = 0; i < 9; ++i) x[i] = line.number(i, names[i]);
      if (x[8] == -2 && std::all_of(x, x + 8, [](double v) { return v == 0; })) {
        ++run;
        continue;
      }
      const auto q = made_unit({x[3], x[4], x[5], x[6]});
      if (!q)
        line.fail("expected a quaternion of length 1, got ({} {} {} {})", x[3], x[4], x[5], x[6]);
      run = std::max(run, 0);
      GraspSpec grasp;
      grasp.X_OH = Pose{*q, Vector3d(x[0], x[1], x[2]) * units::millimeter};
      grasp.measures["quality"] = x[8];
      grasp.info["run"] = run + 1;
      grasp.info["spread"] = x[7] * units::degree;
      list.add(std::move(grasp));
    }
  });
}

void write_planned_grasps(const std::vector<GraspSpec>& grasps, const fs::path& path) {
  write_file(path, planned_grasps_text(grasps, path.filename().string()));
}

std::string planned_grasps_text(const std::vector<GraspSpec>& grasps, const std::string& file) {
  std::string out;
  int run = 0;
  for (const GraspSpec& g : grasps) {
    if (!g.X_OH) fail("{}: expected grasps with a pose, got one without", file);
    const double number = number_of(g.info, "run", 1);
    // a new run takes one line of the file
    if (!(number >= 1 && number <= max_runs))
      fail("{}: info.run: expected a number from 1 to {}, got {}", file, max_runs, number);
    const int of = floor_int(number);
    if (of < run) fail("{}: expected runs in their order", file);
    for (; run < of; ++run) out += fmt::format("{}\n", run_mark);
    const Vector3d p = g.X_OH->position / units::millimeter;
    const Eigen::Quaterniond& q = g.X_OH->rotation;
    out += fmt::format("{} {} {} {} {} {} {} {} {}\n", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(),
                       q.z(), number_of(g.info, "spread", 0) / units::degree,
                       number_of(g.measures, "quality", 0));
  }
  return out;
}

}  // namespace clench
