#include "clench/script/bind/world/contacts.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

static constexpr Word<ModulusRule> modulus_rules[] = {{"larger", ModulusRule::larger},
                                                      {"series", ModulusRule::series}};

ModulusRule read_modulus_rule(Table& options) {
  return options.choice("modulus", modulus_rules, ModulusRule::series);
}

const char* modulus_name(ModulusRule rule) { return word_of(rule, modulus_rules); }

static const SoftPatch& patch_of(lua_State* L) { return *self<PatchHandle>(L).patch; }

// {body = ..., other = ...}: the values that push_one(side) pushes for each
template <class PushOne>
static int push_sides(lua_State* L, PushOne push_one) {
  const bool body_is_b = self<PatchHandle>(L).body_is_b;
  return push_record(L, {{"body", [&] { push_one(body_is_b ? 1 : 0); }},
                         {"other", [&] { push_one(body_is_b ? 0 : 1); }}});
}

static int get_flat(lua_State* L) {
  return push_list_of(L, patch_of(L).flat, [&](bool flat) { push(L, flat); });
}

static int get_curvatures(lua_State* L) {
  const SoftPatch& patch = patch_of(L);
  return push_sides(L, [&](int side) { push(L, patch.surfaces[side].curvatures); });
}

static int get_radii(lua_State* L) {
  const SoftPatch& patch = patch_of(L);
  return push_sides(L, [&](int side) { push(L, patch.surfaces[side].curvatures.cwiseInverse()); });
}

static int get_directions(lua_State* L) {
  const auto& p = self<PatchHandle>(L);
  return push_list_of(L, std::array{0, 1},
                      [&](int i) { push(L, p.X_WA.rotation * p.patch->directions.col(i)); });
}

static int get_patch_points(lua_State* L) {
  const auto& p = self<PatchHandle>(L);
  return push_sides(L, [&](int side) {
    push_list_of(L, p.patch->points[side],
                 [&](const Eigen::Vector3d& point) { push(L, p.X_WA * point); });
  });
}

// {force = 5, modulus = "series"}
static std::pair<double, ModulusRule> read_pressing(lua_State* L) {
  Table options(L, 2);
  const double force = options.number("force", 5);
  const ModulusRule rule = read_modulus_rule(options);
  options.done();
  return {force, rule};
}

static int ellipse(lua_State* L) {
  const SoftPatch& patch = patch_of(L);
  const auto [force, rule] = read_pressing(L);
  const ContactEllipse e = contact_ellipse(patch, force, rule);
  return push_record(L, {{"semi_axes", e.semi_axes},
                         {"indentation", e.indentation},
                         {"pressure", e.pressure},
                         {"torsion_radius", torsion_radius(patch, force, rule)},
                         {"exceeds_layer", e.exceeds_layer}});
}

static int torsion_limit(lua_State* L) {
  const SoftPatch& patch = patch_of(L);
  const auto [force, rule] = read_pressing(L);
  return push(L, self<PatchHandle>(L).mu * force * torsion_radius(patch, force, rule));
}

static std::string patch_text(const PatchHandle& x) {
  return fmt::format("soft patch, relative radii {:.6g} and {:.6g} m{}", x.patch->relative_radii[0],
                     x.patch->relative_radii[1],
                     x.patch->at_edge ? ", on a corner or an edge" : "");
}

static const Entry patch_fields[] = {
    {"relative_radii", getter<[](const PatchHandle& x) { return x.patch->relative_radii; }>, R"(
Radii of the gap between the surfaces along `directions`, the more curved first: 1 over the sum of both curvatures.
For surfaces that separate more slowly than a ball of 2 m from a plane, or not at all, the `max_radius` of 20 mm is used,
or the first radius if that is larger; between 1 m and 2 m the two are blended.
@type number[]  [m]
> patch.relative_radii[1] <= patch.relative_radii[2]  --> true)"},
    {"flat", guarded<get_flat>, R"(
Is a relative radius the limit used for a flat direction?
@type boolean[]
> patch.flat[1]  --> false)"},
    {"curvatures", guarded<get_curvatures>, R"(
Principal curvatures of the surfaces of both bodies, descending: positive where a surface falls away from the other
body, as a ball's, negative where it rises, as a socket's.
@type {body: number[], other: number[]}  [1/m]
> patch.curvatures.body[1] >= patch.curvatures.body[2]  --> true)"},
    {"radii", guarded<get_radii>, R"(
The principal radii of both, 1 over the curvatures: negative if a surface is concave; arbitrarily large if it is flat.
@type {body: number[], other: number[]}  [m]
> math.abs(patch.radii.body[1] * patch.curvatures.body[1] - 1) < 1e-9  --> true)"},
    {"directions", guarded<get_directions>, R"(
Directions of the relative radii: unit, orthogonal to each other and to the contact's normal, in the world frame.
@type vec3[]
> math.abs(patch.directions[1]:dot(patch.directions[2])) < 1e-12  --> true)"},
    {"point",
     getter<[](const PatchHandle& p) { return Eigen::Vector3d(p.X_WA * p.patch->center_A); }>, R"(
The middle of the patch, in the world frame: the contact's point, or the mean of several with overlapping neighborhoods.
@type vec3  [m]
> (patch.point - world:contacts(hand, flask)[4].point):norm() < 0.01  --> true)"},
    {"points", guarded<get_patch_points>, R"(
The fitted points of both surfaces, in the world frame.
@type {body: vec3[], other: vec3[]}  [m]
> #patch.points.other > 100  --> true)"},
    {"radius", getter<[](const PatchHandle& x) { return x.patch->radius; }>, R"(
Radius of the neighborhood in which the surfaces were sampled.
@type number  [m]
> ("%.5f"):format(patch.radius)  --> 0.00349)"},
    {"residual", getter<[](const PatchHandle& x) { return x.patch->residual; }>, R"(
Root mean square distance of the points from the fit, for the surface that fits worse.
@type number  [m]
> patch.residual < patch.radius  --> true)"},
    {"at_edge", getter<[](const PatchHandle& x) { return x.patch->at_edge; }>, R"(
Is there a corner or an edge, at which curvature is not meaningful? Then only the part of the ellipse is used that certainly
touches.
@type boolean
> patch.at_edge  --> false)"},
};

static const Entry patch_methods[] = {
    {"ellipse", guarded<ellipse>, R"(
Contact ellipse of the bodies under load, by the bed-of-springs model (Winkler foundation): its semi-axes along
`directions`, the indentation and the pressure in the middle, and the torsion radius, 8/15 of the semi-axes' geometric
mean. It is nowhere wider than the bodies. At a corner, an edge or a rim the semi-axes are those of the area that certainly
touches, in which the gap is at most the indentation of flat surfaces; the indentation is the depth at which the
springs under the actual gap add up to the force, within the neighborhood. `exceeds_layer`: does it exceed the
thickness of the soft layers, beyond which the model is invalid?
@param options? table  how it is pressed
@option force? number [N, >= 0] = 5  normal force
@option modulus? "series"|"larger" = "series"  series: both layers yield; larger: only that of the larger modulus, as in GraspIt!
@return {semi_axes: number[], indentation: number, pressure: number, torsion_radius: number, exceeds_layer: boolean}  [m], [m], [Pa], [m]
@effect reads
> e = patch:ellipse{force = 5}
> math.abs(e.pressure - 1.5e6 * e.indentation / 0.003) < 1e-3  --> true
> e.exceeds_layer, patch:ellipse{force = 1000}.exceeds_layer  --> false, true
> patch:ellipse{force = -1}  --> error: >= 0)"},
    {"torsion_limit", guarded<torsion_limit>, R"(
The largest torque about the normal that the contact resists, at rest: mu F times the torsion radius.
@param options? table  how it is pressed
@like patch:ellipse
@return number  [N m]
@effect reads
> patch:torsion_limit{force = 10} > patch:torsion_limit{force = 5}  --> true)"},
};

static const Entry patch_operators[] = {
    {"__tostring", method<patch_text>, ""},
};

const Class patch_class{.name = "patch",
                        .variable = "patch",
                        .doc =
                            "The surfaces of two bodies around a soft contact, and the torsional "
                            "friction that it transmits.",
                        .fields = patch_fields,
                        .methods = patch_methods,
                        .operators = patch_operators};

}  // namespace clench
