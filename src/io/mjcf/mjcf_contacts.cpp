#include "clench/io/mjcf/mjcf_contacts.h"

#include <algorithm>

#include "clench/base/text.h"

namespace clench {

static std::array<std::string, 2> in_order(std::string a, std::string b) {
  if (b < a) std::swap(a, b);
  return {std::move(a), std::move(b)};
}

MjcfContacts::MjcfContacts(MjcfDocument& document, const FileCache& cache)
    : document_(document), cache_(cache) {
  for (const MjcfNode& option : document.root().children)
    if (option.name() == "option")
      for (const MjcfNode& flag : option.children)
        if (const XmlValues flags(flag.element); flag.name() == "flag" && flags.has("filterparent"))
          filter_parents_ = flags.word("filterparent", {"enable", "disable"}, "enable") == "enable";
  for (const MjcfNode* node : document.section("contact")) {
    if (node->name() != "pair") continue;
    MjcfPair pair{document.values(node->element), {}};
    pair.geoms = {pair.values.text("geom1"), pair.values.text("geom2")};
    pair.values.tell_unused(document.unused(),
                            {"name", "class", "geom1", "geom2", "friction", "condim"});
    listed_.insert(in_order(pair.geoms[0], pair.geoms[1]));
    pairs_.push_back(std::move(pair));
  }
}

bool MjcfContacts::listed(const MjcfGeom& a, const MjcfGeom& b) const {
  return a.paired && b.paired && listed_.contains(in_order(a.name, b.name));
}

bool MjcfContacts::collide(const MjcfGeom& a, const MjcfGeom& b) const {
  return (a.type & b.affinity) || (b.type & a.affinity) || listed(a, b);
}

bool MjcfContacts::listed(const std::vector<MjcfGeom>& a, const std::vector<MjcfGeom>& b) const {
  return !pairs_.empty() && std::ranges::any_of(a, [&](const MjcfGeom& g) {
    return g.paired && std::ranges::any_of(b, [&](const MjcfGeom& h) { return listed(g, h); });
  });
}

bool MjcfContacts::collide(const std::vector<MjcfGeom>& a, const std::vector<MjcfGeom>& b,
                           const std::string& name_a, const std::string& name_b) {
  // geoms with the same bits are equivalent, except those of pairs
  const auto kinds = [](const std::vector<MjcfGeom>& geoms) {
    std::vector<const MjcfGeom*> out;
    const auto alike = [](const MjcfGeom& x, const MjcfGeom& y) {
      return !x.paired && !y.paired && x.type == y.type && x.affinity == y.affinity;
    };
    for (const MjcfGeom& geom : geoms)
      if (geom.collides() &&
          std::ranges::none_of(out, [&](const MjcfGeom* g) { return alike(*g, geom); }))
        out.push_back(&geom);
    return out;
  };
  bool any = false, all = true;
  const auto kinds_b = kinds(b);
  for (const MjcfGeom* g : kinds(a))
    for (const MjcfGeom* h : kinds_b) (collide(*g, *h) ? any : all) = collide(*g, *h);
  if (any && !all) mixed_.push_back(fmt::format("'{}' and '{}'", excerpt(name_a), excerpt(name_b)));
  return any;
}

void MjcfContacts::filter_links(MjcfTree& tree, bool fixed_base) {
  TreeModel& model = tree.model;
  const int count = static_cast<int>(model.links.size());
  // links fixed to each other are represented by the first one, as is the link that carries them
  std::vector<int> piece(count), carrier(count, -1), neighbour(count, -1);
  for (int i = 0; i < count; ++i) {
    const TreeLink& link = model.links[i];
    const bool fixed = link.parent >= 0 && link.joints.empty();
    piece[i] = fixed ? piece[link.parent] : i;
    carrier[i] = fixed ? carrier[link.parent] : link.parent < 0 ? -1 : piece[link.parent];
    // a World excludes collisions of a link with the nearest link with a shape towards the base
    for (int up = link.parent; up >= 0 && neighbour[i] < 0; up = model.links[up].parent)
      if (model.links[up].body.shape || up == 0) neighbour[i] = up;
  }
  const std::set<std::pair<int, int>> excluded = [&] {
    std::set<std::pair<int, int>> out;
    for (const auto& [a, b] : model.never_meet) out.emplace(std::min(a, b), std::max(a, b));
    return out;
  }();
  model.never_meet.clear();
  int apart = 0;
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      const bool is_excluded = excluded.contains({i, j});
      const bool are_listed = listed(tree.geoms[i], tree.geoms[j]);
      if (!model.links[i].body.shape || !model.links[j].body.shape) {
        if (is_excluded) model.never_meet.emplace_back(i, j);
        continue;
      }
      const bool ground = fixed_base && (piece[i] == 0 || piece[j] == 0);
      const bool carries = carrier[i] == piece[j] || carrier[j] == piece[i];
      const bool one = piece[i] == piece[j];
      const bool bits =
          collide(tree.geoms[i], tree.geoms[j], model.links[i].body.name, model.links[j].body.name);
      const bool filtered = is_excluded || (filter_parents_ && carries && !ground);
      const bool off = !bits || (filtered && !are_listed);
      apart += !bits;
      const bool neighbours = neighbour[j] == i;
      // links fixed to each other never move relative to each other
      if (!bits || (off && is_excluded) || (off && !neighbours && !one))
        model.never_meet.emplace_back(i, j);
      else if (!off && neighbours && !one)
        model.always_meet.emplace_back(i, j);
    }
  if (apart > 0)
    cache_.note(
        fmt::format("{}: {} pair{} of links never collide{}, as contype and conaffinity say",
                    document_.file(), apart, apart == 1 ? "" : "s", apart == 1 ? "s" : ""));
}

void MjcfContacts::tell(const std::function<bool(const std::string&)>& is_read) {
  if (!mixed_.empty())
    cache_.warn(
        fmt::format("{}: contype, conaffinity or <pair> let only some geoms of these "
                    "bodies collide; here all of them do: {}",
                    document_.file(), name_list(mixed_)));
  mixed_.clear();
  std::vector<std::string> lost, rough;
  for (const MjcfPair& pair : pairs_) {
    const std::string names =
        fmt::format("'{}' and '{}'", excerpt(pair.geoms[0]), excerpt(pair.geoms[1]));
    if (!is_read(pair.geoms[0]) || !is_read(pair.geoms[1]))
      lost.push_back(names);
    else if (pair.values.has("friction") || pair.values.has("condim"))
      rough.push_back(names);
  }
  const auto place = [&] { return pairs_.front().values.element().place(); };
  if (!lost.empty())
    cache_.warn(fmt::format("{}: pairs of which a geom is not read are not used: {}", place(),
                            name_list(lost)));
  if (!rough.empty())
    cache_.warn(
        fmt::format("{}: friction and condim of pairs are not used; those of the geoms "
                    "count: {}",
                    place(), name_list(rough)));
}

}  // namespace clench
