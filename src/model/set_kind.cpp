#include "clench/model/set_kind.h"

#include "clench/base/error.h"
#include "clench/base/text.h"

namespace clench {

static void check_kind(const World& world, const Body& body, Id<Body> id, BodyKind kind) {
  const std::string name = excerpt(body.name);
  if (body.robot)
    fail("body '{}' is a part of robot '{}': its kind cannot change", name,
         excerpt(world.robot(body.robot).name));
  if (kind != BodyKind::object && kind != BodyKind::obstacle)
    fail("body '{}': kind: expected object or obstacle", name);
  const auto& welds = world.dynamic_settings().welds;
  if (const auto weld = welds.find(id); weld != welds.end() && kind != body.kind)
    fail("body '{}' is welded to '{}': it cannot become an obstacle", name,
         excerpt(world.body(weld->second).name));
}

void set_kind(World& world, Id<Body> id, BodyKind kind) {
  check_kind(world, world.body(id), id, kind);
  if (world.body(id).kind == kind) return;
  // a snapshot is a value, and this one differs in the kind
  Snapshot changed = *world.snapshot();
  const auto model = std::make_shared<WorldModel>(*changed.model);
  model->bodies[id.index].value.kind = kind;
  changed.model = model;
  world.restore(changed);
  // further edits mark the model as changed, and end the motion
  world.set_appearance(id, Appearance(world.body(id).appearance));
  world.set_pose(id, Pose(world.pose(id)));
}

}  // namespace clench
