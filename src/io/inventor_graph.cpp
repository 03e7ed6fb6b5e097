#include "io/inventor_graph.h"

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/VRMLnodes/SoVRMLNodes.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/lists/SoTypeList.h>
#include <Inventor/misc/SoChildList.h>
#include <Inventor/nodekits/SoBaseKit.h>
#include <Inventor/nodes/SoNodes.h>

#include <algorithm>
#include <map>

#include "base/text.h"
#include "io/inventor_scan.h"

namespace clench {

namespace fs = std::filesystem;

namespace {

constexpr int deepest_graph = 1000;  // nodes above one another; Coin walks by recursion
constexpr int deepest_include = 32;  // files that include files

std::mutex& coin_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// What a node of that name is to us. Kits draw handles, scripts run code, textures and sounds read
/// files.
NodeType node_type(const std::string& name) {
  static const std::map<std::string, NodeType> types = [] {
    std::map<std::string, NodeType> out;
    const SoType idle[] = {SoTexture::getClassTypeId(),       SoVRMLTexture::getClassTypeId(),
                           SoBumpMap::getClassTypeId(),       SoShaderObject::getClassTypeId(),
                           SoShaderProgram::getClassTypeId(), SoVRMLSound::getClassTypeId(),
                           SoVRMLAudioClip::getClassTypeId(), SoVRMLScript::getClassTypeId(),
                           SoBaseKit::getClassTypeId()};
    for (const SoType& base : {SoNode::getClassTypeId(), SoType::fromName("Engine")}) {
      SoTypeList list;
      SoType::getAllDerivedFrom(base, list);
      for (int i = 0; i < list.getLength(); ++i) {
        const std::string type = list[i].getName().getString();
        if (!list[i].canCreateInstance() || type.ends_with("Manip")) continue;
        const bool is_idle = std::any_of(std::begin(idle), std::end(idle),
                                         [&](SoType t) { return list[i].isDerivedFrom(t); });
        const bool is_shape =
            list[i].isDerivedFrom(SoShape::getClassTypeId()) && !type.starts_with("VRML");
        out[type] = is_idle ? NodeType::idle : is_shape ? NodeType::shape : NodeType::known;
        if (type.starts_with("VRML")) out.emplace(type.substr(4), out[type]);
      }
    }
    return out;
  }();
  const auto found =
      types.find(name.starts_with("So") && !types.contains(name) ? name.substr(2) : name);
  return found == types.end() ? NodeType::unknown : found->second;
}

/// "Coin read error: Unknown field\n\tOccurred at line  12 in <memory>" as "box.iv:12: unknown
/// field"
[[noreturn]] void rethrow(const std::string& message, const std::string& file, int skipped_lines) {
  std::string text = message;
  const std::string_view intro = "Coin read error: ", where = "Occurred at line";
  if (text.starts_with(intro)) text.erase(0, intro.size());
  int line = 1;
  if (const size_t at = text.find(where); at != std::string::npos) {
    const auto words = split_words(std::string_view(text).substr(at + where.size()));
    line = words.empty() ? 1 : parse_integer(words[0]).value_or(1);
    text.erase(at);
  }
  if (text.find("floating point") != std::string::npos)
    text = "wanted a finite number that fits 32 bits";
  std::string sentence;
  for (const auto word : split_words(text)) {
    if (!sentence.empty()) sentence += ' ';
    sentence += word;
  }
  fail("{}:{}: {}", file, line + skipped_lines,
       sentence.empty() ? "the file cannot be read" : sentence);
}

/// Files to scene graphs, each read once.
class Loader {
 public:
  Loader(CoinLease& coin, const ReadOptions& options, std::vector<std::string>& warnings,
         std::map<const SoNode*, std::string>& places)
      : coin_(coin), options_(options), warnings_(warnings), places_(places) {}
  Ref<SoSeparator> load(const fs::path& path, const std::string& text);

 private:
  void fill_includes(SoNode* root, const fs::path& path, const InventorText& scanned);
  Ref<SoSeparator> include(const std::string& name, const fs::path& referrer, int line);
  const fs::path& find(const std::string& name, const fs::path& referrer);
  std::map<const SoNode*, int> lines_of(const std::vector<SoNode*>& nodes,
                                        const InventorText& scanned) const;
  void visit(SoNode* node, const std::string& file, std::vector<SoNode*>& found, int depth = 1);

  CoinLease& coin_;
  const ReadOptions& options_;
  std::vector<std::string>& warnings_;
  std::map<const SoNode*, std::string>& places_;
  std::map<fs::path, Ref<SoSeparator>> done_;
  std::map<std::pair<fs::path, std::string>, fs::path> found_;  // by referrer and name
  size_t includes_ = 0;
  std::vector<fs::path> open_;  // canonical
  std::map<SoNode*, int> heights_;
};

Ref<SoSeparator> Loader::load(const fs::path& path, const std::string& text) {
  const std::string file = path.filename().string();
  const InventorText scanned = scan_inventor(text, file, node_type);
  warnings_.insert(warnings_.end(), scanned.warnings.begin(), scanned.warnings.end());

  coin_.error.clear();
  SoInput input;
  input.setBuffer(const_cast<char*>(scanned.text.data()), scanned.text.size());
  const Ref<SoSeparator> root = SoDB::readAll(&input);
  const bool harmless = root.get() && coin_.error.find("floating point") == std::string::npos;
  if (!harmless) rethrow(coin_.error, file, scanned.skipped_lines);

  open_.push_back(fs::weakly_canonical(path));
  fill_includes(root.get(), path, scanned);
  open_.pop_back();
  return root;
}

/// All nodes below, each once; remembers how deep it goes below each.
void Loader::visit(SoNode* node, const std::string& file, std::vector<SoNode*>& found, int depth) {
  if (heights_.contains(node)) return;
  int height = deepest_graph;
  heights_[node] = height;  // stands while we are below it: a circle is endlessly deep
  found.push_back(node);
  if (depth <= deepest_graph) {
    height = 0;
    const SoChildList* children = node->getChildren();
    for (int i = 0; children && i < children->getLength(); ++i) {
      visit((*children)[i], file, found, depth + 1);
      height = std::max(height, heights_[(*children)[i]]);
    }
  }
  if (height >= deepest_graph) fail("{}: wanted nodes at most {} deep", file, deepest_graph);
  heights_[node] = height + 1;
}

/// "IndexedFaceSet" of SoIndexedFaceSet and VRMLIndexedFaceSet.
std::string bare_type(std::string name) {
  for (const char* prefix : {"So", "VRML"})
    if (name.starts_with(prefix)) name.erase(0, std::string_view(prefix).size());
  return name;
}

/// Where shapes stand: nodes of a type come in the order of the text, unless something
/// made more of them, or fewer.   `nodes`  of one file, each once, in order
std::map<const SoNode*, int> Loader::lines_of(const std::vector<SoNode*>& nodes,
                                              const InventorText& scanned) const {
  std::map<std::string, std::vector<const SoNode*>> by_type;
  for (const SoNode* node : nodes)
    if (node->isOfType(SoShape::getClassTypeId()))
      by_type[bare_type(node->getTypeId().getName().getString())].push_back(node);
  std::map<std::string, std::vector<int>> lines;
  for (const auto& [type, line] : scanned.nodes)
    if (const std::string name = bare_type(type); by_type.contains(name))
      lines[name].push_back(line);
  std::map<const SoNode*, int> out;
  for (const auto& [type, same] : by_type) {
    const std::vector<int>& known = lines[type];
    for (size_t i = 0; known.size() == same.size() && i < same.size(); ++i) out[same[i]] = known[i];
  }
  return out;
}

void Loader::fill_includes(SoNode* root, const fs::path& path, const InventorText& scanned) {
  std::vector<SoNode*> nodes;
  heights_.clear();
  visit(root, path.filename().string(), nodes);
  const auto lines = lines_of(nodes, scanned);
  for (const auto& [node, line] : lines)
    places_[node] = fmt::format("{}:{}", path.filename().string(), line);
  std::map<std::string, int> numbers;
  for (size_t i = 0; i < scanned.includes.size(); ++i)
    numbers[include_key(static_cast<int>(i))] = static_cast<int>(i);
  const size_t before = includes_;
  // filling a node drops what stood below it, which is among these, too
  const std::vector<Ref<SoNode>> kept(nodes.begin(), nodes.end());
  // the include that a node names; a PROTO may leave it open
  const auto included = [&](const SbString& key) -> Ref<SoSeparator> {
    const auto found = numbers.find(key.getString());
    if (found == numbers.end()) return {};
    const InventorInclude& wanted = scanned.includes[found->second];
    return include(wanted.name, path, wanted.line);
  };
  for (SoNode* node : nodes) {
    if (node->isOfType(SoFile::getClassTypeId())) {
      const auto part = included(static_cast<SoFile*>(node)->name.getValue());
      if (part.get()) node->getChildren()->append(part.get());
    } else if (node->isOfType(SoVRMLInline::getClassTypeId())) {
      auto* inlined = static_cast<SoVRMLInline*>(node);
      if (inlined->url.getNum() == 0) continue;
      const auto part = included(inlined->url[0]);
      if (part.get()) inlined->setChildData(part.get());
    } else if (node->isOfType(SoWWWInline::getClassTypeId())) {
      auto* inlined = static_cast<SoWWWInline*>(node);
      const auto part = included(inlined->name.getValue());
      if (part.get()) inlined->setChildData(part.get());
    }
  }
  // the parts make it deeper
  nodes.clear();
  heights_.clear();
  if (includes_ > before) visit(root, path.filename().string(), nodes);
}

const fs::path& Loader::find(const std::string& name, const fs::path& referrer) {
  const auto key = std::pair(referrer, name);
  auto found = found_.find(key);
  if (found == found_.end()) {
    const fs::path path = fs::weakly_canonical(find_file(name, referrer, options_));
    found = found_.emplace(key, path).first;
  }
  return found->second;
}

Ref<SoSeparator> Loader::include(const std::string& name, const fs::path& referrer, int line) {
  const std::string place =
      referrer.filename().string() + (line > 0 ? fmt::format(":{}", line) : "");
  if (++includes_ > most_includes)
    fail("{}: wanted at most {} included files, each counted as often as it is named", place,
         most_includes);
  fs::path path;
  try {
    path = find(name, referrer);
  } catch (const Error& error) {
    fail("{}: {}", place, error.what());
  }
  for (const auto& above : open_)
    if (above == path) fail("{}: '{}' includes itself", place, name);
  if (open_.size() >= deepest_include)
    fail("{}: '{}': wanted files that include one another at most {} deep", place, name,
         deepest_include);
  if (const auto found = done_.find(path); found != done_.end()) return found->second;
  const bool outermost = open_.size() == 1;
  std::string text;
  Ref<SoSeparator> part;
  try {
    text = read_text(path);
  } catch (const Error& error) {
    fail("{}: {}", place, error.what());
  }
  try {
    part = load(path, text);
  } catch (const Error& error) {
    // of a chain of files the first and the last are told
    if (outermost) fail("{}: {}", place, error.what());
    throw;
  }
  done_[path] = part;
  return part;
}

}  // namespace

CoinLease::CoinLease() : lock_(coin_mutex()) {
  static const bool once = [] {
    SoDB::init();
    // what stands in place of an included file is ours to fetch
    SoVRMLInline::setFetchURLCallBack([](const SbString&, void*, SoVRMLInline*) {}, nullptr);
    SoWWWInline::setFetchURLCallBack([](const SbString&, void*, SoWWWInline*) {}, nullptr);
    return true;
  }();
  static_cast<void>(once);
  read_ = SoReadError::getHandlerCallback();
  read_data_ = SoReadError::getHandlerData();
  debug_ = SoDebugError::getHandlerCallback();
  debug_data_ = SoDebugError::getHandlerData();
  SoReadError::setHandlerCallback(on_read_error, this);
  SoDebugError::setHandlerCallback([](const SoError*, void*) {}, nullptr);
}

CoinLease::~CoinLease() {
  SoReadError::setHandlerCallback(read_, read_data_);
  SoDebugError::setHandlerCallback(debug_, debug_data_);
}

void CoinLease::on_read_error(const SoError* error, void* self) {
  const std::string text = error->getDebugString().getString();
  auto& first = static_cast<CoinLease*>(self)->error;
  if (first.empty() && text.find("clench:include:") == std::string::npos) first = text;
}

std::string InventorGraph::place(const SoNode* node, const std::string& file) const {
  const auto found = places.find(node);
  if (found == places.end()) return file;
  return found->second.starts_with(file + ":") ? found->second : file + ": " + found->second;
}

InventorGraph load_graph(CoinLease& coin, const fs::path& path, const std::string& text,
                         const ReadOptions& options, std::vector<std::string>& warnings) {
  InventorGraph graph;
  graph.root = Loader(coin, options, warnings, graph.places).load(path, text);
  return graph;
}

}  // namespace clench
