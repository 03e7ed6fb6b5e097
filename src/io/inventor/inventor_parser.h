// Parses one Inventor or VRML file into nodes.
#pragma once
#include <functional>
#include <map>
#include <optional>

#include "clench/io/inventor/inventor_nodes.h"
#include "clench/io/inventor/inventor_tokens.h"

namespace clench {

/// Counts over all files of a graph, which are limited.
struct InventorBudget {
  int open_nodes = 0;      ///< nodes that contain the current position, in all files and PROTOs
  size_t values = 0;       ///< of fields, read so far
  size_t names = 0;        ///< of nodes
  size_t proto_names = 0;  ///< of PROTOs and their fields
  size_t proto_bytes = 0;  ///< of text read again for PROTOs
};

class InventorParser {
 public:
  /// Returns the root of the file that a node names.
  using Include = std::function<const InventorNode*(const std::string& name, int line)>;

  InventorParser(std::string_view text, int file, InventorGraph& graph, InventorBudget& budget,
                 Include include)
      : graph_(graph),
        budget_(budget),
        file_(file),
        tokens_(text, graph.files[file]),
        include_(std::move(include)) {}

  /// All nodes of the file, in a group.
  const InventorNode* read();

 private:
  using Part = InventorTokens::Part;
  struct Named {
    const InventorNode* node = nullptr;  // null: it was skipped, or is being read
    int open_line = 0;                   // of its DEF, while it is being read
  };
  using Names = std::map<std::string, Named, std::less<>>;
  struct Bracket {
    char text;
    int line;
    std::string type;  // of the node before it
  };
  struct Proto {
    std::map<std::string, std::optional<Part>, std::less<>> fields = {};  // with their defaults
    Part body = {};

    bool has_field(const InventorToken& token) const {
      return token.kind == InventorToken::word && fields.contains(token.text);
    }
  };
  struct Instance {
    const Proto* proto;
    std::map<std::string, Part, std::less<>> values = {};
    Names names = {};
  };

  void open(const InventorToken& bracket, std::string_view type);
  void close(const InventorToken& bracket);
  [[noreturn]] void refuse_end() const;
  InventorToken word(std::string_view what);
  static bool starts_node(const InventorToken& token, const InventorToken& behind) {
    return token.kind == InventorToken::word &&
           (token.text == "DEF" || token.text == "USE" || behind.opens('{'));
  }
  static const InventorField* field_of(const InventorType& type, const InventorToken& token) {
    return token.kind == InventorToken::word ? type.field(token.text) : nullptr;
  }
  void warn(int line, const std::string& sentence);
  Named& define(const InventorToken& name, const Named& named);
  Names& names() { return instance_ ? instance_->names : names_; }

  void statement(const InventorToken& token, std::vector<const InventorNode*>& out);
  const InventorNode* node(const InventorToken& first, const InventorType* around = nullptr);
  const InventorNode* use(int line);
  InventorNode& add_node(const InventorType& type, int line);
  void body(InventorNode& node);
  void include(InventorNode& node);
  void finish(InventorNode& node);

  void field(InventorNode& node, const InventorField& field);
  void skip_connection(const InventorType& type, const InventorField& field);
  /// Warns of a field that the type does not have, and skips its value.
  void skip_unknown_field(const InventorType& type, const InventorToken& name);
  /// Skips one value by syntax alone.   returns  false if no value follows
  bool skip_unknown_value();
  /// Skips a node, or the name of one.
  void skip_node(const InventorToken& first);
  InventorValue value(const InventorType& type, const InventorField& field);
  template <class Take>
  void list(const InventorField& field, Take take);
  float number(const InventorType& type, const InventorField& field,
               const InventorToken& token) const;
  void numbers(const InventorType& type, const InventorField& field, std::vector<float>& out);
  void integers(const InventorType& type, const InventorField& field, std::vector<int32_t>& out);
  void words(const InventorType& type, const InventorField& field, std::vector<std::string>& out);
  void nodes(const InventorField& field, std::vector<const InventorNode*>& out);
  void count_value();
  void count_proto_name();

  /// Skips from the next bracket to the matching one.
  void skip_brackets();
  /// Skips a value of any kind: brackets, a string, or words up to the first for which `ends` is
  /// true.
  Part skip_value(const std::function<bool(const InventorToken&)>& ends);

  void proto(int line);
  void check_nested(const InventorToken& type, const InventorToken& bracket) const;
  const InventorNode* instance(const Proto& proto, const InventorToken& name);
  InventorValue proto_value(const InventorType& type, const InventorField& field);
  /// reads a part of the text; names are looked up in the PROTO instance `scope`, or in the file if
  /// it is null
  template <class Read>
  auto read_part(const Part& part, Instance* scope, Read read);

  InventorGraph& graph_;
  InventorBudget& budget_;
  int file_;
  InventorTokens tokens_;
  Include include_;
  std::vector<Bracket> brackets_;
  Names names_;
  std::map<std::string, Proto, std::less<>> protos_;
  bool in_proto_ = false;         // true while a PROTO is skipped
  Instance* instance_ = nullptr;  // instance whose PROTO is read
};

}  // namespace clench
