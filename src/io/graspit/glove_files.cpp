#include "clench/io/graspit/glove_files.h"
#include "clench/io/text/file_errors.h"

#include "clench/base/units.h"
#include "clench/io/text/number_reader.h"

namespace clench {

namespace fs = std::filesystem;

static constexpr int max_entries = 1000;  // limit of DOFs and of sensors of a glove

GloveCalibration read_glove_calibration(const fs::path& path, const ReadOptions& options) {
  return of_file([&] {
    LineReader lines(path.filename().string(), read_text(path));
    NumberReader numbers(lines);
    const int dofs = numbers.integer("number of DOFs", 1, max_entries);
    const int sensors = numbers.integer("number of sensors", 1, max_entries);
    // grows with the contents of the file, not with the count that it claims
    std::vector<double> slopes;
    for (int d = 0; d < dofs; ++d)
      for (int s = 0; s < sensors; ++s)
        slopes.push_back(numbers.number(fmt::format("DOF {}: slope {}", d + 1, s + 1)));
    GloveCalibration out;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    out.slopes = Eigen::Map<const Rows>(slopes.data(), dofs, sensors);
    out.intercepts = numbers.numbers(dofs, "intercepts");
    numbers.finish(options.diagnostics);
    return out;
  });
}

// a flag, followed by n items if it is 1
template <class Item>
static std::vector<Item> optional_list(NumberReader& numbers, int n, const std::string& what,
                                       Item (*read)(NumberReader&, const std::string&)) {
  std::vector<Item> out;
  if (numbers.integer(what + ": flag", 0, 1) == 1)
    for (int i = 0; i < n; ++i) out.push_back(read(numbers, fmt::format("{} {}", what, i + 1)));
  return out;
}

static int read_whole(NumberReader& numbers, const std::string& what) {
  return numbers.integer(what);
}
static int read_dof(NumberReader& numbers, const std::string& what) {
  return numbers.integer(what, -1, max_entries);
}
static double read_real(NumberReader& numbers, const std::string& what) {
  return numbers.number(what);
}

static GlovePose read_pose(NumberReader& numbers, const std::string& what) {
  GlovePose pose;
  const int n = numbers.integer(what + ": size", 0, max_entries);
  const double distance = numbers.number(what + ": distance") * units::millimeter;
  if (distance >= 0) pose.distance = distance;
  pose.sensors = optional_list(numbers, n, what + ": sensor", read_whole);
  pose.dof_of_sensor = optional_list(numbers, n, what + ": DOF of sensor", read_dof);
  pose.joints = optional_list(numbers, n, what + ": joint", read_real);
  // the only file format that writes x y z w
  const Eigen::VectorXd q = numbers.numbers(4, what + ": rotation");
  const auto unit = made_unit({q[3], q[0], q[1], q[2]});
  if (!unit)
    numbers.line().fail("{}: rotation: expected a quaternion of length 1, got ({} {} {} {})", what,
                        q[0], q[1], q[2], q[3]);
  pose.pose.rotation = *unit;
  pose.pose.position = numbers.vector(what + ": translation") * units::millimeter;
  return pose;
}

std::vector<GlovePose> read_glove_poses(const fs::path& path, const ReadOptions& options) {
  return of_file([&] {
    LineReader lines(path.filename().string(), read_text(path));
    NumberReader numbers(lines);
    const int count = numbers.integer("number of poses", 0);
    std::vector<GlovePose> poses;
    for (int i = 0; i < count; ++i)
      poses.push_back(read_pose(numbers, fmt::format("pose {}", i + 1)));
    numbers.finish(options.diagnostics);
    return poses;
  });
}

}  // namespace clench
