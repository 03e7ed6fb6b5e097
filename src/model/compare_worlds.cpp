#include "clench/model/compare_worlds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace clench {

namespace {

constexpr double digits = 1e-12;

bool same(double a, double b) {
  return std::abs(a - b) <= digits * std::max(1.0, std::max(std::abs(a), std::abs(b)));
}

bool same(const Pose& a, const Pose& b) {
  const Pose off = a.inverse() * b;
  const double size = std::max(1.0, a.position.norm());
  return off.position.norm() <= digits * size && off.angle() <= digits;
}

template <class Matrix>
bool same_matrix(const Matrix& a, const Matrix& b) {
  return (a - b).cwiseAbs().maxCoeff() <= digits * std::max(a.cwiseAbs().maxCoeff(), 1e-3);
}

bool same_look(const Appearance& a, const Appearance& b) {
  return a.color == b.color && a.transparency == b.transparency &&
         a.triangle_colors == b.triangle_colors && same_skin(a.skin, b.skin);
}

/// Vertices may be rounded, triangles not.
bool same_shape(const ShapePtr& a, const ShapePtr& b) {
  if (!a || !b) return a == b;
  if (a->hash() == b->hash()) return true;
  const Mesh &one = a->mesh(), &two = b->mesh();
  if (one.triangles != two.triangles || one.vertices.size() != two.vertices.size()) return false;
  for (size_t i = 0; i < one.vertices.size(); ++i)
    if ((one.vertices[i] - two.vertices[i]).norm() > digits * std::max(1.0, a->radius()))
      return false;
  return true;
}

/// Free bodies in their order, then those of each robot: a file may give an adapter a different
/// position among the bodies, but no other role.
std::vector<Id<Body>> by_role(const World& world) {
  std::vector<Id<Body>> out;
  for (const auto id : world.bodies())
    if (!world.body(id).robot) out.push_back(id);
  for (const auto robot : world.robots())
    for (const auto id : world.bodies_of(robot)) out.push_back(id);
  return out;
}

class Comparer {
 public:
  Comparer(const World& a, const World& b)
      : a_(a), b_(b), a_bodies_(by_role(a)), b_bodies_(by_role(b)) {}
  std::vector<std::string> compare();

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    out_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }
  void bodies(Id<Body> a_id, Id<Body> b_id);
  void robots(Id<Robot> a_id, Id<Robot> b_id);
  void frictions();
  void switches();
  bool pairs_off_differ() const;
  std::vector<size_t> bodies_off(const World& world, const std::vector<Id<Body>>& all) const;

  const World &a_, &b_;
  const std::vector<Id<Body>> a_bodies_, b_bodies_;
  std::vector<std::string> out_;
};

void Comparer::bodies(Id<Body> a_id, Id<Body> b_id) {
  const Body &a = a_.body(a_id), &b = b_.body(b_id);
  if (a.name != b.name) add("the name '{}'", a.name);
  if (a_.materials().name(a.material) != b_.materials().name(b.material))
    add("the material of '{}'", a.name);
  if (!same(a.mass, b.mass)) add("the mass of '{}'", a.name);
  if (!same_matrix(a.com, b.com)) add("the center of mass of '{}'", a.name);
  if (!same_matrix(a.inertia_per_mass, b.inertia_per_mass)) add("the inertia of '{}'", a.name);
  if (a.elastic_modulus.has_value() != b.elastic_modulus.has_value() ||
      !same(a.elastic_modulus.value_or(0), b.elastic_modulus.value_or(0)))
    add("the elastic modulus of '{}'", a.name);
  if (!same(a.soft_layer, b.soft_layer)) add("the soft layer of '{}'", a.name);
  if (!same(a.poisson_ratio, b.poisson_ratio)) add("Poisson's ratio of '{}'", a.name);
  if (!same(a.restitution, b.restitution)) add("the restitution of '{}'", a.name);
  if (!same(a.free_damping, b.free_damping) || !same(a.free_friction, b.free_friction) ||
      !same(a.free_armature, b.free_armature))
    add("the resistance to free motion of '{}'", a.name);
  if (!same(a.gravity_compensation, b.gravity_compensation))
    add("the gravity compensation of '{}'", a.name);
  if (a.tracker != b.tracker) add("the position sensor of '{}'", a.name);
  if (!same_look(a.appearance, b.appearance)) add("the color of '{}'", a.name);
  if (!same_shape(a.shape, b.shape)) add("the surface of '{}'", a.name);
  if (!same(a_.pose(a_id), b_.pose(b_id))) add("the pose of '{}'", a.name);
}

bool same_set(const EigengraspSet* a, const EigengraspSet* b) {
  if (!a || !b) return a == b;
  const auto same_vectors = [](const auto& x, const auto& y) {
    return x.has_value() == y.has_value() && (!x || *x == *y);
  };
  if (a->grasps.size() != b->grasps.size() || !same_vectors(a->origin, b->origin) ||
      !same_vectors(a->norm, b->norm))
    return false;
  for (size_t i = 0; i < a->grasps.size(); ++i)
    if (a->grasps[i].vector != b->grasps[i].vector || a->grasps[i].limits != b->grasps[i].limits)
      return false;
  return true;
}

bool same_contacts(const std::vector<VirtualContactSpec>* a,
                   const std::vector<VirtualContactSpec>* b) {
  if (!a || !b) return a == b;
  return std::ranges::equal(*a, *b, [](const auto& x, const auto& y) {
    return x.link == y.link && x.mu == y.mu && x.X_LC == y.X_LC &&
           x.edges.cols() == y.edges.cols() && x.edges == y.edges;
  });
}

void Comparer::robots(Id<Robot> a_id, Id<Robot> b_id) {
  const Robot &a = a_.robot(a_id), &b = b_.robot(b_id);
  if (a.name != b.name) add("the name '{}'", a.name);
  const auto alike_numbers = [](double x, double y) { return same(x, y); };
  if (!std::ranges::equal(a_.dofs(a_id), b_.dofs(b_id), alike_numbers))
    add("the DOFs of '{}'", a.name);
  if (a.dofs.size() != b.dofs.size()) return;
  if (!std::ranges::equal(a.dofs, b.dofs, [](const DofSpec& x, const DofSpec& y) {
        return same(x.default_velocity, y.default_velocity);
      }))
    add("how '{}' closes", a.name);
  const bool alike = std::ranges::equal(a_.own_joint_positions(a_id), b_.own_joint_positions(b_id),
                                        [](const JointPosition& x, const JointPosition& y) {
                                          return x.has_value() == y.has_value() &&
                                                 same(x.value_or(0), y.value_or(0));
                                        });
  if (!alike) add("the joints of '{}' that do not follow their DOFs", a.name);
  if (!same(a.X_BA, b.X_BA)) add("the approach frame of '{}'", a.name);
  if (a.mounting.has_value() != b.mounting.has_value()) add("what carries '{}'", a.name);
  if (!same_set(a.eigengrasps.get(), b.eigengrasps.get())) add("the eigengrasps of '{}'", a.name);
  if (!same_contacts(a.virtual_contacts.get(), b.virtual_contacts.get()))
    add("the virtual contacts of '{}'", a.name);
}

void Comparer::frictions() {
  const MaterialTable &one = a_.materials(), &two = b_.materials();
  const int count = static_cast<int>(one.names().size());
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j <= i; ++j) {
      const auto at = [&](int k) {
        const auto found = std::ranges::find(two.names(), one.name(k));
        return found == two.names().end() ? -1 : static_cast<int>(found - two.names().begin());
      };
      const int k = at(i), l = at(j);
      // of a new material only its friction
      const Friction f = one.friction(i, j), g = k < 0 || l < 0 ? Friction{} : two.friction(k, l);
      if (f.statics != g.statics || f.kinetic != g.kinetic || f.restitution != g.restitution)
        pairs.emplace_back(i, j);
    }
  if (pairs.size() > 3) return add("the friction of {} pairs of materials", pairs.size());
  for (const auto& [i, j] : pairs) add("the friction of {} on {}", one.name(i), one.name(j));
}

template <class Pairs>
static std::vector<std::pair<size_t, size_t>> in_numbers(const Pairs& pairs,
                                                         const std::vector<Id<Body>>& all) {
  std::map<Id<Body>, size_t> numbers;
  for (size_t i = 0; i < all.size(); ++i) numbers[all[i]] = i;
  std::vector<std::pair<size_t, size_t>> out;
  for (const auto& [a, b] : pairs) out.push_back(std::minmax(numbers.at(a), numbers.at(b)));
  std::ranges::sort(out);
  return out;
}

std::vector<size_t> Comparer::bodies_off(const World& world,
                                         const std::vector<Id<Body>>& all) const {
  std::vector<size_t> out;
  for (size_t i = 0; i < all.size(); ++i)
    if (world.settings().switched_off.contains(all[i])) out.push_back(i);
  return out;
}

// Compares pair by pair only if the collision bits differ: there may be millions of pairs.
bool Comparer::pairs_off_differ() const {
  const auto bits = [](const World& world, const std::vector<Id<Body>>& all) {
    std::vector<std::optional<CollisionBits>> out;
    const auto& of = world.settings().collision_bits;
    for (const auto id : all) {
      const auto found = of.find(id);
      out.push_back(found == of.end() ? std::nullopt : std::optional(found->second.first));
    }
    return out;
  };
  if (bits(a_, a_bodies_) != bits(b_, b_bodies_))
    return in_numbers(a_.pairs_off(), a_bodies_) != in_numbers(b_.pairs_off(), b_bodies_);
  const auto beside_bits = [](const WorldSettings& settings) {
    std::set<BodyPair> out = settings.pairs_off;
    std::erase_if(out, [&](const BodyPair& pair) {
      return settings.bits_keep_apart(pair.first, pair.second);
    });
    return out;
  };
  const WorldSettings &a = a_.settings(), &b = b_.settings();
  return in_numbers(beside_bits(a), a_bodies_) != in_numbers(beside_bits(b), b_bodies_) ||
         in_numbers(a.pairs_on, a_bodies_) != in_numbers(b.pairs_on, b_bodies_);
}

void Comparer::switches() {
  if (a_.settings().collision_on != b_.settings().collision_on || pairs_off_differ() ||
      bodies_off(a_, a_bodies_) != bodies_off(b_, b_bodies_))
    add("which bodies may collide");
  if (!same(a_.contact_threshold(), b_.contact_threshold())) add("the contact threshold");
  if (a_.gravity() != b_.gravity()) add("gravity");
  if (a_.dynamic_settings().step != b_.dynamic_settings().step) add("the time step");
  const auto names = [](const Keyframe& keyframe) { return keyframe.name; };
  if (!std::ranges::equal(a_.keyframes(), b_.keyframes(), {}, names, names)) add("the keyframes");
}

std::vector<std::string> Comparer::compare() {
  if (a_bodies_.size() != b_bodies_.size() || a_.robots().size() != b_.robots().size()) {
    add("its number of bodies");
    return std::move(out_);
  }
  // differences of the complete world are not lost among many bodies
  switches();
  for (size_t i = 0; i < a_bodies_.size(); ++i) bodies(a_bodies_[i], b_bodies_[i]);
  for (size_t i = 0; i < a_.robots().size(); ++i) robots(a_.robots()[i], b_.robots()[i]);
  frictions();
  return std::move(out_);
}

}  // namespace

std::vector<std::string> differences(const World& world, const World& other) {
  return Comparer(world, other).compare();
}

}  // namespace clench
