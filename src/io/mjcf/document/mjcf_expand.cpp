#include "clench/io/mjcf/document/mjcf_expand.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "clench/base/suggest.h"
#include "clench/base/watched.h"
#include "clench/io/mjcf/document/mjcf_attach.h"
#include "clench/io/mjcf/document/mjcf_names.h"
#include "clench/io/text/find_file.h"

namespace clench {

/// Sections whose elements refer to bodies, joints and geoms; tendons come first because others
/// refer to them.
static constexpr const char* referring_sections[] = {"tendon", "equality", "contact", "actuator"};

class MjcfExpander {
 public:
  MjcfExpander(MjcfDocument& document, FileCache& cache) : document_(document), cache_(cache) {}

  void expand() {
    document_.open_.push_back(std::filesystem::weakly_canonical(document_.path()));
    expand(document_.root_);
    document_.open_.pop_back();
  }

 private:
  void expand(MjcfNode& root) {
    std::vector<MjcfNode> worlds;
    for (const MjcfNode& section : root.children)
      if (section.name() == "worldbody") worlds.push_back(section);
    // the loop may append sections
    for (size_t i = 0, next = 0; i < root.children.size(); ++i) {
      if (root.children[i].name() != "worldbody" || next == worlds.size()) continue;
      MjcfNode world = worlds[next++];
      expand_below(world, root);
      root.children[i] = std::move(world);
    }
  }

  using Rename = std::function<std::string(const MjcfNode& node, const std::string& attribute,
                                           const std::string& value)>;

  void expand_below(MjcfNode& node, MjcfNode& root);
  void replicate(const MjcfNode& node, MjcfNode& root, std::vector<MjcfNode>& into);
  void attach(const MjcfNode& node, MjcfNode& root, std::vector<MjcfNode>& into);
  AttachTarget attach_target(const XmlValues& values, const MjcfNode& source);
  MjcfNode* attached_model(const XmlValues& values, MjcfNode& root);
  MjcfNode& model_of(const XmlElement& asset, const std::string& file);
  void copy_assets(const MjcfNode& from, MjcfNode& root, const std::string& prefix);
  void copy_sections(const MjcfNode& from, MjcfNode& root, const Rename& rename);
  void attach_sections(const XmlElement& at, const MjcfNode& source, MjcfNames& attached,
                       const AttachedNames& rename, MjcfNode& root);
  void append_section(MjcfNode section, MjcfNode& root);
  MjcfNode copy(const MjcfNode& node, const Rename& rename, XmlCopies::Attributes more = {});
  MjcfNode frame(const XmlElement& original, XmlCopies::Attributes attributes);
  void count(const XmlElement& original);
  void count_below(const MjcfNode& node);
  void search(const XmlElement& at, size_t elements);
  MjcfNames& referred(const MjcfNode& root);

  /// Calls visit with each section whose elements may refer to these names.
  template <class Root, class Visit>
  void for_referring(const XmlElement& at, Root& root, const MjcfNames& names, Visit visit) {
    if (!names.overlaps(referred(root))) return;
    for (const char* section : referring_sections)
      for (auto& part : root.children) {
        search(at, 1);
        if (part.name() != section) continue;
        search(at, part.children.size());
        visit(part);
      }
  }

  MjcfDocument& document_;
  FileCache& cache_;
  int generated_ = 0;
  StopCheck check_{1000};
  int depth_ = 0;
  int64_t searched_ = 0;
  std::map<std::string, std::filesystem::path> model_files_;  // by place of the asset
  std::map<std::string, MjcfNode> models_;  // of attached files, by place of the asset
  std::vector<const MjcfNode*> attaching_;  // targets, outermost first
  // names to which the referring sections of a model refer; may contain outdated ones
  std::map<const MjcfNode*, MjcfNames> referred_;
  std::set<std::pair<const MjcfNode*, std::string>> copied_assets_;  // of models, with prefixes
};

// --- copies ---

/// Counts a generated element.
void MjcfExpander::count(const XmlElement& original) {
  check_();
  if (++generated_ > max_generated_elements)
    original.fail("expected at most {} elements made by replicate and attach",
                  max_generated_elements);
}

void MjcfExpander::count_below(const MjcfNode& node) {
  for (const MjcfNode& child : node.children) {
    count(child.element);
    count_below(child);
  }
}

/// Counts elements that are searched for names.
void MjcfExpander::search(const XmlElement& at, size_t elements) {
  check_();
  searched_ += static_cast<int64_t>(elements);
  if (searched_ > max_searched_elements)
    at.fail("expected replicate and attach to search at most {} elements for names",
            max_searched_elements);
}

MjcfNames& MjcfExpander::referred(const MjcfNode& root) {
  const auto [found, is_new] = referred_.try_emplace(&root);
  if (!is_new) return found->second;
  for (const MjcfNode& section : root.children)
    if (std::ranges::find(referring_sections, section.name()) != std::end(referring_sections))
      found->second.add_referred(section);
  return found->second;
}

MjcfNode MjcfExpander::copy(const MjcfNode& node, const Rename& rename,
                            XmlCopies::Attributes more) {
  count(node.element);
  XmlCopies::Attributes attributes;
  for (const std::string& key : node.element.attributes())
    attributes.emplace_back(key, rename(node, key, node.element.attribute(key).value_or("")));
  for (auto& entry : more)
    if (!node.element.attribute(entry.first)) attributes.push_back(std::move(entry));
  MjcfNode out{document_.copies_.make(node.element, node.element.name(), attributes), {}};
  for (const MjcfNode& child : node.children) out.children.push_back(copy(child, rename));
  return out;
}

MjcfNode MjcfExpander::frame(const XmlElement& original, XmlCopies::Attributes attributes) {
  count(original);
  return {document_.copies_.make(original, "frame", attributes), {}};
}

void MjcfExpander::expand_below(MjcfNode& node, MjcfNode& root) {
  std::vector<MjcfNode> children;
  for (MjcfNode& child : node.children) {
    check_();
    const std::string name = child.name();
    if (name == "attach") {
      attach(child, root, children);
      continue;
    }
    expand_below(child, root);
    if (name == "replicate")
      replicate(child, root, children);
    else
      children.push_back(std::move(child));
  }
  node.children = std::move(children);
}

// --- replicate ---

static XmlCopies::Attributes pose_attributes(const Pose& X) {
  const auto& p = X.position;
  const auto& q = X.rotation;
  return {{"pos", fmt::format("{} {} {}", p.x(), p.y(), p.z())},
          {"quat", fmt::format("{} {} {} {}", q.w(), q.x(), q.y(), q.z())}};
}

/// Places each replica in the frame of the previous one. Names end in `sep` and the replica's
/// number, padded to the number of digits of their count.
void MjcfExpander::replicate(const MjcfNode& node, MjcfNode& root, std::vector<MjcfNode>& into) {
  check_stop();
  const XmlValues values(node.element);
  document_.unused_.attributes(node.element, {"count", "sep", "offset", "euler", "childclass"});
  values.text("count");
  const int count = values.integer("count", 0);
  if (count < 1) values.fail("count", "expected a count >= 1, got {}", count);
  for (const MjcfNode& child : node.children)
    if (child.name() == "joint" || child.name() == "freejoint")
      child.element.fail("replicate: expected joints inside of a body only");
  Pose step = Pose::translation(values.vec3("offset", {0, 0, 0}));
  if (values.has("euler"))
    step.rotation = euler_turn(document_.settings(node.element), values.numbers("euler", 3, 3));
  const std::string sep = values.text("sep", "");
  const size_t digits = std::to_string(count).size();
  MjcfNames names;
  names.add(node.children);
  // elements that refer to replicas are copied after all replicas exist
  MjcfNode referring{node.element, {}};
  for_referring(node.element, root, names, [&](MjcfNode& part) {
    MjcfNode found{part.element, {}};
    std::erase_if(part.children, [&](MjcfNode& element) {
      check_();
      if (names.references(element).inside == 0) return false;
      names.add(element);
      found.children.push_back(std::move(element));
      return true;
    });
    if (!found.children.empty()) referring.children.push_back(std::move(found));
  });
  Pose X;
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    const std::string suffix = sep + std::string(digits - number.size(), '0') + number;
    XmlCopies::Attributes attributes = pose_attributes(X);
    if (const auto inherited = node.element.attribute("childclass"))
      attributes.emplace_back("childclass", *inherited);
    MjcfNode replica = frame(node.element, std::move(attributes));
    const Rename in_tree = [&](const MjcfNode&, const std::string& attribute,
                               const std::string& value) {
      return attribute == "name" && !value.empty() ? value + suffix : value;
    };
    for (const MjcfNode& child : node.children) replica.children.push_back(copy(child, in_tree));
    into.push_back(std::move(replica));
    const Rename in_sections = [&](const MjcfNode& at, const std::string& attribute,
                                   const std::string& value) {
      const bool refers = names.has(referred_kind(attribute), value);
      return refers ? value + suffix : in_tree(at, attribute, value);
    };
    copy_sections(referring, root, in_sections);
    X = X * step;
  }
}

/// Appends renamed copies of elements.
void MjcfExpander::copy_sections(const MjcfNode& from, MjcfNode& root, const Rename& rename) {
  for (const MjcfNode& section : from.children) {
    MjcfNode out{section.element, {}};
    for (const MjcfNode& element : section.children) out.children.push_back(copy(element, rename));
    append_section(std::move(out), root);
  }
}

void MjcfExpander::append_section(MjcfNode section, MjcfNode& root) {
  referred(root).add_referred(section);
  root.children.push_back(std::move(section));
}

// --- attach ---

/// The model of an asset, read when it is first attached.
MjcfNode& MjcfExpander::model_of(const XmlElement& asset, const std::string& file) {
  const std::string key = asset.place().text() + ' ' + file;
  auto& open = document_.open_;
  const auto refuse_open = [&](const std::filesystem::path& path) {
    if (std::ranges::find(open, path) != open.end())
      asset.fail("model: '{}' attaches itself", excerpt(file));
  };
  if (const auto found = models_.find(key); found != models_.end()) {
    refuse_open(model_files_[key]);
    return found->second;
  }
  document_.unused_.attributes(asset, {"name", "file", "content_type"});
  std::filesystem::path path;
  try {
    path = find_file(file, document_.settings(asset).path, cache_.options());
  } catch (const Error& error) {
    asset.fail("model: {}", error.what());
  }
  const auto canonical = std::filesystem::weakly_canonical(path);
  refuse_open(canonical);
  MjcfNode model = document_.load_file(path);
  model_files_[key] = canonical;
  open.push_back(canonical);
  MjcfNode& kept = models_.emplace(key, std::move(model)).first->second;
  expand(kept);
  open.pop_back();
  return kept;
}

/// The model that an <attach> names; null: this model itself.
MjcfNode* MjcfExpander::attached_model(const XmlValues& values, MjcfNode& root) {
  if (!values.has("model")) return nullptr;
  const std::string name = values.text("model");
  std::vector<std::string> names;
  for (const MjcfNode& section : root.children) {
    if (section.name() != "asset") continue;
    for (const MjcfNode& asset : section.children) {
      if (asset.name() != "model") continue;
      search(asset.element, 1);
      const XmlValues of_asset(asset.element);
      const std::string file = of_asset.text("file"), given = of_asset.text("name", "");
      names.push_back(given);
      if (!given.empty() && given != name) continue;
      MjcfNode& model = model_of(asset.element, file);
      names.back() = model.element.attribute("model").value_or("");
      if (given == name || names.back() == name) return &model;
    }
  }
  values.fail("model", "no model {}{}", in_quotes(name), did_you_mean(name, names));
}

void MjcfExpander::copy_assets(const MjcfNode& from, MjcfNode& root, const std::string& prefix) {
  if (!copied_assets_.emplace(&from, prefix).second) return;
  for (const MjcfNode& section : from.children)
    if (section.name() == "default") count_below(section);
  document_.add_classes(from, prefix);
  for (const MjcfNode& section : from.children) {
    const std::string name = section.name();
    if (name == "asset") {
      MjcfNode out{section.element, {}};
      for (const MjcfNode& asset : section.children) {
        if (asset.name() == "model") continue;
        // a mesh without a name is named after its file
        const std::string file = asset.element.attribute("file").value_or("");
        const std::string stem = std::filesystem::path(file).stem().string();
        XmlCopies::Attributes more = {{"name", prefix + stem}, {"class", prefix + "main"}};
        if (asset.name() == "texture")
          more = {{"name", prefix + stem}};
        else if (asset.name() != "mesh" && asset.name() != "material")
          more.clear();
        out.children.push_back(copy(
            asset,
            [&](const MjcfNode&, const std::string& attribute, const std::string& value) {
              const bool names = attribute == "name" || attribute == "class" ||
                                 attribute == "material" || attribute == "texture";
              return names && !value.empty() ? prefix + value : value;
            },
            std::move(more)));
      }
      root.children.push_back(std::move(out));
    } else if (name == "keyframe" || name == "sensor") {
      document_.unused_.element(section.element);
    }
  }
}

AttachTarget MjcfExpander::attach_target(const XmlValues& values, const MjcfNode& source) {
  const std::string kind = values.has("body") ? "body" : values.has("frame") ? "frame" : "";
  if (kind.empty()) return {};
  const std::string name = values.text(kind.c_str());
  size_t searched = 0;
  const AttachTarget target = find_attach_target(source, kind, name, searched);
  search(values.element(), searched);
  if (!target.node)
    values.fail(kind.c_str(), "no {} {}{}", kind, in_quotes(name),
                did_you_mean(name, attach_target_names(source, kind)));
  if (std::ranges::find(attaching_, target.node) != attaching_.end())
    values.element().fail("attach: {} '{}' attaches itself", kind, excerpt(name));
  return target;
}

/// Copies the elements of other sections that refer to attached elements only.
void MjcfExpander::attach_sections(const XmlElement& at, const MjcfNode& source,
                                   MjcfNames& attached, const AttachedNames& rename,
                                   MjcfNode& root) {
  std::vector<MjcfNode> sections;
  for_referring(at, source, attached, [&](const MjcfNode& part) {
    MjcfNode out{part.element, {}};
    for (const MjcfNode& element : part.children) {
      check_();
      const auto references = attached.references(element);
      if (references.inside == 0) continue;
      if (references.outside > 0) {
        document_.repairs_.add("attached", element.element.place().of(excerpt(element.name())),
                               "refers to elements that are not attached; not used");
        continue;
      }
      attached.add(element);
      XmlCopies::Attributes more;
      if (rename.of_other_model) more.emplace_back("class", rename.class_name(""));
      out.children.push_back(copy(element, rename, std::move(more)));
    }
    if (!out.children.empty()) sections.push_back(std::move(out));
  });
  // at the end, as the source may be this model
  for (MjcfNode& section : sections) append_section(std::move(section), root);
}

/// Copies a body, a frame or all contents of a model and adds a prefix to their names. Frames
/// around a body or frame are omitted; classes are inherited.
void MjcfExpander::attach(const MjcfNode& node, MjcfNode& root, std::vector<MjcfNode>& into) {
  check_stop();
  constexpr int max_depth = 20;
  if (++depth_ > max_depth)
    node.element.fail("attach: expected at most {} attached in each other", max_depth);
  const XmlValues values(node.element);
  document_.unused_.attributes(node.element, {"model", "body", "frame", "prefix"});
  const std::string prefix = values.text("prefix");
  MjcfNode* model = attached_model(values, root);
  if (!model && !values.has("body") && !values.has("frame"))
    node.element.fail("attach: expected an attribute 'model', 'body' or 'frame', got none");
  const MjcfNode& source = model ? *model : root;
  const AttachTarget target = attach_target(values, source);
  const AttachedNames rename{prefix, model != nullptr};
  std::vector<MjcfNode> content;
  if (target.node) {
    content.push_back(*target.node);
  } else {
    for (const MjcfNode& section : source.children)
      if (section.name() == "worldbody")
        content.insert(content.end(), section.children.begin(), section.children.end());
  }
  if (!model) {  // its contents may attach other models
    attaching_.push_back(target.node);
    for (MjcfNode& part : content) expand_below(part, root);
    attaching_.pop_back();
  }
  MjcfNames names;
  names.add(content);
  XmlCopies::Attributes inherited;
  if (const std::string name = rename.class_name(target.child_class); !name.empty())
    inherited.emplace_back("childclass", name);
  if (target.node) {
    into.push_back(copy(content.front(), rename, inherited));
  } else {
    MjcfNode all = frame(node.element, inherited);
    for (const MjcfNode& part : content) all.children.push_back(copy(part, rename));
    into.push_back(std::move(all));
  }
  if (model) copy_assets(*model, root, prefix);
  attach_sections(node.element, source, names, rename, root);
  --depth_;
}

MjcfDocument& expand_mjcf(MjcfDocument& document, FileCache& cache) {
  MjcfExpander(document, cache).expand();
  return document;
}

}  // namespace clench
