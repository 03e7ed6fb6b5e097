#include "clench/model/near_bodies.h"

#include <algorithm>
#include <array>
#include <set>

namespace clench {

using Eigen::Vector3d;

double sphere_gap(const World& world, Id<Body> a, Id<Body> b) {
  const Shape &one = *world.body(a).shape, &two = *world.body(b).shape;
  const Vector3d between = world.pose(a) * one.centre() - world.pose(b) * two.centre();
  return between.norm() - one.radius() - two.radius();
}

namespace {

// A body of a list.
struct Item {
  BodyBox box;
  int position;  // in its list
  bool second;   // of the two lists
};

void add_items(const World& world, std::span<const Id<Body>> list, bool second,
               QueryContext& context, std::vector<Item>& out) {
  for (size_t i = 0; i < list.size(); ++i)
    if (const Body& body = world.body(list[i]); body.shape)
      out.push_back({context.box(list[i], body, world.pose(list[i])), static_cast<int>(i), second});
}

// the axis along which the boxes stand farthest apart
int widest_axis(const std::vector<Item>& items) {
  Vector3d mean = Vector3d::Zero(), spread = Vector3d::Zero();
  for (const Item& item : items) mean += item.box.centre / static_cast<double>(items.size());
  for (const Item& item : items) spread += (item.box.centre - mean).cwiseAbs();
  int axis;
  spread.maxCoeff(&axis);
  return axis;
}

// Visits all pairs within the reach, whichever first.
template <class Visit>
void sweep(std::vector<Item>& items, double reach, Visit visit) {
  const int axis = widest_axis(items);
  std::sort(items.begin(), items.end(),
            [axis](const Item& x, const Item& y) { return x.box.low[axis] < y.box.low[axis]; });
  for (size_t i = 0; i < items.size(); ++i)
    for (size_t j = i + 1;
         j < items.size() && items[j].box.low[axis] - items[i].box.high[axis] <= reach; ++j)
      if (within_reach(items[i].box, items[j].box, reach)) visit(items[i], items[j]);
}

// with so few bodies the pairs that may collide are looked at one by one, with more a sweep finds them
constexpr size_t few = 64;

std::vector<BodyPair> near_of_few(const World& world, double reach, QueryContext& context) {
  context.attend(world.lineage());
  const auto& [bodies, pairs] = context.candidates(world.model(), world.settings());
  std::array<const BodyBox*, few> boxes;
  // from the last one, which has the largest index: so the context makes room once
  for (size_t i = bodies.size(); i-- > 0;)
    boxes[i] = &context.box(bodies[i], world.body(bodies[i]), world.pose(bodies[i]));
  std::vector<BodyPair> out;
  out.reserve(bodies.size());
  for (const auto& [i, j] : pairs)
    if (within_reach(*boxes[i], *boxes[j], reach)) out.emplace_back(bodies[i], bodies[j]);
  return out;
}

}  // namespace

Pose relative_pose(const World& world, Id<Body> a, Id<Body> b) {
  return world.pose(a).inverse() * world.pose(b);
}

std::vector<BodyPair> near_bodies(const World& world, double reach, QueryContext& context) {
  if (world.bodies().size() <= few) return near_of_few(world, reach, context);
  const auto& all = world.bodies();
  std::vector<Item> items;
  add_items(world, all, false, context, items);
  std::vector<std::pair<int, int>> near;
  sweep(items, reach,
        [&](const Item& x, const Item& y) { near.push_back(std::minmax(x.position, y.position)); });
  std::sort(near.begin(), near.end());
  std::vector<BodyPair> out;
  for (const auto& [i, j] : near)
    if (world.may_collide(all[i], all[j])) out.emplace_back(all[i], all[j]);
  return out;
}

std::vector<BodyPair> near_bodies(const World& world, std::span<const Id<Body>> a,
                                  std::span<const Id<Body>> b, double reach,
                                  QueryContext& context) {
  std::vector<Item> items;
  add_items(world, a, false, context, items);
  add_items(world, b, true, context, items);
  std::vector<std::pair<int, int>> near;
  sweep(items, reach, [&](const Item& x, const Item& y) {
    if (x.second != y.second)
      near.emplace_back(x.second ? y.position : x.position, x.second ? x.position : y.position);
  });
  std::sort(near.begin(), near.end());
  std::vector<BodyPair> out;
  // bodies of both groups would come twice
  std::set<BodyPair> seen;
  for (const auto& [i, j] : near)
    if (world.may_collide(a[i], b[j]) && seen.insert(std::minmax(a[i], b[j])).second)
      out.emplace_back(a[i], b[j]);
  return out;
}

}  // namespace clench
