#include "io/inventor.h"

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLNodes.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/elements/SoLazyElement.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoMemoryError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/lists/SoTypeList.h>
#include <Inventor/misc/SoChildList.h>
#include <Inventor/nodekits/SoBaseKit.h>
#include <Inventor/nodes/SoNodes.h>

#include <charconv>
#include <map>
#include <mutex>
#include <set>

#include "base/suggest.h"
#include "base/text.h"
#include "base/units.h"
#include "io/inventor_faces.h"
#include "io/inventor_scan.h"
#include "io/triangulate.h"

namespace clench {

namespace {

namespace fs = std::filesystem;

constexpr int deepest_graph = 1000;    // nodes above one another; Coin walks by recursion
constexpr int deepest_include = 32;    // files that include files
constexpr int most_steps = 2'000'000;  // nodes visited, shared ones each time
constexpr size_t most_triangles = 2'000'000;

/// Coin keeps global state: one reader at a time, its messages caught, a host's handlers put back.
class CoinLease {
 public:
  CoinLease() : lock_(mutex()) {
    static std::once_flag once;
    std::call_once(once, [] {
      SoDB::init();
      SoVRMLInline::setFetchURLCallBack([](const SbString&, void*, SoVRMLInline*) {}, nullptr);
      SoWWWInline::setFetchURLCallBack([](const SbString&, void*, SoWWWInline*) {}, nullptr);
    });
    read_ = SoReadError::getHandlerCallback(), read_data_ = SoReadError::getHandlerData();
    debug_ = SoDebugError::getHandlerCallback(), debug_data_ = SoDebugError::getHandlerData();
    SoReadError::setHandlerCallback(on_read_error, this);
    SoDebugError::setHandlerCallback([](const SoError*, void*) {}, nullptr);
  }
  ~CoinLease() {
    SoReadError::setHandlerCallback(read_, read_data_);
    SoDebugError::setHandlerCallback(debug_, debug_data_);
  }
  CoinLease(const CoinLease&) = delete;

  std::string error;  ///< first message of the reader

 private:
  static std::mutex& mutex() {
    static std::mutex m;
    return m;
  }
  static void on_read_error(const SoError* error, void* data) {
    const std::string text = error->getDebugString().getString();
    auto& first = static_cast<CoinLease*>(data)->error;
    if (first.empty() && text.find("clench:include:") == std::string::npos) first = text;
  }
  std::lock_guard<std::mutex> lock_;
  SoErrorCB* read_;
  void* read_data_;
  SoErrorCB* debug_;
  void* debug_data_;
};

/// Counts a reference to a node.
template <class T>
class Ref {
 public:
  Ref(T* node = nullptr) : node_(node) {
    if (node_) node_->ref();
  }
  Ref(const Ref& other) : Ref(other.node_) {}
  Ref& operator=(Ref other) {
    std::swap(node_, other.node_);
    return *this;
  }
  ~Ref() {
    if (node_) node_->unref();
  }
  T* get() const { return node_; }

 private:
  T* node_;
};

/// What a node of that name is to us. Kits draw handles, scripts run code, textures and sounds read files.
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
        out[type] = is_idle ? NodeType::idle : NodeType::known;
        if (type.starts_with("VRML")) out.emplace(type.substr(4), out[type]);
      }
    }
    return out;
  }();
  const auto found =
      types.find(name.starts_with("So") && !types.contains(name) ? name.substr(2) : name);
  return found == types.end() ? NodeType::unknown : found->second;
}

/// "Coin read error: Unknown field\n\tOccurred at line  12 in <memory>" as "box.iv:12: unknown field"
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
  Loader(CoinLease& coin, const ReadOptions& options) : coin_(coin), options_(options) {}
  Ref<SoSeparator> load(const fs::path& path, const std::string& text);

 private:
  void fill_includes(SoNode* root, const fs::path& path, const InventorText& scanned);
  Ref<SoSeparator> include(const std::string& name, const fs::path& referrer, int line);
  void visit(SoNode* node, const std::string& file, std::vector<SoNode*>& found, int depth = 1);

  CoinLease& coin_;
  const ReadOptions& options_;
  std::map<fs::path, Ref<SoSeparator>> done_;
  std::vector<fs::path> open_;
  std::map<SoNode*, int> heights_;
};

Ref<SoSeparator> Loader::load(const fs::path& path, const std::string& text) {
  const std::string file = path.filename().string();
  const InventorText scanned = scan_inventor(text, file, node_type);
  if (options_.warn)
    for (const auto& warning : scanned.warnings) options_.warn(warning);

  coin_.error.clear();
  SoInput input;
  input.setBuffer(const_cast<char*>(scanned.text.data()), scanned.text.size());
  const Ref<SoSeparator> root = SoDB::readAll(&input);
  const bool harmless = root.get() && coin_.error.find("floating point") == std::string::npos;
  if (!harmless) rethrow(coin_.error, file, scanned.skipped_lines);

  open_.push_back(path);
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

void Loader::fill_includes(SoNode* root, const fs::path& path, const InventorText& scanned) {
  std::vector<SoNode*> nodes;
  heights_.clear();
  visit(root, path.filename().string(), nodes);
  std::map<std::string, int> numbers;
  for (size_t i = 0; i < scanned.includes.size(); ++i)
    numbers[include_key(static_cast<int>(i))] = static_cast<int>(i);
  for (SoNode* node : nodes) {
    Ref<SoSeparator> part;
    if (node->isOfType(SoFile::getClassTypeId())) {
      const auto found = numbers.find(static_cast<SoFile*>(node)->name.getValue().getString());
      if (found == numbers.end()) continue;
      const auto& wanted = scanned.includes[found->second];
      part = include(wanted.name, path, wanted.line);
      node->getChildren()->append(part.get());
    } else if (node->isOfType(SoVRMLInline::getClassTypeId())) {
      auto* inlined = static_cast<SoVRMLInline*>(node);
      if (inlined->url.getNum() == 0) continue;
      part = include(inlined->url[0].getString(), path, 0);
      inlined->setChildData(part.get());
    } else if (node->isOfType(SoWWWInline::getClassTypeId())) {
      auto* inlined = static_cast<SoWWWInline*>(node);
      if (inlined->name.getValue().getLength() == 0) continue;
      part = include(inlined->name.getValue().getString(), path, 0);
      inlined->setChildData(part.get());
    }
  }
  // the parts make it deeper
  nodes.clear();
  heights_.clear();
  if (!scanned.includes.empty()) visit(root, path.filename().string(), nodes);
}

Ref<SoSeparator> Loader::include(const std::string& name, const fs::path& referrer, int line) {
  const std::string place =
      referrer.filename().string() + (line > 0 ? fmt::format(":{}", line) : "");
  fs::path path;
  std::string text;
  try {
    path = fs::weakly_canonical(find_file(name, referrer, options_));
    text = read_text(path);
  } catch (const Error& error) {
    fail("{}: {}", place, error.what());
  }
  for (const auto& above : open_)
    if (fs::weakly_canonical(above) == path) fail("{}: '{}' includes itself", place, name);
  if (open_.size() >= deepest_include)
    fail("{}: '{}': wanted files that include one another at most {} deep", place, name,
         deepest_include);
  if (const auto found = done_.find(path); found != done_.end()) return found->second;
  auto part = load(path, text);
  done_[path] = part;
  return part;
}

/// Walks a scene graph and gathers its triangles.
class Collector {
 public:
  explicit Collector(std::string file) : file_(std::move(file)) {}
  void apply(SoNode* root);

  GeometryBuilder builder;
  bool colors_given = false;
  std::set<std::string> warnings;

 private:
  static SoCallbackAction::Response on_node(void* self, SoCallbackAction* action,
                                            const SoNode* node) {
    return static_cast<Collector*>(self)->enter(action, const_cast<SoNode*>(node));
  }
  static void on_triangle(void* self, SoCallbackAction* action, const SoPrimitiveVertex* a,
                          const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
    static_cast<Collector*>(self)->add(action, {a->getPoint(), b->getPoint(), c->getPoint()},
                                       a->getMaterialIndex());
  }
  SoCallbackAction::Response enter(SoCallbackAction* action, SoNode* node);
  SoCallbackAction::Response enter_shape(SoCallbackAction* action, SoNode* node);
  void add_faces(SoCallbackAction* action, const FaceList& list);
  void add(SoCallbackAction* action, const std::array<SbVec3f, 3>& corners, int color,
           const SbColor* given = nullptr);

  std::string file_, error_;
  int steps_ = 0;
  bool clockwise_ = false;  // how the shape at hand turns
};

void Collector::apply(SoNode* root) {
  SoCallbackAction action;
  action.addPreCallback(SoNode::getClassTypeId(), on_node, this);
  action.addTriangleCallback(SoShape::getClassTypeId(), on_triangle, this);
  // where a file says nothing about its faces they may be of any shape
  const Ref<SoSeparator> all(new SoSeparator);
  auto* hints = new SoShapeHints;
  hints->faceType = SoShapeHints::UNKNOWN_FACE_TYPE;
  all.get()->addChild(hints);
  all.get()->addChild(root);
  action.apply(all.get());
  if (!error_.empty()) fail("{}: {}", file_, error_);
}

SoCallbackAction::Response Collector::enter(SoCallbackAction* action, SoNode* node) {
  const auto is = [&](SoType type) { return node->isOfType(type); };
  if (++steps_ > most_steps)
    error_ = fmt::format("wanted at most {} nodes, shared ones counted each time", most_steps);
  if (builder.triangle_count() > most_triangles)
    error_ = fmt::format("wanted at most {} triangles", most_triangles);
  if (!error_.empty()) return SoCallbackAction::ABORT;
  if (is(SoMaterial::getClassTypeId()) || is(SoBaseColor::getClassTypeId()) ||
      is(SoPackedColor::getClassTypeId()) || is(SoVRMLMaterial::getClassTypeId()))
    colors_given = true;
  if (!is(SoShape::getClassTypeId())) return SoCallbackAction::CONTINUE;

  // no exception may pass through Coin
  try {
    return enter_shape(action, node);
  } catch (const Error& error) {
    error_ = error.what();
  }
  return SoCallbackAction::ABORT;
}

SoCallbackAction::Response Collector::enter_shape(SoCallbackAction* action, SoNode* node) {
  if (const auto faces = list_faces(action, node)) {
    add_faces(action, *faces);
    return SoCallbackAction::PRUNE;
  }
  // the shapes given by their sizes are Coin's to cut into triangles
  const SoType round[] = {SoCube::getClassTypeId(),         SoSphere::getClassTypeId(),
                          SoCylinder::getClassTypeId(),     SoCone::getClassTypeId(),
                          SoVRMLBox::getClassTypeId(),      SoVRMLSphere::getClassTypeId(),
                          SoVRMLCylinder::getClassTypeId(), SoVRMLCone::getClassTypeId(),
                          SoVRMLExtrusion::getClassTypeId()};
  clockwise_ = node->isOfType(SoVRMLExtrusion::getClassTypeId()) &&
               !static_cast<SoVRMLExtrusion*>(node)->ccw.getValue();
  for (const SoType type : round)
    if (node->isOfType(type)) return SoCallbackAction::CONTINUE;
  const std::string name = node_name(node);
  const bool flat = name.find("Line") != std::string::npos ||
                    name.find("Point") != std::string::npos ||
                    name.find("Text") != std::string::npos;
  if (!flat) warnings.insert(fmt::format("{}: {} is not used as geometry", file_, name));
  return SoCallbackAction::PRUNE;
}

void Collector::add_faces(SoCallbackAction* action, const FaceList& list) {
  clockwise_ = list.clockwise;
  colors_given = colors_given || !list.colors.empty();
  std::vector<Eigen::Vector3d> corners;
  std::vector<SbVec3f> points;
  for (const auto& face : list.faces) {
    corners.clear();
    points.clear();
    for (int i = 0; i < face.count; ++i) {
      points.push_back(list.point(list.corners[face.first + i]));
      corners.emplace_back(points.back()[0], points.back()[1], points.back()[2]);
    }
    const int last_color = static_cast<int>(list.colors.size()) - 1;
    const SbColor* color =
        list.colors.empty() ? nullptr : &list.colors[std::clamp(face.color, 0, last_color)];
    for (const auto& t : triangulate(corners, list.convex))
      add(action, {points[t[0]], points[t[1]], points[t[2]]}, face.color, color);
  }
}

void Collector::add(SoCallbackAction* action, const std::array<SbVec3f, 3>& corners, int color,
                    const SbColor* given) {
  const SbMatrix& X = action->getModelMatrix();
  std::array<Eigen::Vector3d, 3> points;
  for (int i = 0; i < 3; ++i) {
    SbVec3f p;
    X.multVecMatrix(corners[i], p);
    points[i] = Eigen::Vector3d(p[0], p[1], p[2]) * units::millimetre;
  }
  // a mirrored shape is inside out
  if (clockwise_ != (X.det3() < 0)) std::swap(points[1], points[2]);

  SoState* state = action->getState();
  const SoLazyElement* material = SoLazyElement::getInstance(state);
  const int colors = material->getNumDiffuse(), alphas = material->getNumTransparencies();
  SbColor diffuse(0.8f, 0.8f, 0.8f);
  if (given)
    diffuse = *given;
  else if (colors > 0)
    diffuse = SoLazyElement::getDiffuse(state, std::clamp(color, 0, colors - 1));
  const float alpha =
      alphas > 0 ? SoLazyElement::getTransparency(state, std::clamp(color, 0, alphas - 1)) : 0.0f;
  builder.add(points,
              Eigen::Vector3f(diffuse[0], diffuse[1], diffuse[2]).cwiseMax(0.0f).cwiseMin(1.0f),
              std::clamp(alpha, 0.0f, 1.0f));
}

}  // namespace

Geometry read_inventor(const fs::path& path, const std::string& text, const ReadOptions& options) {
  CoinLease coin;
  const std::string file = path.filename().string();
  const Ref<SoSeparator> root = Loader(coin, options).load(path, text);
  Collector collector(file);
  collector.apply(root.get());
  if (options.warn)
    for (const auto& warning : collector.warnings) options.warn(warning);
  return collector.builder.finish(collector.colors_given, file, options);
}

}  // namespace clench
