#include "clench/io/inventor/inventor_graph.h"

#include <map>

#include "clench/base/text.h"
#include "clench/io/inventor/inventor_parser.h"
#include "clench/io/text/file_errors.h"
#include "clench/io/text/find_file.h"

namespace clench {

namespace fs = std::filesystem;

namespace {

constexpr size_t max_nested_files = 32;  // depth of files that include files

/// Reads files into nodes, each file once.
class InventorLoader {
 public:
  InventorLoader(InventorGraph& graph, const ReadOptions& options)
      : graph_(graph), options_(options) {}
  const InventorNode* load(const fs::path& path, const std::string& text);

 private:
  const InventorNode* include(const std::string& name, const fs::path& referrer, int line);
  const InventorNode* load_part(const fs::path& path, const std::string& place);

  InventorGraph& graph_;
  const ReadOptions& options_;
  InventorBudget budget_;
  std::map<fs::path, const InventorNode*> done_;
  std::map<std::pair<fs::path, std::string>, fs::path> found_;  // by referrer and name
  size_t includes_ = 0;
  std::vector<fs::path> open_;  // canonical
};

const InventorNode* InventorLoader::load(const fs::path& path, const std::string& text) {
  graph_.files.push_back(path.filename().string());
  graph_.bytes += text.size();
  open_.push_back(fs::weakly_canonical(path));
  const int file = static_cast<int>(graph_.files.size()) - 1;
  InventorParser parser(text, file, graph_, budget_, [&](const std::string& name, int line) {
    return include(name, path, line);
  });
  const InventorNode* root = parser.read();
  open_.pop_back();
  return root;
}

const InventorNode* InventorLoader::include(const std::string& name, const fs::path& referrer,
                                            int line) {
  const std::string place = fmt::format("{}:{}", referrer.filename().string(), line);
  if (++includes_ > max_includes)
    fail("{}: expected at most {} included files, each counted as often as it is named", place,
         max_includes);
  fs::path& path = found_[{referrer, name}];
  errors_at(place, [&] {
    if (path.empty()) path = fs::weakly_canonical(find_file(name, referrer, options_));
  });
  for (const auto& above : open_)
    if (above == path) fail("{}: {} includes itself", place, in_quotes(name));
  if (open_.size() >= max_nested_files)
    fail("{}: {}: expected files that include one another at most {} deep", place, in_quotes(name),
         max_nested_files);
  const auto done = done_.find(path);
  return done != done_.end() ? done->second : done_[path] = load_part(path, place);
}

const InventorNode* InventorLoader::load_part(const fs::path& path, const std::string& place) {
  const std::string text = errors_at(place, [&] { return read_text(path); });
  // errors in nested files name the first file and the last
  if (open_.size() > 1) return load(path, text);
  return errors_at(place, [&] { return load(path, text); });
}

}  // namespace

InventorGraph read_inventor_graph(const fs::path& path, const std::string& text,
                                  const ReadOptions& options) {
  InventorGraph graph;
  graph.root = InventorLoader(graph, options).load(path, text);
  return graph;
}

}  // namespace clench
