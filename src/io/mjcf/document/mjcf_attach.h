// The element that an <attach> of MJCF names, and the names of its copies.
#pragma once
#include <string>
#include <vector>

#include "clench/io/mjcf/document/mjcf_document.h"

namespace clench {

/// The body or frame that an <attach> names.
struct AttachTarget {
  const MjcfNode* node = nullptr;  ///< null: all contents of a model
  std::string child_class;         ///< inherited by the copy
};

/// kind      "body" or "frame"
/// searched  number of elements that were compared
/// returns   no node if there is none in the model
AttachTarget find_attach_target(const MjcfNode& model, const std::string& kind,
                                const std::string& name, size_t& searched);

/// Names of all targets of a kind, for messages.
std::vector<std::string> attach_target_names(const MjcfNode& model, const std::string& kind);

/// Renames the attributes of attached elements: names get a prefix, and also those of classes and
/// assets if they belong to another model.
struct AttachedNames {
  std::string prefix;
  bool of_other_model = false;

  std::string class_name(const std::string& name) const;
  std::string operator()(const MjcfNode& node, const std::string& attribute,
                         const std::string& value) const;
};

}  // namespace clench
