#include "model/near_bodies.h"

#include <algorithm>
#include <set>

namespace clench {

using Eigen::Vector3d;

double sphere_gap(const World& world, Id<Body> a, Id<Body> b) {
  const Shape &one = *world.body(a).shape, &two = *world.body(b).shape;
  const Vector3d between = world.pose(a) * one.centre() - world.pose(b) * two.centre();
  return between.norm() - one.radius() - two.radius();
}

namespace {

// A body of a list: the box along the world's axes that holds it, its rounding included, and its sphere.
struct Item {
  Vector3d low, high, centre;
  double radius;
  int position;  // in its list
  bool second;   // of the two lists
};

void add_items(const World& world, std::span<const Id<Body>> list, bool second,
               std::vector<Item>& out) {
  for (size_t i = 0; i < list.size(); ++i) {
    const Body& body = world.body(list[i]);
    if (!body.shape) continue;
    const Bounds& bounds = body.shape->bounds();
    const Pose& X_WB = world.pose(list[i]);
    const Eigen::Matrix3d R = X_WB.rotation.normalized().toRotationMatrix();
    const Vector3d middle = X_WB * bounds.centre(),
                   half = R.cwiseAbs() * (0.5 * bounds.size()) +
                          Vector3d::Constant(1e-12 *
                                             (X_WB.position.cwiseAbs().maxCoeff() +
                                              body.shape->centre().norm() + body.shape->radius()));
    out.push_back({middle - half, middle + half, X_WB * body.shape->centre(), body.shape->radius(),
                   static_cast<int>(i), second});
  }
}

// the axis along which the boxes stand farthest apart
int widest_axis(const std::vector<Item>& items) {
  Vector3d mean = Vector3d::Zero(), spread = Vector3d::Zero();
  for (const Item& item : items) mean += item.centre / static_cast<double>(items.size());
  for (const Item& item : items) spread += (item.centre - mean).cwiseAbs();
  int axis;
  spread.maxCoeff(&axis);
  return axis;
}

bool within(const Item& x, const Item& y, double reach) {
  for (int k = 0; k < 3; ++k)
    if (x.low[k] - y.high[k] > reach || y.low[k] - x.high[k] > reach) return false;
  const double rounding = 1e-12 * (x.centre.norm() + y.centre.norm() + x.radius + y.radius);
  return (x.centre - y.centre).norm() - x.radius - y.radius <= reach + rounding;
}

// Visits all pairs within the reach, whichever first.
template <class Visit>
void sweep(std::vector<Item>& items, double reach, Visit visit) {
  const int axis = widest_axis(items);
  std::sort(items.begin(), items.end(),
            [axis](const Item& x, const Item& y) { return x.low[axis] < y.low[axis]; });
  for (size_t i = 0; i < items.size(); ++i)
    for (size_t j = i + 1; j < items.size() && items[j].low[axis] - items[i].high[axis] <= reach;
         ++j)
      if (within(items[i], items[j], reach)) visit(items[i], items[j]);
}

}  // namespace

std::vector<BodyPair> near_bodies(const World& world, double reach) {
  const auto& all = world.bodies();
  std::vector<Item> items;
  add_items(world, all, false, items);
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
                                  std::span<const Id<Body>> b, double reach) {
  std::vector<Item> items;
  add_items(world, a, false, items);
  add_items(world, b, true, items);
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
