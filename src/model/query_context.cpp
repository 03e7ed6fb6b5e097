#include "clench/model/query_context.h"

namespace clench {

using Eigen::Vector3d;

// are the boxes along the bodies' own axes separated along one of these?
static bool apart_along_axes(const BodyBox& a, const BodyBox& b, double reach) {
  const Vector3d between = b.middle - a.middle;
  const Eigen::Matrix3d turn = (a.axes.transpose() * b.axes).cwiseAbs();
  const Vector3d along_a = (a.axes.transpose() * between).cwiseAbs() - a.half - turn * b.half;
  const Vector3d along_b =
      (b.axes.transpose() * between).cwiseAbs() - b.half - turn.transpose() * a.half;
  return std::max(along_a.maxCoeff(), along_b.maxCoeff()) > reach;
}

bool within_reach(const BodyBox& a, const BodyBox& b, double reach) {
  // all axes at once: which one separates them is hard to predict
  if ((a.low - b.high).cwiseMax(b.low - a.high).maxCoeff() > reach) return false;
  const double far = reach + a.radius + b.radius;
  return far >= 0 && (a.center - b.center).squaredNorm() <= far * far * (1 + 1e-12) &&
         !apart_along_axes(a, b, reach);
}

static BodyBox box_of(const Shape& shape, const Pose& X_WB) {
  const Bounds& bounds = shape.bounds();
  const Eigen::Matrix3d R = X_WB.rotation.normalized().toRotationMatrix();
  const double rounding =
      1e-12 * (X_WB.position.cwiseAbs().maxCoeff() + shape.center().norm() + shape.radius());
  const Vector3d middle = R * bounds.center() + X_WB.position, half = 0.5 * bounds.size(),
                 center = R * shape.center() + X_WB.position, slack = Vector3d::Constant(rounding),
                 extent = R.cwiseAbs() * half + slack;
  return {middle - extent,
          middle + extent,
          R,
          middle,
          half + slack,
          center,
          shape.radius() + 2 * rounding};
}

void QueryContext::attend(const std::shared_ptr<const void>& lineage, const WorldModel& model) {
  if (lineage_ != lineage) {
    Progress progress = std::move(progress_);
    *this = {};
    progress_ = std::move(progress);
    lineage_ = lineage;
  }
  if (boxes_.size() < model.bodies.size()) boxes_.resize(model.bodies.size());
}

const BodyBox& QueryContext::box(Id<Body> id, const Body& body, const Pose& X_WB) {
  Box& known = boxes_[id.index];
  if (known.id != id || !(known.X_WB == X_WB)) known = {id, X_WB, box_of(*body.shape, X_WB)};
  return known.box;
}

QueryContext::Candidates& QueryContext::candidates(const WorldModel& model,
                                                   const WorldSettings& settings) {
  if (model_stamp_ == model.stamp && settings_stamp_ == settings.stamp) return candidates_;
  candidates_ = {};
  for (const Id<Body> id : model.body_order)
    if (model.bodies[id.index].value.shape) candidates_.bodies.push_back(id);
  const int count = static_cast<int>(candidates_.bodies.size());
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j)
      if (settings.may_collide(candidates_.bodies[i], candidates_.bodies[j]))
        candidates_.pairs.emplace_back(i, j);
  for (const auto& [i, j] : candidates_.pairs) candidates_.likely.push_back({i, j});
  model_stamp_ = model.stamp, settings_stamp_ = settings.stamp;
  return candidates_;
}

std::vector<SweepItem>& QueryContext::sweep_order(const WorldModel& model) {
  if (order_stamp_ == model.stamp) return sweep_order_;
  order_stamp_ = 0;  // until the list is complete
  sweep_order_.clear();
  for (size_t i = 0; i < model.body_order.size(); ++i)
    if (const Id<Body> id = model.body_order[i]; model.bodies[id.index].value.shape)
      sweep_order_.push_back({id, static_cast<int>(i)});
  order_stamp_ = model.stamp;
  return sweep_order_;
}

PairCache& QueryContext::pair(Id<Body> a, Id<Body> b) {
  Pair& known = pairs_[uint64_t{a.index} << 32 | b.index];
  // the index may have been reused by another body
  if (known.a != a || known.b != b) known = {a, b, {}};
  return known.cache;
}

void QueryContext::forget(Id<Body> body) {
  model_stamp_ = 0;  // the candidates have the indices of the pairs' memories
  std::erase_if(
      pairs_, [&](const auto& entry) { return entry.second.a == body || entry.second.b == body; });
}

size_t QueryContext::bytes() const {
  return boxes_.capacity() * sizeof(Box) + sweep_order_.capacity() * sizeof(SweepItem) +
         pairs_.size() * (sizeof(Pair) + 4 * sizeof(void*));
}

}  // namespace clench
