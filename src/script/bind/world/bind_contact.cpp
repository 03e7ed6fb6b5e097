#include "clench/contact/cone.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/world/contacts.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

int push_contacts(lua_State* L, const WorldPtr& world, const std::vector<Contact>& contacts) {
  return push_list_of(L, contacts, [&](const Contact& contact) {
    push(L, ContactHandle{world, contact});
  });
}

// the side that belongs to a robot; the other one first
static std::optional<BodyHandle> contact_link(const ContactHandle& c) {
  for (const auto id : {c.contact.other, c.contact.body})
    if (c.world->body(id).robot) return BodyHandle{c.world, id};
  return {};
}

static Pose pose_of_contact(const ContactHandle& c) {
  return {Eigen::Quaterniond(contact_frame(c.contact.n_W)), c.contact.p_W};
}

static const char* kind_name(ContactKind kind) {
  return word_of(kind, {{"frictionless", ContactKind::frictionless},
                        {"soft", ContactKind::soft},
                        {"point", ContactKind::point}});
}

static int push_patch(lua_State* L, const Contact& c, std::shared_ptr<const SoftPatch> patch) {
  return push_object(L, PatchHandle{std::move(patch), c.X_WA, c.body_is_b, c.friction.statics});
}

static void tell_sharp(lua_State* L, const ContactHandle& c, const SoftPatch& patch) {
  if (!patch.at_edge) return;
  const Eigen::Vector3d p = c.contact.X_WA * patch.center_A;
  log_warning(L, fmt::format("soft contact of {} on {} at ({:.6g}, {:.6g}, {:.6g}): there is a "
                             "corner or an edge, so its patch is an estimate",
                             c.world->body(c.contact.other).name,
                             c.world->body(c.contact.body).name, p.x(), p.y(), p.z()));
}

static int get_patch(lua_State* L) {
  auto& c = self<ContactHandle>(L);
  if (!c.contact.site) return push_nil(L);
  if (!c.patch) {
    c.patch = std::make_shared<SoftPatch>(soft_patch(*c.contact.site));
    tell_sharp(L, c, *c.patch);
  }
  return push_patch(L, c.contact, c.patch);
}

static int fit_patch(lua_State* L) {
  const auto& c = self<ContactHandle>(L);
  Table table(L, 2);
  PatchOptions options;
  if (table.has("radius")) options.radius = table.number("radius");
  options.max_radius = table.number("max_radius", options.max_radius);
  options.fit =
      table.choice("fit", {{"quadric", PatchFit::quadric}, {"jet", PatchFit::jet}}, options.fit);
  table.done();
  if (!c.contact.site) return push_nil(L);
  auto patch = std::make_shared<SoftPatch>(soft_patch(*c.contact.site, options));
  tell_sharp(L, c, *patch);
  return push_patch(L, c.contact, std::move(patch));
}

static std::string contact_text(const ContactHandle& c) {
  const Eigen::Vector3d& p = c.contact.p_W;
  const auto name = [&](Id<Body> id) {
    return c.world->alive(id) ? c.world->body(id).name : "a removed body";
  };
  return fmt::format("{} contact of {} on {} at ({:.6g}, {:.6g}, {:.6g})",
                     kind_name(c.contact.kind), name(c.contact.other), name(c.contact.body), p.x(),
                     p.y(), p.z());
}

// indices of vertices and triangles from 1, as in meshes
static int push(lua_State* L, const Feature& feature) {
  if (feature.kind == Feature::triangle)
    return push_record(L, {{"kind", "triangle"}, {"triangle", feature.first + 1}});
  if (feature.kind == Feature::round)
    return push_record(L, {{"kind", "round"}, {"piece", feature.first + 1}});
  const bool edge = feature.kind == Feature::edge;
  std::vector<int> vertices{feature.first + 1};
  if (edge) vertices.push_back(feature.second + 1);
  return push_record(L, {{"kind", edge ? "edge" : "vertex"}, {"vertices", vertices}});
}

static const Entry contact_fields[] = {
    {"body", getter<[](const ContactHandle& c) {
       return BodyHandle{c.world, c.contact.body};
     }>,
     R"(
The touched body; between a hand and an object, the object.
@type body
> world:contacts(hand, flask)[1].body == flask  --> true)"},
    {"other", getter<[](const ContactHandle& c) {
       return BodyHandle{c.world, c.contact.other};
     }>,
     R"(
The body that touches it.
@type body
> world:contacts(hand, flask)[1].other.kind  --> link)"},
    {"link", getter<contact_link>, R"(
The one of the two that is part of a robot; nil if neither is.
@type body?
> world:contacts(hand, flask)[1].link.robot == hand  --> true)"},
    {"point", getter<[](const ContactHandle& x) { return x.contact.p_W; }>, R"(
Contact point on the surface of `body`, in the world frame.
@type vec3  [m]
> (world:contacts(hand, flask)[1].point - flask.pose.position):norm() < 1  --> true)"},
    {"normal", getter<[](const ContactHandle& x) { return x.contact.n_W; }>, R"(
Unit normal into `body`, in the world frame.
@type vec3
> math.abs(world:contacts(hand, flask)[1].normal:norm() - 1) < 1e-12  --> true)"},
    {"frame", getter<pose_of_contact>, R"(
Contact frame: origin at the point, +z into `body`.
@type pose
> c = world:contacts(hand, flask)[1]
> (c.frame:rotate{0, 0, 1} - c.normal):norm() < 1e-12  --> true)"},
    {"feature", getter<[](const ContactHandle& x) { return x.contact.feature; }>, R"(
The feature of the body's mesh that the contact lies on: a vertex, an edge between two, a triangle, or a round piece, counted from 1.
It stays the same while the contact moves along it, so that contacts can be matched from step to step.
@type {kind: "vertex"|"edge"|"triangle"|"round", vertices?: index[], triangle?: index, piece?: index}
> kinds = {vertex = true, edge = true, triangle = true, round = true}
> kinds[grasp.contacts[1].feature.kind]  --> true)"},
    {"other_feature", getter<[](const ContactHandle& x) { return x.contact.other_feature; }>, R"(
The corresponding feature of the mesh of `other`.
@type {kind: "vertex"|"edge"|"triangle"|"round", vertices?: index[], triangle?: index, piece?: index}
> kinds = {vertex = true, edge = true, triangle = true, round = true}
> kinds[grasp.contacts[1].other_feature.kind]  --> true)"},
    {"gap", getter<[](const ContactHandle& x) { return x.contact.gap; }>, R"(
Distance of the two surfaces at the contact, at most the world's contact threshold.
@type number  [m]
> world:contacts(hand, flask)[1].gap <= world.contact_threshold  --> true)"},
    {"force", getter<[](const ContactHandle& x) { return x.contact.force_W; }>, R"(
Contact force on body in the last step of the world, in world axes; 0 in a world that has not run.
@type vec3  [N]
> world:contacts(hand, flask)[1].force  --> (0, 0, 0))"},
    {"torsion", getter<[](const ContactHandle& x) { return x.contact.torsion; }>, R"(
Torque of a soft contact about the normal on body in the last step of the world.
@type number  [N m]
> world:contacts(hand, flask)[1].torsion  --> 0.0)"},
    {"mu", getter<[](const ContactHandle& x) { return x.contact.friction.statics; }>, R"(
Static Coulomb coefficient of the two materials.
@type number
> c = world:contacts(hand, flask)[1]
> c.mu == world:friction(c.body.material, c.other.material)  --> true)"},
    {"mu_kinetic", getter<[](const ContactHandle& x) { return x.contact.friction.kinetic; }>, R"(
Kinetic Coulomb coefficient of the two materials.
@type number
> world:contacts(hand, flask)[1].mu_kinetic >= 0  --> true)"},
    {"kind", getter<[](const ContactHandle& x) { return kind_name(x.contact.kind); }>, R"(
"point" (with friction), "soft" (with friction, and at least one body is elastic) or "frictionless".
@type string
> world:contacts(hand, flask)[1].kind  --> point
> flask.elastic_modulus = 1.5e6
> world:contacts(hand, flask)[1].kind  --> soft)"},
    {"patch", guarded<get_patch>, R"(
The surfaces around a soft contact, and the torsional friction that it transmits; nil for other kinds. Contacts of two bodies
whose neighborhoods overlap share one patch. A warning is logged at corners and edges.
@type patch?
> world:contacts(hand, flask)[1].patch  --> nil
> flask.elastic_modulus = 1.5e6
> world:contacts(hand, flask)[1].patch.radius < 0.004  --> true)"},
};

static const Entry contact_methods[] = {
    {"fit_patch", guarded<fit_patch>, R"(
The patch of a soft contact, fitted with other options; nil for other kinds.
@param options? table  where and how the surface is fitted
@option radius? number [m, > 0]  how far around the contact, by default 0.4 m / cbrt(larger modulus in Pa), and 5 mm where that is not between 3 and 10 mm, an error where there is nothing to fit
@option max_radius? number [m, > 0] = 0.02  relative radius of surfaces that are flat, nearly flat, or fit each other
@option fit? "quadric"|"jet" = "quadric"  quadric: our own; jet: CGAL's
@return patch?
@effect reads
> flask.elastic_modulus = 1.5e6
> world:contacts(hand, flask)[1]:fit_patch{radius = 0.002}.radius  --> 0.002
> world:contacts(hand, flask)[1]:fit_patch{fit = "jets"}  --> error: did you mean 'jet'?)"},
};

static const Entry contact_operators[] = {
    {"__tostring", method<contact_text>, ""},
};

const Class contact_class{.name = "contact",
                          .variable = "contact",
                          .doc = "A point where one body touches another, as it was when queried.",
                          .fields = contact_fields,
                          .methods = contact_methods,
                          .operators = contact_operators};

}  // namespace clench
