// The options of a call: one Lua table, read key by key, in which unread keys are errors. Numbers
// are checked against the ranges in the doc of the running entry, which describes every option.
#pragma once
#include <initializer_list>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "clench/script/lua/check.h"
#include "clench/script/lua/described_options.h"

namespace clench {

/// A word, and its value.
template <class T>
struct Word {
  const char* word;
  T value;
};

/// Words of one kind, as {{"L1", WrenchNorm::l1}, {"Linf", WrenchNorm::linf}} or an array of such.
template <class T>
struct Words : std::span<const Word<T>> {
  using std::span<const Word<T>>::span;
  Words(std::initializer_list<Word<T>> words)
      : std::span<const Word<T>>(words.begin(), words.size()) {}
};

/// The word for a value; the last one if there is none.
template <class T>
const char* word_of(const T& value, std::type_identity_t<Words<T>> words) {
  for (const Word<T>& word : words)
    if (word.value == value) return word.word;
  return words.back().word;
}

/// Messages: "hand:autograsp: speed: expected a number, got 'fast'",
/// "hand:autograsp: unknown key 'sped'; did you mean 'speed'?".
class Table {
 public:
  /// The table at the index, which must stay on the stack; nothing or nil is the empty table.
  /// subject  default: the running entry
  /// throws   Error "...: expected a table of options, got 3"
  Table(lua_State* L, int index, std::string subject = "");

  bool has(const char* key);
  int type(const char* key);  ///< of Lua's
  double number(const char* key);
  double number(const char* key, double fallback);
  int integer(const char* key);
  int integer(const char* key, int fallback);
  uint64_t seed(const char* key, uint64_t fallback);  ///< any Lua integer
  bool boolean(const char* key, bool fallback);
  std::string string(const char* key);
  std::string string(const char* key, const std::string& fallback);
  /// value of one of the words
  /// throws  Error "...: unknown norm 'L3'; did you mean 'L1'?"
  template <class T>
  T choice(const char* key, std::type_identity_t<Words<T>> words, T fallback);
  Eigen::Vector3d vec3(const char* key);
  Eigen::Vector3d vec3(const char* key, const Eigen::Vector3d& fallback);
  Pose pose(const char* key);
  Pose pose(const char* key, const Pose& fallback);
  /// finite numbers; count < 0: any number of them
  std::vector<double> numbers(const char* key, int count = -1);
  Eigen::VectorXd vector(const char* key, int count = -1);
  std::vector<std::vector<double>> rows(const char* key, int columns = -1);
  Eigen::Matrix<double, 6, Eigen::Dynamic> wrenches(const char* key);  ///< rows as columns
  /// Calls read(index, what) with each item of a list.
  template <class Read>
  void each(const char* key, std::string_view expected, Read read);
  /// a userdata, or null if the key is absent
  template <class T>
  T* object(const char* key);
  /// Pushes a function, or nil if absent.
  /// returns  true if there is one
  bool push_function(const char* key);
  /// Pushes the value of the key, for types that have no reader here.
  /// returns  its type
  int push(const char* key);

  lua_State* state() const { return L_; }
  What what(const char* key) const { return {L_, subject_, key}; }
  const std::string& subject() const { return subject_; }

  /// throws Error for a key that was not read; call it last
  void done();

 private:
  [[noreturn]] void refuse(int key) const;
  void check_description() const;
  /// throws Error if the key is absent, and an unread one has a similar name
  void push_required(const char* key);
  template <class T>
  T required(const char* key);
  /// The index of the key's value among the words.
  size_t place_of_word(const char* key, const std::vector<std::string>& words);

  lua_State* L_;
  int index_;  // 0: no table
  std::string subject_;
  std::span<const DescribedOption> described_;  // empty: the doc does not list them
  std::vector<std::string> known_;              // keys that were read
};

template <class T>
T Table::choice(const char* key, std::type_identity_t<Words<T>> words, T fallback) {
  if (!has(key)) return fallback;
  std::vector<std::string> names;
  for (const Word<T>& word : words) names.emplace_back(word.word);
  return words[place_of_word(key, names)].value;
}

template <class Read>
void Table::each(const char* key, std::string_view expected, Read read) {
  push(key);
  each_item(L_, -1, what(key), expected, read);
  lua_pop(L_, 1);
}

template <class T>
T* Table::object(const char* key) {
  T* found = nullptr;
  if (push(key) != LUA_TNIL) {
    found = to<T>(L_, -1);
    if (!found) fail_object(what(key), class_of<T>(), -1);
  }
  lua_pop(L_, 1);  // the table keeps it alive
  return found;
}

}  // namespace clench
