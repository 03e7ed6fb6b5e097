#include "clench/io/text/value_tree.h"

#include <algorithm>
#include <vector>

#include "clench/base/text.h"

namespace clench {

static constexpr size_t max_tree_depth = 16, max_tree_values = size_t{1} << 31;

// --- building ---

void ValueTree::push(const Cell& cell) {
  if (cells_.size() + pending_.size() >= max_tree_values || texts_.size() >= max_tree_values)
    fail(ErrorKind::limit, "{}: the file holds too many values", *file_);
  // a key is followed by its value
  if (!open_.empty() && open_.back().kind == ValueKind::map && cell.kind != ValueKind::scalar &&
      (pending_.size() - open_.back().first) % 2 == 0)
    fail("{}:{}: expected a key, got {}", *file_, cell.line, described(cell));
  check_();
  pending_.push_back(cell);
}

void ValueTree::scalar(std::string_view text, bool quoted, int line) {
  const auto begin = static_cast<uint32_t>(texts_.size());
  texts_ += text;
  push({.begin = begin,
        .size = static_cast<uint32_t>(text.size()),
        .line = static_cast<uint32_t>(line),
        .quoted = quoted});
}

void ValueTree::open(ValueKind kind, int line) {
  if (open_.size() == max_tree_depth)
    fail("{}:{}: expected lists and maps at most {} deep, got more", *file_, line, max_tree_depth);
  open_.push_back({pending_.size(), static_cast<uint32_t>(line), kind});
}

void ValueTree::check_keys(size_t first) const {
  std::vector<uint32_t> keys((pending_.size() - first) / 2);
  for (size_t i = 0; i < keys.size(); ++i) keys[i] = static_cast<uint32_t>(first + 2 * i);
  const auto text = [&](uint32_t at) { return text_of(pending_[at]); };
  std::ranges::stable_sort(keys, {}, text);
  uint32_t twice = UINT32_MAX;
  for (size_t i = 1; i < keys.size(); ++i)
    if (text(keys[i]) == text(keys[i - 1])) twice = std::min(twice, keys[i]);
  if (twice != UINT32_MAX)
    fail("{}:{}: key {} appears twice", *file_, pending_[twice].line, in_quotes(text(twice)));
}

void ValueTree::close() {
  const Open done = open_.back();
  open_.pop_back();
  const size_t count = pending_.size() - done.first;
  if (done.kind == ValueKind::map) check_keys(done.first);
  const Cell cell{.begin = static_cast<uint32_t>(cells_.size()),
                  .size = static_cast<uint32_t>(done.kind == ValueKind::map ? count / 2 : count),
                  .line = done.line,
                  .kind = done.kind};
  cells_.insert(cells_.end(), pending_.begin() + static_cast<std::ptrdiff_t>(done.first),
                pending_.end());
  pending_.resize(done.first);
  push(cell);
}

void ValueTree::finish() {
  root_ = pending_.front();
  pending_.clear();
  pending_.shrink_to_fit();
}

std::string ValueTree::described(const Cell& cell) const {
  if (cell.kind == ValueKind::list) return fmt::format("a list of {}", cell.size);
  return cell.kind == ValueKind::map ? "a map" : in_quotes(text_of(cell));
}

// --- reading ---

const ValueTree::Cell& ValueTree::cell(uint32_t at) const {
  return at == root_at ? root_ : cells_[at];
}

ValueKind ValueNode::kind() const { return tree_->cell(at_).kind; }

bool ValueNode::quoted() const { return tree_->cell(at_).quoted; }

int ValueNode::line() const { return static_cast<int>(tree_->cell(at_).line); }

std::string_view ValueNode::text() const {
  return kind() == ValueKind::scalar ? tree_->text_of(tree_->cell(at_)) : std::string_view();
}

size_t ValueNode::size() const { return kind() == ValueKind::scalar ? 0 : tree_->cell(at_).size; }

ValueNode ValueNode::item(size_t i) const {
  const auto at = static_cast<uint32_t>(kind() == ValueKind::map ? 2 * i + 1 : i);
  return {*tree_, tree_->cell(at_).begin + at};
}

std::string_view ValueNode::key(size_t i) const {
  return tree_->text_of(tree_->cells_[tree_->cell(at_).begin + 2 * i]);
}

std::optional<ValueNode> ValueNode::find(std::string_view key) const {
  if (kind() != ValueKind::map) return {};
  for (size_t i = 0; i < size(); ++i)
    if (this->key(i) == key) return item(i);
  return {};
}

std::string ValueNode::described() const { return tree_->described(tree_->cell(at_)); }

}  // namespace clench
