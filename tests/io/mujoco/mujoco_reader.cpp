#include "mujoco_reader.h"
#include "support/mujoco.h"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>

namespace clench::test {

namespace {

using Eigen::Map;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using RowMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

std::string name_of(const mjModel& m, int type, int id) {
  const char* name = mj_id2name(&m, type, id);
  return name ? name : '#' + std::to_string(id);
}

/// Moves followers of joint equalities to their positions: q1 - ref1 = poly(q2 - ref2).
void apply_equalities(const mjModel& m, mjData& d) {
  for (int e = 0; e < m.neq; ++e) {
    if (m.eq_type[e] != mjEQ_JOINT || !m.eq_active[e]) continue;
    const double* c = m.eq_data + mjNEQDATA * e;
    const int first = m.jnt_qposadr[m.eq_obj1id[e]];
    const int leader = m.eq_obj2id[e] < 0 ? -1 : m.jnt_qposadr[m.eq_obj2id[e]];
    const double x = leader < 0 ? 0 : d.qpos[leader] - m.qpos0[leader];
    d.qpos[first] = m.qpos0[first] + c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])));
  }
}

JointFacts joint_facts(const mjModel& m, const mjData& d, int j) {
  JointFacts out;
  out.name = name_of(m, mjOBJ_JOINT, j);
  out.body = name_of(m, mjOBJ_BODY, m.jnt_bodyid[j]);
  using Kind = JointFacts::Kind;
  const int type = m.jnt_type[j], dof = m.jnt_dofadr[j], q = m.jnt_qposadr[j];
  out.kind = type == mjJNT_HINGE   ? Kind::hinge
             : type == mjJNT_SLIDE ? Kind::slide
             : type == mjJNT_BALL  ? Kind::ball
                                   : Kind::free;
  out.axis_W = Map<const Vector3d>(d.xaxis + 3 * j);
  out.anchor_W = Map<const Vector3d>(d.xanchor + 3 * j);
  if (m.jnt_limited[j]) out.range = {m.jnt_range[2 * j], m.jnt_range[2 * j + 1]};
  if (type == mjJNT_HINGE || type == mjJNT_SLIDE) {
    out.ref = m.qpos0[q];
    out.rest = m.qpos_spring[q];
  }
  out.damping = m.dof_damping[dof];
  out.friction = m.dof_frictionloss[dof];
  out.armature = m.dof_armature[dof];
  out.stiffness = m.jnt_stiffness[j];
  for (int a = 0; a < m.nu; ++a)
    if (m.actuator_trntype[a] == mjTRN_JOINT && m.actuator_trnid[2 * a] == j &&
        m.actuator_ctrllimited[a])
      out.range_compared = false;
  for (int e = 0; e < m.neq; ++e)
    if ((m.eq_type[e] == mjEQ_JOINT && (m.eq_obj1id[e] == j || m.eq_obj2id[e] == j)) ||
        m.eq_type[e] == mjEQ_TENDON)
      out.range_compared = false;
  return out;
}

BodyFacts body_facts(const mjModel& m, const mjData& d, int b) {
  BodyFacts out;
  out.name = name_of(m, mjOBJ_BODY, b);
  const double* q = d.xquat + 4 * b;
  out.X_WB = {Quaterniond(q[0], q[1], q[2], q[3]), Vector3d(d.xpos + 3 * b)};
  out.mass = m.body_mass[b];
  out.com_W = Map<const Vector3d>(d.xipos + 3 * b);
  const Matrix3d R = Map<const RowMatrix>(d.ximat + 9 * b);
  out.inertia_W = R * Vector3d(m.body_inertia + 3 * b).asDiagonal() * R.transpose();
  out.parent = name_of(m, mjOBJ_BODY, m.body_parentid[b]);
  return out;
}

/// Loads a file with the defaults of MuJoCo 3 for `autolimits` and, if `exact`, the volumes of
/// meshes.   returns  null, with the error, if MuJoCo rejects it
MujocoModel load(const std::filesystem::path& path, bool exact, std::string& error) {
  std::ifstream file(path);
  std::stringstream stream;
  stream << file.rdbuf();
  std::string text = stream.str();
  const size_t root = text.find("<mujoco"), end = text.find('>', root);
  if (root == std::string::npos || end == std::string::npos || text[end - 1] == '/') {
    error = "no element <mujoco> with content";
    return nullptr;
  }
  text.insert(end + 1, exact ? "<compiler autolimits='true' exactmeshinertia='true'/>"
                             : "<compiler autolimits='true'/>");
  // a file of that name in memory; all others are on disk
  const auto vfs = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs.get());
  const std::string name = path.filename().string();
  mj_makeEmptyFileVFS(vfs.get(), name.c_str(), static_cast<int>(text.size()));
  const int slot = mj_findFileVFS(vfs.get(), name.c_str());
  std::memcpy(vfs->filedata[slot], text.data(), text.size());
  char sentence[1000] = "";
  MujocoModel out(mj_loadXML(path.c_str(), vfs.get(), sentence, sizeof sentence));
  mj_deleteVFS(vfs.get());
  if (!out) error = *sentence ? sentence : "unknown error";
  return out;
}

}  // namespace

ModelFacts read_by_mujoco(const std::filesystem::path& path) {
  mju_user_warning = [](const char*) {};
  ModelFacts out;
  bool exact = true;
  auto m = load(path, exact, out.error);
  if (!m) m = load(path, exact = false, out.error);
  if (!m) return out;
  out.error.clear();
  const MujocoData d(mj_makeData(m.get()));
  mj_resetData(m.get(), d.get());
  apply_equalities(*m, *d);
  mj_kinematics(m.get(), d.get());
  for (int b = 1; b < m->nbody; ++b) out.bodies.push_back(body_facts(*m, *d, b));
  // otherwise the volume of a mesh is that of a box of the same inertia; a total mass spreads the
  // error
  for (int g = 0; g < m->ngeom && !exact; ++g)
    if (m->geom_type[g] == mjGEOM_MESH)
      for (BodyFacts& body : out.bodies) body.weighed = false;
  for (int j = 0; j < m->njnt; ++j) out.joints.push_back(joint_facts(*m, *d, j));
  return out;
}

}  // namespace clench::test
