#include "clench/contact/cone.h"
#include "clench/contact/friction_edges.h"
#include "clench/motion/virtual_contacts.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/world/contacts.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/values.h"

namespace clench {

int push_virtual_contacts(lua_State* L, const RobotHandle& robot,
                          const std::vector<VirtualContactSpec>& contacts) {
  return push_list_of(L, contacts, [&](const VirtualContactSpec& contact) {
    push(L, VirtualContactHandle{robot, contact});
  });
}

// --- values into contacts ---

static int link_of_body(const Body& body, const RobotHandle& robot, const What& what) {
  const bool link = body.kind == BodyKind::link;
  if (body.robot != robot.id || !(link || body.kind == BodyKind::base))
    fail("{}: '{}' is no link of robot '{}'", what.text(), body.name, robot->name);
  return body.link;
}

static int number_on(const RobotHandle& robot, ChainPlace place, const What& what) {
  const auto link = link_at(robot->chains, place);
  if (!link)
    fail("{}: there is no link {} of chain {}", what.text(), place.link + 1, place.chain + 1);
  return *link;
}

static int read_link(lua_State* L, Table& table, const RobotHandle& robot) {
  const What what = table.what("link");
  const int type = table.push("link");
  int link = -1;
  if (const auto* body = to<BodyHandle>(L, -1)) {
    if (body->world != robot.world)
      fail("{}: '{}' belongs to another world", what.text(), (*body)->name);
    link = link_of_body(**body, robot, what);
  } else if (type == LUA_TSTRING) {
    link = robot.world->body(find_link(robot, read_string(L, -1, what), what.text())).link;
  } else if (type == LUA_TNUMBER && table.has("chain")) {
    // numbers in the format of lists from files
    const int chain = table.integer("chain", 0), number = read_int(L, -1, what);
    if (chain < 0) fail("{}: chain: expected 0 or more, got {}", what.text(), chain);
    link = number_on(robot, {chain - 1, std::max(number, 0) - 1}, what);
  } else {
    fail_expected(what, "a link, its name, or its number with that of its chain", -1);
  }
  lua_pop(L, 1);
  return link;
}

static FrictionEdges read_friction_edges(Table& table) {
  return table.has("edges") ? table.wrenches("edges")
                            : friction_edges(table.number("torsion_radius", 0));
}

static Pose read_frame(Table& table) {
  const bool both = table.has("point") || table.has("normal");
  if (table.has("frame") && both)
    fail("{}: expected frame, or point and normal, got both", table.subject());
  if (table.has("frame")) return table.pose("frame");
  const Eigen::Vector3d normal = table.vec3("normal");
  if (!(normal.norm() > 1e-9) || !std::isfinite(normal.norm()))
    fail("{}: normal: expected a direction", table.subject());
  return {Eigen::Quaterniond(contact_frame(normal.normalized())).normalized(), table.vec3("point")};
}

VirtualContactSpec read_virtual_contact(lua_State* L, int i, const What& what,
                                        const RobotHandle& robot) {
  i = lua_absindex(L, i);
  if (const auto* given = to<VirtualContactHandle>(L, i)) {
    VirtualContactSpec contact = given->contact;
    if (given->robot.world != robot.world || given->robot.id != robot.id)
      contact.link = number_on(robot, place_of(given->robot->chains, contact.link), what);
    return contact;
  }
  if (const auto* real = to<ContactHandle>(L, i)) {
    if (real->world != robot.world) fail("{}: the contact is of another world", what.text());
    return marked(*robot.world, robot.id, real->contact);
  }
  if (!lua_istable(L, i))
    fail_expected(what, "a virtual contact, a contact, or a table such as {link, point, normal}",
                  i);
  Table table(L, i, what.text());
  VirtualContactSpec contact;
  contact.link = read_link(L, table, robot);
  table.integer("chain", 0);  // a valid key, even if read_link does not read it
  contact.X_LC = read_frame(table);
  contact.mu = table.number("mu", 1);
  contact.edges = read_friction_edges(table);
  table.done();
  return contact;
}

// --- fields ---

static BodyHandle link_of(const VirtualContactHandle& c) {
  return {c.robot.world, c.robot->body_of(c.contact.link)};
}

static Pose frame_of(const VirtualContactHandle& c) {
  const BodyHandle link = link_of(c);
  return link.world->pose(link.id) * c.contact.X_LC;
}

static Eigen::Vector3d normal_of(const VirtualContactHandle& c) {
  return frame_of(c).rotation * Eigen::Vector3d::UnitZ();
}

// largest torque about the normal, over mu and force
static double torsion_radius(const VirtualContactSpec& contact) {
  return contact.edges.cols() ? contact.edges.row(5).cwiseAbs().maxCoeff() : 0.0;
}

static const char* virtual_contact_kind(const VirtualContactHandle& c) {
  return torsion_radius(c.contact) > 0 ? "soft" : "point";
}

static std::string virtual_contact_text(const VirtualContactHandle& c) {
  if (!c.robot.world->alive(c.robot.id)) return "virtual contact of a removed robot";
  const Eigen::Vector3d p = frame_of(c).position;
  return fmt::format("virtual contact on {} at ({:.6g}, {:.6g}, {:.6g})", link_of(c)->name, p.x(),
                     p.y(), p.z());
}

static const Entry virtual_contact_fields[] = {
    {"link", getter<link_of>, R"(
The link that it lies on, or the base.
@type body
> hand.virtual_contacts[1].link.robot == hand  --> true)"},
    {"chain", getter<[](const VirtualContactHandle& x) {
       return place_of(x.robot->chains, x.contact.link).chain + 1;
     }>,
     R"(
Number of the link's chain; 0 for the base.
@type integer
> hand:find_virtual_contacts()[1].chain  --> 1)"},
    {"point", getter<[](const VirtualContactHandle& x) { return frame_of(x).position; }>, R"(
Its position in the world frame; it moves with its link.
@type vec3  [m]
> c = hand.virtual_contacts[1]
> (c.point - c.link.pose * c.frame_in_link.position):norm() < 1e-12  --> true)"},
    {"normal", getter<normal_of>, R"(
Unit normal out of the link, in the world frame: into the body to be touched.
@type vec3
> math.abs(hand.virtual_contacts[1].normal:norm() - 1) < 1e-12  --> true)"},
    {"frame", getter<frame_of>, R"(
Contact frame in the world: origin at the point, +z along the normal.
@type pose
> c = hand.virtual_contacts[1]
> (c.frame:rotate{0, 0, 1} - c.normal):norm() < 1e-12  --> true)"},
    {"frame_in_link", getter<[](const VirtualContactHandle& x) { return x.contact.X_LC; }>, R"(
Contact frame in the link frame.
@type pose
> c = hand.virtual_contacts[1]
> (c.link.pose * c.frame_in_link).position == c.point  --> true)"},
    {"mu", getter<[](const VirtualContactHandle& x) { return x.contact.mu; }>, R"(
Coulomb coefficient used in computations.
@type number
> hand.virtual_contacts[1].mu > 0  --> true)"},
    {"edges", getter<[](const VirtualContactHandle& x) {
       return Eigen::MatrixXd(x.contact.edges.transpose());
     }>,
     R"(
Friction supported by a unit normal force, over mu: a list of {fx, fy, fz, tx, ty, tz} in the contact frame.
@type number[][]  torques [m]
> hand:add_virtual_contact{link = hand.base, point = {0, 0, 0}, normal = {0, 0, 1}}
> #hand.virtual_contacts[#hand.virtual_contacts].edges  --> 8)"},
    {"torsion_radius",
     getter<[](const VirtualContactHandle& x) { return torsion_radius(x.contact); }>, R"(
Maximum torque about the normal per unit normal force, over mu; 0 for a point.
@type number  [m]
> hand:add_virtual_contact{link = hand.base, point = {0, 0, 0}, normal = {0, 0, 1}, torsion_radius = 0.002}
> c = hand.virtual_contacts[#hand.virtual_contacts]
> c.torsion_radius, c.kind, #c.edges  --> 0.002, soft, 20)"},
    {"kind", getter<virtual_contact_kind>,
     R"(
"point", or "soft" if it carries torque about the normal.
@type string
> hand.virtual_contacts = {{link = hand.base, point = {0, 0, 0}, normal = {0, 0, 1}}}
> hand.virtual_contacts[1].kind  --> point)"},
};

static const Entry virtual_contact_operators[] = {
    {"__tostring", method<virtual_contact_text>, ""},
};

const Class virtual_contact_class{
    .name = "virtual_contact",
    .variable = "virtual_contact",
    .doc =
        "A desired contact point on a link of a hand; it moves with the "
        "link.",
    .fields = virtual_contact_fields,
    .operators = virtual_contact_operators};

}  // namespace clench
