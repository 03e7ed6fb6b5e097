#include "clench/model/near_bodies.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <set>

#include "clench/base/watched.h"

namespace clench {

using Eigen::Vector3d;

double sphere_gap(const World& world, Id<Body> a, Id<Body> b) {
  const Shape &one = *world.body(a).shape, &two = *world.body(b).shape;
  const Vector3d between = world.pose(a) * one.center() - world.pose(b) * two.center();
  return between.norm() - one.radius() - two.radius();
}

namespace {

void find_box(const World& world, QueryContext& context, SweepItem& item) {
  item.box = &context.box(item.body, world.body(item.body), world.pose(item.body));
}

// the axis along which the separation of the boxes is largest
int widest_axis(const std::vector<SweepItem>& items) {
  Vector3d mean = Vector3d::Zero(), spread = Vector3d::Zero();
  for (const SweepItem& item : items) mean += item.box->center / static_cast<double>(items.size());
  for (const SweepItem& item : items) spread += (item.box->center - mean).cwiseAbs();
  int axis;
  spread.maxCoeff(&axis);
  return axis;
}

// Sorts by the boxes' lower ends: by insertion, which is fast if they are nearly in order, until
// too much has been moved.
void sort_along(int axis, std::vector<SweepItem>& items) {
  const auto before = [axis](const SweepItem& x, const SweepItem& y) {
    return x.box->low[axis] < y.box->low[axis];
  };
  size_t moves = 0;
  for (size_t i = 1; i < items.size(); ++i) {
    const SweepItem item = items[i];
    size_t j = i;
    for (; j > 0 && before(item, items[j - 1]); --j) items[j] = items[j - 1];
    items[j] = item;
    moves += i - j;
    if (moves > 8 * items.size()) return std::sort(items.begin(), items.end(), before);
  }
}

// Visits all pairs whose boxes are within the reach along the axis of the sweep, in any order.
template <class Visit>
void sweep_along(std::vector<SweepItem>& items, double reach, Visit visit) {
  const int axis = widest_axis(items);
  sort_along(axis, items);
  StopCheck check(16);
  for (size_t i = 0; i < items.size(); ++i) {
    check();
    const BodyBox& box = *items[i].box;
    for (size_t j = i + 1; j < items.size() && items[j].box->low[axis] - box.high[axis] <= reach;
         ++j)
      visit(items[i], items[j]);
  }
}

// Visits all pairs within the reach, in any order.
template <class Visit>
void sweep(std::vector<SweepItem>& items, double reach, Visit visit) {
  sweep_along(items, reach, [&](const SweepItem& x, const SweepItem& y) {
    if (within_reach(*x.box, *y.box, reach)) visit(x, y);
  });
}

// for so few bodies the pairs that may collide are examined one by one, for more by a sweep
constexpr size_t few = 64;

std::vector<BodyPair> near_of_few(const World& world, double reach, QueryContext& context) {
  const auto& [bodies, pairs, likely] = context.candidates(world.model(), world.settings());
  std::array<const BodyBox*, few> boxes;
  for (size_t i = 0; i < bodies.size(); ++i)
    boxes[i] = &context.box(bodies[i], world.body(bodies[i]), world.pose(bodies[i]));
  std::vector<BodyPair> out;
  out.reserve(bodies.size());
  for (const auto& [i, j] : pairs)
    if (within_reach(*boxes[i], *boxes[j], reach)) out.emplace_back(bodies[i], bodies[j]);
  return out;
}

using Asked = FunctionRef<bool(const BodyPair&, PairCache&)>;

PairCache& memory_of(const BodyPair& pair, QueryContext& context) {
  const auto [a, b] = ordered(pair.first, pair.second);
  return context.pair(a, b);
}

bool ask(const BodyPair& pair, PairCache& cache, Asked collides) {
  const bool hit = collides(pair, cache);
  constexpr float memory = 0.9F;
  cache.hit_rate = memory * cache.hit_rate + (hit ? 1 - memory : 0);
  return hit;
}

bool any_of_few(const World& world, QueryContext& context, Asked collides) {
  auto& [bodies, pairs, likely] = context.candidates(world.model(), world.settings());
  std::array<const BodyBox*, few> boxes = {};
  const auto box = [&, &ids = bodies](int i) -> const BodyBox& {
    if (!boxes[i]) boxes[i] = &context.box(ids[i], world.body(ids[i]), world.pose(ids[i]));
    return *boxes[i];
  };
  for (size_t k = 0; k < likely.size(); ++k) {
    auto& [i, j, cache] = likely[k];
    if (!within_reach(box(i), box(j), 0)) continue;
    const BodyPair pair(bodies[i], bodies[j]);
    if (!cache) cache = &memory_of(pair, context);
    if (!ask(pair, *cache, collides)) continue;
    for (; k > 0 && likely[k - 1].hit_rate() < likely[k].hit_rate(); --k)
      std::swap(likely[k - 1], likely[k]);
    return true;
  }
  return false;
}

}  // namespace

bool any_near(const World& world, QueryContext& context, Asked collides) {
  context.attend(world.lineage(), world.model());
  if (world.bodies().size() <= few) return any_of_few(world, context, collides);
  std::vector<std::pair<PairCache*, BodyPair>> order;
  for (const BodyPair& p : near_bodies(world, 0, context))
    order.emplace_back(&memory_of(p, context), p);
  std::ranges::stable_sort(
      order, [](const auto& x, const auto& y) { return x.first->hit_rate > y.first->hit_rate; });
  return std::ranges::any_of(order,
                             [&](const auto& x) { return ask(x.second, *x.first, collides); });
}

std::vector<BodyPair> first_near(const World& world, size_t max, QueryContext& context,
                                 FunctionRef<bool(const BodyPair&)> collides) {
  context.attend(world.lineage(), world.model());
  std::vector<BodyPair> out;
  if (max == 0) return out;
  const auto& all = world.bodies();
  if (all.size() <= few) {
    for (const BodyPair& pair : near_of_few(world, 0, context))
      if (out.size() < max && collides(pair)) out.push_back(pair);
    return out;
  }
  std::vector<SweepItem>& items = context.sweep_order(world.model());
  for (SweepItem& item : items) find_box(world, context, item);
  // the first pairs found so far, at most max; once there are max, later pairs are not tested
  using Numbers = std::pair<int, int>;
  std::set<Numbers> kept;
  Numbers last(std::numeric_limits<int>::max(), 0);
  sweep_along(items, 0, [&](const SweepItem& x, const SweepItem& y) {
    const Numbers at = std::minmax(x.position, y.position);
    if (last < at || !within_reach(*x.box, *y.box, 0) || !world.may_collide(x.body, y.body) ||
        !collides({all[at.first], all[at.second]}))
      return;
    kept.insert(at);
    if (kept.size() > max) kept.erase(std::prev(kept.end()));
    if (kept.size() == max) last = *kept.rbegin();
  });
  for (const auto& [i, j] : kept) out.emplace_back(all[i], all[j]);
  return out;
}

Pose relative_pose(const World& world, Id<Body> a, Id<Body> b) {
  return world.pose(a).inverse() * world.pose(b);
}

std::vector<BodyPair> near_bodies(const World& world, double reach, QueryContext& context) {
  context.attend(world.lineage(), world.model());
  if (world.bodies().size() <= few) return near_of_few(world, reach, context);
  std::vector<SweepItem>& items = context.sweep_order(world.model());
  for (SweepItem& item : items) find_box(world, context, item);
  const auto& all = world.bodies();
  std::vector<std::pair<int, int>> near;
  sweep(items, reach, [&](const SweepItem& x, const SweepItem& y) {
    if (world.may_collide(x.body, y.body)) near.push_back(std::minmax(x.position, y.position));
  });
  std::sort(near.begin(), near.end());
  std::vector<BodyPair> out;
  out.reserve(near.size());
  for (const auto& [i, j] : near) out.emplace_back(all[i], all[j]);
  return out;
}

std::vector<BodyPair> near_bodies(const World& world, std::span<const Id<Body>> a,
                                  std::span<const Id<Body>> b, double reach,
                                  QueryContext& context) {
  context.attend(world.lineage(), world.model());
  // indices of b follow those of a
  const int count = static_cast<int>(a.size());
  std::vector<SweepItem> items;
  for (int i = 0; i < count; ++i) items.push_back({a[i], i});
  for (size_t i = 0; i < b.size(); ++i) items.push_back({b[i], count + static_cast<int>(i)});
  std::erase_if(items, [&](const SweepItem& item) { return !world.body(item.body).shape; });
  for (SweepItem& item : items) find_box(world, context, item);
  std::vector<std::pair<int, int>> near;
  sweep(items, reach, [&](const SweepItem& x, const SweepItem& y) {
    const auto [first, second] = std::minmax(x.position, y.position);
    if (first < count && second >= count) near.emplace_back(first, second - count);
  });
  std::sort(near.begin(), near.end());
  std::vector<BodyPair> out;
  // bodies of both groups would be listed twice
  std::set<BodyPair> seen;
  for (const auto& [i, j] : near)
    if (world.may_collide(a[i], b[j]) && seen.insert(std::minmax(a[i], b[j])).second)
      out.emplace_back(a[i], b[j]);
  return out;
}

}  // namespace clench
