#include "clench/io/mjcf_write/written_friction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "clench/base/text.h"

namespace clench {

namespace {

// more pairs than these slow MuJoCo down too much
constexpr size_t max_friction_pairs = 3000;

using BodyNumbers = std::array<int, 2>;

BodyNumbers ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

class ContactPlanner {
 public:
  ContactPlanner(const SceneRequest& request, const WrittenScene& scene)
      : request_(request), scene_(scene) {
    for (size_t b = 0; b < scene.bodies.size(); ++b)
      by_name_.emplace(scene.bodies[b].spec->name, static_cast<int>(b));
  }
  WrittenContacts plan();

 private:
  void read_rules();
  void exclude_pairs();
  bool collides(int a, int b) const;
  bool is_object(int body) const {
    const int number = scene_.bodies[static_cast<size_t>(body)].body;
    return number >= 0 && request_.world.bodies[static_cast<size_t>(number)].role == Role::object;
  }
  const std::string& material(int body) const {
    return scene_.bodies[static_cast<size_t>(body)].spec->material;
  }
  double mu(int a, int b) const { return request_.friction(material(a), material(b))[0]; }
  bool fit(bool all);
  void list_pairs();
  void tell_losses();

  const SceneRequest& request_;
  const WrittenScene& scene_;
  std::map<std::string, int> by_name_;
  std::set<BodyNumbers> off_;
  std::vector<BodyNumbers> meeting_;
  WrittenContacts out_;
};

// disabled pairs and bits, by names of bodies
void ContactPlanner::read_rules() {
  out_.bits.assign(scene_.bodies.size(), {1, 1});
  const auto& rules = request_.world.collision;
  if (!rules) return;
  const auto find = [&](const std::string& name) {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? -1 : found->second;
  };
  for (const auto& [name, bits] : rules->bits)
    if (const int b = find(name); b >= 0)
      out_.bits[static_cast<size_t>(b)] = {bits.type, bits.affinity};
  for (const std::string& name : rules->bodies_off)
    if (const int b = find(name); b >= 0) out_.bits[static_cast<size_t>(b)] = {0, 0};
  for (const auto& names : rules->pairs_off)
    if (const int a = find(names[0]), b = find(names[1]); a >= 0 && b >= 0)
      off_.insert(ordered(a, b));
  if (!rules->pairs_on.empty())
    out_.losses.push_back(fmt::format("{} pairs of bodies that collide whatever their bits are",
                                      rules->pairs_on.size()));
}

bool ContactPlanner::collides(int a, int b) const {
  const auto& one = out_.bits[static_cast<size_t>(a)];
  const auto& other = out_.bits[static_cast<size_t>(b)];
  return ((one[0] & other[1]) || (other[0] & one[1])) && !off_.contains(ordered(a, b)) &&
         !(scene_.stands(a) && scene_.stands(b)) &&
         scene_.bodies[static_cast<size_t>(a)].spec->shape &&
         scene_.bodies[static_cast<size_t>(b)].spec->shape;
}

void ContactPlanner::exclude_pairs() {
  for (const BodyNumbers& pair : off_)
    if (!(scene_.stands(pair[0]) && scene_.stands(pair[1]))) out_.excluded.push_back(pair);
  const int count = static_cast<int>(scene_.bodies.size());
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b)
      if (collides(a, b)) meeting_.push_back({a, b});
}

/// Tries the smallest coefficients; `all`: for all pairs, otherwise for those with objects.
bool ContactPlanner::fit(bool all) {
  out_.friction.clear();
  for (const BodyNumbers& pair : meeting_) {
    if (!all && !is_object(pair[0]) && !is_object(pair[1])) continue;
    const double both = mu(pair[0], pair[1]);
    for (const int b : pair) {
      const auto [place, is_new] = out_.friction.try_emplace(material(b), both);
      if (!is_new) place->second = std::min(place->second, both);
    }
  }
  for (const WrittenBody& body : scene_.bodies)
    out_.friction.try_emplace(body.spec->material,
                              request_.friction(body.spec->material, body.spec->material)[0]);
  return std::ranges::all_of(meeting_, [&](const BodyNumbers& pair) {
    return mu(pair[0], pair[1]) ==
           std::max(out_.friction.at(material(pair[0])), out_.friction.at(material(pair[1])));
  });
}

void ContactPlanner::list_pairs() {
  std::set<std::pair<std::string, std::string>> lost;
  for (const BodyNumbers& pair : meeting_) {
    const auto& [a, b] = pair;
    const double both = mu(a, b);
    if (both == std::max(out_.friction.at(material(a)), out_.friction.at(material(b)))) continue;
    if (out_.pairs.size() < max_friction_pairs)
      out_.pairs.push_back({a, b, both});
    else
      lost.insert(std::minmax(material(a), material(b)));
  }
  for (const auto& [a, b] : lost)
    out_.losses.push_back(fmt::format("the friction of all pairs of {} and {}", a, b));
}

void ContactPlanner::tell_losses() {
  std::set<std::string> differ;
  for (const BodyNumbers& pair : meeting_) {
    const auto both = request_.friction(material(pair[0]), material(pair[1]));
    if (both[0] != both[1] && (is_object(pair[0]) || is_object(pair[1])))
      differ.insert(fmt::format("{} on {}", std::min(material(pair[0]), material(pair[1])),
                                std::max(material(pair[0]), material(pair[1]))));
  }
  if (!differ.empty())
    out_.losses.push_back(
        fmt::format("lower friction while sliding: the coefficient of sticking counts for {}",
                    name_list(std::vector<std::string>(differ.begin(), differ.end()))));
  std::vector<std::string> soft, springy;
  for (const WrittenBody& body : scene_.bodies) {
    if (body.spec->elastic_modulus && request_.torsion_radius <= 0) soft.push_back(body.name);
    if (body.spec->restitution > 0) springy.push_back(body.name);
  }
  if (!soft.empty())
    out_.losses.push_back("torsional friction of the soft surfaces of " + name_list(soft));
  if (!springy.empty()) out_.losses.push_back("the restitution of " + name_list(springy));
}

WrittenContacts ContactPlanner::plan() {
  read_rules();
  exclude_pairs();
  if (!fit(true)) {
    fit(false);
    list_pairs();
  }
  tell_losses();
  return std::move(out_);
}

}  // namespace

WrittenContacts plan_contacts(const SceneRequest& request, const WrittenScene& scene) {
  return ContactPlanner(request, scene).plan();
}

}  // namespace clench
