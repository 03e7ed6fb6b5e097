#include "io/dh_robot.h"

#include "base/error.h"
#include "base/text.h"
#include "io/denavit_hartenberg.h"

namespace clench {

namespace {

// a common normal further away than this is told [m]
constexpr double far_away = 100;

class DhMaker {
 public:
  DhMaker(const RobotSpec& robot, const std::string& file,
          const std::function<void(const std::string&)>& warn)
      : from_(robot), file_(file), warn_(warn), robot_(robot) {}
  RobotSpec make();

 private:
  void make_chain(int number);
  Pose base_of(const ChainSpec& chain, int number) const;
  /// of the frame that a part has now, in the one it gets; identity: it keeps it
  const Pose& moved(const RobotPart& part) const {
    static const Pose none;
    return part.chain < 0 ? none : moved_[part.chain][part.link];
  }
  void move_sensors();
  void move_tendons();

  const RobotSpec& from_;
  const std::string& file_;
  const std::function<void(const std::string&)>& warn_;
  RobotSpec robot_;
  std::vector<std::vector<Pose>> moved_;  // by chain, by link
};

void move_body(BodySpec& body, const Pose& X) {
  if (body.shape) {
    Mesh mesh = body.shape->mesh();
    for (auto& v : mesh.vertices) v = X * v;
    body.shape = Shape::make(std::move(mesh), body.name);
  }
  if (body.com || !body.shape) body.com = X * com_of(body);
  const Eigen::Matrix3d R = X.matrix();
  if (body.inertia_per_mass)
    body.inertia_per_mass = Eigen::Matrix3d(R * *body.inertia_per_mass * R.transpose());
  body.file.clear();  // what it holds is no longer this
}

/// Of a chain in the base: links between that cannot move are part of it.
Pose DhMaker::base_of(const ChainSpec& chain, int number) const {
  Pose X = chain.X_BC;
  for (const ChainSpec* at = &chain; at->parent_chain >= 0;) {
    const ChainSpec& parent = from_.chains[at->parent_chain];
    const LinkSpec& link = parent.links[at->parent_link];
    if (link.last_joint >= 0)
      fail(
          "{}: chain {} begins on link '{}' of another; .cfg and .xml hold only chains that begin "
          "on the base, .urdf holds all",
          file_, number, excerpt(link.body.name));
    X = parent.X_BC * link.X_JL.value_or(Pose{}) * X;
    at = &parent;
  }
  return X;
}

void DhMaker::make_chain(int number) {
  const ChainSpec& from = from_.chains[number];
  ChainSpec& chain = robot_.chains[number];
  const DhChain dh = denavit_hartenberg(from, base_of(from, number));
  chain.parent_chain = chain.parent_link = -1;
  chain.X_BC = dh.X_BC;
  chain.joints = dh.joints;
  moved_.push_back(dh.X_JL);
  std::vector<std::string> frames;  // names of those that are nothing else
  for (size_t l = 0; l < chain.links.size(); ++l) {
    chain.links[l].X_JL.reset();
    if (dh.X_JL[l] == Pose{}) continue;
    BodySpec& body = chain.links[l].body;
    if (!body.shape) frames.push_back(in_quotes(body.name));
    move_body(body, dh.X_JL[l]);
  }
  if (!frames.empty() && warn_)
    warn_(fmt::format("{} does not hold where links without a surface have their frames: {}", file_,
                      name_list(frames)));
  if (dh.farthest > far_away && warn_)
    warn_(
        fmt::format("{}: chain {}: two of its axes are so nearly parallel that their common "
                    "normal lies {:.3g} m away",
                    file_, number, dh.farthest));
}

void DhMaker::move_sensors() {
  robot_.tactile.clear();
  int lost = 0;
  for (TactileSpec sensor : from_.tactile) {
    const Pose& X = moved(sensor.part);
    if (!(X.rotation.coeffs() == Pose{}.rotation.coeffs())) {
      ++lost;
      continue;
    }
    sensor.low_L += X.position;
    sensor.high_L += X.position;
    robot_.tactile.push_back(sensor);
  }
  if (lost && warn_)
    warn_(fmt::format("{} does not hold {} tactile sensors: their links have other axes in it",
                      file_, lost));
}

void DhMaker::move_tendons() {
  for (auto& tendon : robot_.tendons)
    for (auto& point : tendon.points) point.p_L = moved(point.part) * point.p_L;
  for (auto& wrapper : robot_.wrappers) {
    const Pose& X = moved(wrapper.part);
    if (X == Pose{}) continue;
    wrapper.p_L = X * wrapper.p_L;
    wrapper.axis_L = X.rotation * wrapper.axis_L;
    for (auto& side : wrapper.sides) side.direction_L = X.rotation * side.direction_L;
  }
}

RobotSpec DhMaker::make() {
  for (int c = 0; c < static_cast<int>(from_.chains.size()); ++c) make_chain(c);
  if (robot_.virtual_contacts)
    for (auto& contact : robot_.virtual_contacts->contacts)
      if (const Pose& X = moved({contact.chain, contact.link}); !(X == Pose{}))
        contact.X_LC = X * contact.X_LC;
  move_sensors();
  move_tendons();
  return std::move(robot_);
}

}  // namespace

RobotSpec dh_robot(const RobotSpec& robot, const std::string& file,
                   const std::function<void(const std::string&)>& warn) {
  return DhMaker(robot, file, warn).make();
}

}  // namespace clench
