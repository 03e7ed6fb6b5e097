#include "clench/io/mjcf/bodies/mjcf_contacts.h"

#include <algorithm>

#include "clench/base/text.h"
#include "clench/base/watched.h"

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

// --- bits ---

static bool collide(unsigned type_a, unsigned affinity_a, unsigned type_b, unsigned affinity_b) {
  return (type_a & affinity_b) || (type_b & affinity_a);
}

MjcfBits::MjcfBits(const std::vector<MjcfGeom>& geoms) {
  std::map<std::pair<unsigned, unsigned>, size_t> counts;
  for (const MjcfGeom& geom : geoms) {
    if (!geom.collides()) continue;
    ++counts[{geom.type, geom.affinity}];
    type |= geom.type, affinity |= geom.affinity;
  }
  for (const auto& [bits, count] : counts) kinds.push_back({bits.first, bits.second, count});
}

void MjcfNamedPairs::add(const std::string& a, const std::string& b) {
  constexpr size_t max_named = 200;  // enough for a message
  if (++count_ <= max_named) first_.push_back(fmt::format("'{}' and '{}'", excerpt(a), excerpt(b)));
}

/// Number of pairs of geoms of two bodies whose bits exclude collisions.
static size_t pairs_apart(const MjcfBits& a, const MjcfBits& b) {
  size_t apart = 0;
  for (const MjcfBits::Kind& x : a.kinds)
    for (const MjcfBits::Kind& y : b.kinds)
      if (!collide(x.type, x.affinity, y.type, y.affinity)) apart += x.count * y.count;
  return apart;
}

bool MjcfContacts::collide(const MjcfBits& a, const MjcfBits& b, const size_t* listed,
                           const std::string& name_a, const std::string& name_b) {
  if (!listed && !clench::collide(a.type, a.affinity, b.type, b.affinity)) return false;
  if (pairs_apart(a, b) > (listed ? *listed : 0)) mixed_.add(name_a, name_b);
  return true;
}

// --- listed pairs ---

MjcfListedBodies MjcfContacts::listed(
    const std::vector<const std::vector<MjcfGeom>*>& bodies) const {
  constexpr size_t max_listed = 1'000'000;
  MjcfListedBodies out;
  if (pairs_.empty()) return out;
  std::map<std::string_view, std::vector<std::pair<size_t, const MjcfGeom*>>> named;
  for (size_t i = 0; i < bodies.size(); ++i)
    for (const MjcfGeom& geom : *bodies[i])
      if (geom.paired) named[geom.name].emplace_back(i, &geom);
  size_t count = 0;
  StopCheck check(1 << 10);
  for (const auto& [first, second] : listed_)
    for (const auto& [i, g] : named[first])
      for (const auto& [j, h] : named[second]) {
        check();
        if (++count > max_listed)
          fail("{}: pair: expected at most {} pairs of geoms, those of one name counted each",
               document_.file(), max_listed);
        if (i == j) continue;
        out[std::minmax(i, j)] += !clench::collide(g->type, g->affinity, h->type, h->affinity);
      }
  return out;
}

// --- parts of a scene ---

namespace {

/// Parts with equal bits. There are few such groups, so that pairs are counted by group.
struct PartGroup {
  std::vector<size_t> parts;
  std::map<std::pair<int, int>, size_t> owners;  // number of parts of each owner
};

std::vector<PartGroup> groups_of(const std::vector<MjcfPart>& parts) {
  std::map<std::pair<std::vector<std::array<size_t, 3>>, bool>, PartGroup> by_bits;
  for (size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].bits.kinds.empty()) continue;  // collides with nothing
    std::vector<std::array<size_t, 3>> key;
    for (const MjcfBits::Kind& kind : parts[i].bits.kinds)
      key.push_back({kind.type, kind.affinity, kind.count});
    PartGroup& group = by_bits[{std::move(key), parts[i].fixed}];
    group.parts.push_back(i);
    ++group.owners[parts[i].owner];
  }
  std::vector<PartGroup> out;
  for (auto& [key, group] : by_bits) out.push_back(std::move(group));
  return out;
}

/// Number of pairs of a part of a and a part of b that have different owners.
size_t pairs_between(const PartGroup& a, const PartGroup& b, bool same) {
  size_t all = a.parts.size() * b.parts.size();
  const PartGroup &less = a.owners.size() < b.owners.size() ? a : b, &more = &less == &a ? b : a;
  for (const auto& [owner, count] : less.owners)
    if (const auto found = more.owners.find(owner); found != more.owners.end())
      all -= count * found->second;
  return same ? all / 2 : all;
}

}  // namespace

void MjcfContacts::name_mixed(const std::vector<MjcfPart>& parts, const std::vector<size_t>& a,
                              const std::vector<size_t>& b, const MjcfListedBodies& listed) {
  for (const size_t i : a) {
    check_stop();
    for (const size_t j : b) {
      if (&a == &b && j <= i) continue;
      if (parts[i].owner != parts[j].owner && !listed.contains(std::minmax(i, j)))
        mixed_.add(parts[std::min(i, j)].name, parts[std::max(i, j)].name);
    }
  }
}

MjcfKeptApart MjcfContacts::kept_apart(const std::vector<MjcfPart>& parts,
                                       const MjcfListedBodies& listed) {
  MjcfKeptApart out;
  const std::vector<PartGroup> groups = groups_of(parts);
  for (size_t g = 0; g < groups.size(); ++g)
    for (size_t h = g; h < groups.size(); ++h) {
      check_stop();
      const MjcfPart &a = parts[groups[g].parts.front()], &b = parts[groups[h].parts.front()];
      const size_t count = pairs_between(groups[g], groups[h], g == h);
      if (count == 0) continue;
      const bool meet = clench::collide(a.bits.type, a.bits.affinity, b.bits.type, b.bits.affinity);
      if (!meet)
        out.by_bits += count;
      else if (a.fixed && b.fixed)
        out.fixed += count;
      else if (pairs_apart(a.bits, b.bits) > 0)
        name_mixed(parts, groups[g].parts, groups[h].parts, listed);
    }
  for (const auto& [pair, geoms_apart] : listed) {
    const MjcfPart &a = parts[pair.first], &b = parts[pair.second];
    if (a.owner == b.owner || (a.fixed && b.fixed)) continue;
    collide(a.bits, b.bits, &geoms_apart, a.name, b.name);
    if (clench::collide(a.bits.type, a.bits.affinity, b.bits.type, b.bits.affinity)) continue;
    out.listed.push_back(pair);
    --out.by_bits;
  }
  return out;
}

// --- links of one robot ---

void MjcfContacts::filter_links(MjcfTree& tree, bool fixed_base) {
  TreeModel& model = tree.model;
  const int count = static_cast<int>(model.links.size());
  // links fixed to each other are represented by the first one, as is the link that carries them
  std::vector<int> piece(count), carrier(count, -1), neighbor(count, -1);
  for (int i = 0; i < count; ++i) {
    const TreeLink& link = model.links[i];
    const bool fixed = link.parent >= 0 && link.joints.empty();
    piece[i] = fixed ? piece[link.parent] : i;
    carrier[i] = fixed ? carrier[link.parent] : link.parent < 0 ? -1 : piece[link.parent];
    // a World excludes collisions of a link with the nearest link that has a shape towards the base
    for (int up = link.parent; up >= 0 && neighbor[i] < 0; up = model.links[up].parent)
      if (model.links[up].body.shape || up == 0) neighbor[i] = up;
  }
  const std::set<std::pair<int, int>> excluded = [&] {
    std::set<std::pair<int, int>> out;
    for (const auto& [a, b] : model.never_meet) out.emplace(std::min(a, b), std::max(a, b));
    return out;
  }();
  model.never_meet.clear();
  std::vector<MjcfBits> bits;
  std::vector<const std::vector<MjcfGeom>*> geoms;
  for (const auto& of_link : tree.geoms) {
    bits.emplace_back(of_link);
    geoms.push_back(&of_link);
  }
  const MjcfListedBodies listed_links = listed(geoms);
  int apart = 0;
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      check_stop();
      const bool is_excluded = excluded.contains({i, j});
      const auto found = listed_links.find({i, j});
      const bool are_listed = found != listed_links.end();
      if (!model.links[i].body.shape || !model.links[j].body.shape) {
        if (is_excluded) model.never_meet.emplace_back(i, j);
        continue;
      }
      const bool ground = fixed_base && (piece[i] == 0 || piece[j] == 0);
      const bool carries = carrier[i] == piece[j] || carrier[j] == piece[i];
      const bool one = piece[i] == piece[j];
      const bool may_collide = collide(bits[i], bits[j], are_listed ? &found->second : nullptr,
                                       model.links[i].body.name, model.links[j].body.name);
      const bool filtered = is_excluded || (filter_parents_ && carries && !ground);
      const bool off = !may_collide || (filtered && !are_listed);
      apart += !may_collide;
      const bool neighbors = neighbor[j] == i;
      // links fixed to each other never move relative to each other
      if (!may_collide || (off && is_excluded) || (off && !neighbors && !one))
        model.never_meet.emplace_back(i, j);
      else if (!off && neighbors && !one)
        model.always_meet.emplace_back(i, j);
    }
  if (apart > 0)
    cache_.diagnostics().note(
        Place(document_.file()),
        "{} pair{} of links never collide{} because of contype and conaffinity", apart,
        apart == 1 ? "" : "s", apart == 1 ? "s" : "");
}

void MjcfContacts::tell(const std::function<bool(const std::string&)>& is_read) {
  if (mixed_.size() > 0)
    cache_.diagnostics().warn(Place(document_.file()),
                              "contype, conaffinity or <pair> let only some geoms of these bodies "
                              "collide; here all of them do: {}",
                              name_list(mixed_));
  mixed_ = {};
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
    cache_.diagnostics().warn(place(), "pairs of which a geom is not read are not used: {}",
                              name_list(lost));
  if (!rough.empty())
    cache_.diagnostics().warn(
        place(), "friction and condim of pairs are not used; those of the geoms count: {}",
        name_list(rough));
}

}  // namespace clench
