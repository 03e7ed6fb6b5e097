#include "clench/model/world.h"

namespace clench {

// overhead of the standard library for an item of a set or a map
static constexpr size_t node_bytes = 48;

template <class T>
static size_t bytes_of(const std::vector<T>& items) {
  return items.capacity() * sizeof(T);
}

static size_t bytes_of(const std::string& text) { return text.capacity(); }

static size_t bytes_of(const Body& body) {
  return bytes_of(body.name) + bytes_of(body.source) + bytes_of(body.file) +
         bytes_of(body.appearance.triangle_colors) +
         (body.appearance.skin ? body.appearance.skin->bytes() : 0);
}

static size_t bytes_of(const Robot& robot) {
  size_t bytes = bytes_of(robot.source) + bytes_of(robot.file) + bytes_of(robot.dofs) +
                 bytes_of(robot.drives) + bytes_of(robot.limits) + bytes_of(robot.links) +
                 bytes_of(robot.joints) + bytes_of(robot.chains);
  for (const Chain& chain : robot.chains) bytes += bytes_of(chain.links);
  return bytes;
}

size_t WorldModel::bytes() const {
  size_t sum = sizeof *this + bytes_of(bodies) + bytes_of(robots) + bytes_of(body_order) +
               bytes_of(robot_order) + bytes_of(source);
  for (const auto& slot : bodies) sum += bytes_of(slot.value);
  for (const auto& slot : robots) sum += bytes_of(slot.value);
  const size_t names = counts.size() + body_names.size() + robot_names.size();
  return sum + names * (node_bytes + sizeof(std::string));
}

size_t WorldSettings::bytes() const {
  // a row for each material
  const size_t names = materials.names().size();
  return sizeof *this + switched_off.size() * (node_bytes + sizeof(Id<Body>)) +
         (pairs_off.size() + pairs_on.size()) * (node_bytes + 2 * sizeof(Id<Body>)) +
         collision_bits.size() * (node_bytes + sizeof(decltype(collision_bits)::value_type)) +
         names * (sizeof(std::string) + names * sizeof(Friction));
}

size_t WorldState::bytes() const {
  return bytes_of(X_WB) + bytes_of(dofs) + bytes_of(joints) + bytes_of(follows_dof) +
         (dynamics ? dynamics->bytes() : 0);
}

size_t World::bytes() const {
  return sizeof *this + model_->bytes() + settings_->bytes() + state_.bytes() +
         scratch_.context.bytes();
}

size_t DynamicState::bytes() const {
  size_t sum = sizeof *this + bytes_of(twists) + bytes_of(solved) + bytes_of(dof_velocities) +
               bytes_of(joint_velocities) + bytes_of(controls) + bytes_of(dof_efforts) +
               bytes_of(loads) + bytes_of(manifolds) + bytes_of(sweep_poses) + bytes_of(row_forces);
  for (const Manifold& m : manifolds) sum += bytes_of(m.points);
  return sum;
}

}  // namespace clench
