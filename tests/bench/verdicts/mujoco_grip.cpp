#include "bench/verdicts/mujoco_grip.h"

#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "support/mujoco.h"

namespace clench::bench {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double time_step = 0.001;     // [s]
constexpr double gravity = 9.81;        // [m/s^2]
constexpr double lift_stiffness = 1e6;  // of the slide that raises the hand [N/m]
// Impedance of couplings: joints of one motor are rigidly coupled. With MuJoCo's default, 0.9 to
// 0.95, the links of light fingers yield by milliradians, and pads touch at one of their ends only.
constexpr const char* rigid = "0.999 0.9999 0.001";

// MJCF of a grip; `lift` adds gravity, the table and a slide under the hand.
class GripFile {
 public:
  GripFile(const GripScene& scene, const StoredGrasp& grasp, double kp, bool lift)
      : scene_(scene), grasp_(grasp), lift_(lift) {
    text_.precision(12);
    std::ostringstream bodies, actuators, couplings;
    for (auto* out : {&bodies, &actuators, &couplings, &assets_}) out->precision(12);
    write_link(0, bodies);
    bodies << "<body name=\"object\"><freejoint/>" << inertial(scene.object);
    write_pieces(scene.object, "contype=\"2\" conaffinity=\"1\"", 0, bodies);
    bodies << "</body>";
    if (lift) write_table(bodies);
    write_drives(kp, actuators, couplings);
    const Vector3d down = lift ? Vector3d(-gravity * scene.table->up) : Vector3d::Zero();
    text_ << "<mujoco><compiler angle=\"radian\" balanceinertia=\"true\" boundmass=\"1e-6\" "
             "boundinertia=\"1e-9\"/><option timestep=\""
          << time_step << "\" gravity=\"" << row(down)
          << "\" cone=\"elliptic\" impratio=\"10\" integrator=\"implicit\">"
             "<flag multiccd=\"enable\"/></option><size "
             "njmax=\"4000\" nconmax=\"1000\"/><asset>"
          << assets_.str() << "</asset><worldbody>" << bodies.str() << "</worldbody><equality>"
          << couplings.str() << "</equality><actuator>" << actuators.str()
          << "</actuator></mujoco>";
  }
  std::string text() const { return text_.str(); }

 private:
  static std::string row(const Vector3d& v) {
    std::ostringstream out;
    out.precision(12);
    out << v.x() << ' ' << v.y() << ' ' << v.z();
    return out.str();
  }
  static std::string placed(const Isometry3d& X) {
    const Eigen::Quaterniond q(X.linear());
    std::ostringstream out;
    out.precision(12);
    out << "pos=\"" << row(X.translation()) << "\" quat=\"" << q.w() << ' ' << q.x() << ' ' << q.y()
        << ' ' << q.z() << '"';
    return out.str();
  }
  static std::string inertial(const GripBody& body) {
    const auto& I = body.inertia;
    std::ostringstream out;
    out.precision(12);
    out << "<inertial pos=\"" << row(body.com) << "\" mass=\"" << std::max(body.mass, 1e-4)
        << "\" fullinertia=\"" << I(0, 0) + 1e-8 << ' ' << I(1, 1) + 1e-8 << ' ' << I(2, 2) + 1e-8
        << ' ' << I(0, 1) << ' ' << I(0, 2) << ' ' << I(1, 2) << "\"/>";
    return out.str();
  }
  // Torsional friction of patches is represented at MuJoCo's contact points; for two touching
  // bodies, MuJoCo uses the larger coefficients and dimension.
  std::string surface(double torsion_radius) const {
    std::ostringstream out;
    out << "condim=\"" << (torsion_radius > 0 ? 4 : 3) << "\" friction=\"" << scene_.mu << ' '
        << scene_.mu * torsion_radius << " 0.0001\" solref=\"" << 4 * time_step
        << " 1\" solimp=\"0.95 0.99 0.0001\"";
    return out.str();
  }
  void write_pieces(const GripBody& body, const std::string& kind, double torsion_radius,
                    std::ostringstream& out) {
    for (const Points& piece : body.pieces) {
      assets_ << "<mesh name=\"piece" << pieces_ << "\" vertex=\"";
      for (const Vector3d& p : piece) assets_ << row(p) << ' ';
      assets_ << "\"/>";
      out << "<geom type=\"mesh\" mesh=\"piece" << pieces_++ << "\" " << kind << ' '
          << surface(torsion_radius) << "/>";
    }
  }
  void write_link(size_t i, std::ostringstream& out) {
    const GripLink& link = scene_.links[i];
    const Isometry3d X =
        i == 0 ? grasp_.pose : scene_.links[link.parent].pose.inverse() * link.pose;
    out << "<body name=\"link" << i << "\" " << placed(X) << '>';
    if (i > 0 || lift_) out << inertial(link.body);
    if (i == 0 && lift_)
      out << "<joint name=\"lift\" type=\"slide\" axis=\""
          << row(grasp_.pose.linear().transpose() * scene_.table->up) << "\"/>";
    if (link.has_joint) write_joint(i, out);
    write_pieces(link.body, "contype=\"1\" conaffinity=\"2\"",
                 grasp_.torsion_radii.empty() ? 0 : grasp_.torsion_radii[i], out);
    for (size_t k = 1; k < scene_.links.size(); ++k)
      if (scene_.links[k].parent == static_cast<int>(i)) write_link(k, out);
    out << "</body>";
  }
  void write_joint(size_t i, std::ostringstream& out) const {
    const GripLink& link = scene_.links[i];
    const GripDof& dof = scene_.dofs[link.dof];
    const Eigen::Matrix3d turn = link.pose.linear().transpose();
    out << "<joint name=\"joint" << i << "\" type=\"" << (link.turns ? "hinge" : "slide")
        << "\" axis=\"" << row(turn * link.axis) << "\" pos=\""
        << row(turn * (link.point - link.pose.translation())) << "\" damping=\"" << dof.damping
        << "\" frictionloss=\"" << dof.friction << "\" armature=\"" << dof.armature << '"';
    const double a = link.ratio * (dof.min - dof.value), b = link.ratio * (dof.max - dof.value);
    if (std::isfinite(a) && std::isfinite(b))
      out << " limited=\"true\" range=\"" << std::min(a, b) << ' ' << std::max(a, b) << '"';
    out << "/>";
  }
  void write_table(std::ostringstream& out) const {
    const Eigen::Quaterniond q =
        Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), scene_.table->up);
    Isometry3d X = Isometry3d::Identity();
    X.linear() = q.toRotationMatrix();
    X.translation() = scene_.table->point;
    out << "<geom type=\"plane\" size=\"1 1 0.1\" contype=\"1\" conaffinity=\"2\" " << placed(X)
        << ' ' << surface(0) << "/>";
  }
  // a servo at the first joint of each DOF, to which its other joints are coupled
  void write_drives(double kp, std::ostringstream& actuators, std::ostringstream& couplings) const {
    std::vector<int> leader(scene_.dofs.size(), -1);
    for (size_t i = 0; i < scene_.links.size(); ++i) {
      const GripLink& link = scene_.links[i];
      if (!link.has_joint) continue;
      const double scale = kp * (link.turns ? 1 : 100);
      actuators << "<position joint=\"joint" << i << "\" kp=\"" << scale << "\"/>";
      actuators << "<velocity joint=\"joint" << i << "\" kv=\"" << 0.04 * scale << "\"/>";
      int& first = leader[link.dof];
      if (first < 0)
        first = static_cast<int>(i);
      else
        couplings << "<joint joint1=\"joint" << i << "\" joint2=\"joint" << first
                  << "\" polycoef=\"0 " << link.ratio / scene_.links[first].ratio
                  << " 0 0 0\" solref=\"" << 2 * time_step << " 1\" solimp=\"" << rigid << "\"/>";
    }
    if (lift_)
      actuators << "<position joint=\"lift\" kp=\"" << lift_stiffness
                << "\"/><velocity joint=\"lift\" kv=\"" << 0.01 * lift_stiffness << "\"/>";
  }

  const GripScene& scene_;
  const StoredGrasp& grasp_;
  bool lift_;
  int pieces_ = 0;
  std::ostringstream text_, assets_;
};

test::MujocoModel compile(const std::string& text) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "grip.xml", static_cast<int>(text.size()));
  std::memcpy(files->filedata[0], text.data(), text.size());
  char why[1000] = "";
  test::MujocoModel out(mj_loadXML("grip.xml", files.get(), why, sizeof why));
  mj_deleteVFS(files.get());
  if (!out) throw std::runtime_error(std::string("MuJoCo: ") + why);
  return out;
}

class MujocoGrip : public Grip {
 public:
  MujocoGrip(const GripScene& scene, const StoredGrasp& grasp, const GripOptions& options,
             bool lift)
      : scene_(scene),
        grasp_(grasp),
        model_(compile(GripFile(scene, grasp, options.kp, lift).text())),
        data_(mj_makeData(model_.get())),
        object_(mj_name2id(model_.get(), mjOBJ_BODY, "object")),
        base_(mj_name2id(model_.get(), mjOBJ_BODY, "link0")) {
    int actuator = 0;
    for (size_t i = 0; i < scene.links.size(); ++i) {
      const GripLink& link = scene.links[i];
      if (!link.has_joint) continue;
      const int joint =
          mj_name2id(model_.get(), mjOBJ_JOINT, ("joint" + std::to_string(i)).c_str());
      const double at = link.ratio * (grasp.dofs[link.dof] - scene.dofs[link.dof].value);
      data_->qpos[model_->jnt_qposadr[joint]] = data_->ctrl[actuator] = at;
      actuator += 2;
      drives_.push_back({model_->jnt_dofadr[joint], link.dof, link.ratio});
    }
    lift_actuator_ = actuator;
    mj_forward(model_.get(), data_.get());
  }

  double step_length() const override { return time_step; }
  void step(double share, const Vector3d& force) override {
    for (const Drive& drive : drives_)
      data_->qfrc_applied[drive.velocity] =
          grasp_.torques.empty() ? 0 : share * grasp_.torques[drive.dof] / drive.ratio;
    for (int k = 0; k < 3; ++k) data_->xfrc_applied[6 * object_ + k] = force[k];
    mj_step(model_.get(), data_.get());
  }
  Isometry3d pose() const override { return pose_of(object_); }
  int contacts() override {
    int count = 0;
    for (int c = 0; c < data_->ncon; ++c) {
      const int a = model_->geom_bodyid[data_->contact[c].geom1],
                b = model_->geom_bodyid[data_->contact[c].geom2];
      count += (a == object_ && b != 0) || (b == object_ && a != 0);
    }
    return count;
  }
  void save() override { saved_.reset(mj_copyData(nullptr, model_.get(), data_.get())); }
  void restore() override { mj_copyData(data_.get(), model_.get(), saved_.get()); }

  Isometry3d in_hand() const { return pose_of(base_).inverse() * pose_of(object_); }
  void raise_to(double height, double speed) {
    data_->ctrl[lift_actuator_] = height, data_->ctrl[lift_actuator_ + 1] = speed;
  }

 private:
  struct Drive {
    int velocity, dof;
    double ratio;
  };
  Isometry3d pose_of(int body) const {
    const double *p = data_->xpos + 3 * body, *q = data_->xquat + 4 * body;
    Isometry3d out = Isometry3d::Identity();
    out.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    out.translation() = Vector3d(p[0], p[1], p[2]);
    return out;
  }

  const GripScene& scene_;
  const StoredGrasp& grasp_;
  test::MujocoModel model_;
  test::MujocoData data_, saved_;
  int object_, base_, lift_actuator_ = 0;
  std::vector<Drive> drives_;
};

}  // namespace

std::unique_ptr<Grip> mujoco_grip(const GripScene& scene, const StoredGrasp& grasp,
                                  const GripOptions& options) {
  return std::make_unique<MujocoGrip>(scene, grasp, options, false);
}

LiftVerdict lift_in_mujoco(const GripScene& scene, const StoredGrasp& grasp,
                           const GripOptions& options) {
  if (!scene.table) throw std::runtime_error("the scene has no table");
  MujocoGrip grip(scene, grasp, options, true);
  const double height = 0.1, lift_seconds = 1.5;  // [m], [s]
  const auto run = [&](double seconds, auto share_at) {
    const int steps = static_cast<int>(std::lround(seconds / time_step));
    for (int i = 1; i <= steps; ++i) {
      const double share = share_at(static_cast<double>(i) / steps);
      grip.step(share, Vector3d::Zero());
    }
  };
  run(options.grip_seconds, [](double part) { return part; });
  run(0.5, [](double) { return 1.0; });
  const Isometry3d gripped = grip.in_hand();
  // height as a cubic function of time: the velocity is 0 at both ends
  run(lift_seconds, [&](double s) {
    grip.raise_to(height * s * s * (3 - 2 * s), height * 6 * s * (1 - s) / lift_seconds);
    return 1.0;
  });
  grip.raise_to(height, 0);
  run(1, [](double) { return 1.0; });
  const Isometry3d now = grip.in_hand();
  LiftVerdict out;
  const Vector3d& com = scene.object.com;
  out.moved = (now * com - gripped * com).norm();
  out.turned = std::abs(Eigen::AngleAxisd(gripped.linear().transpose() * now.linear()).angle());
  out.held = out.moved <= options.max_distance && out.turned <= options.max_angle;
  return out;
}

}  // namespace clench::bench
