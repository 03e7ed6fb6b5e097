// Where the body or robot that a file names is, also when the files around it are of another
// generation.
#pragma once
#include "clench/io/text/find_file.h"

namespace clench {

enum class ModelKind { body, robot };

/// As find_file; where that fails, the same name with another ending of its kind (a body's .iv for
/// .xml, a robot's .cfg for .xml, and back), which is noted. `place` begins the sentence.
/// throws Error as find_file
std::filesystem::path find_converted(const std::string& name, const std::filesystem::path& referrer,
                                     ModelKind kind, const Place& place,
                                     const ReadOptions& options);

/// As find_converted, for names that count from the root; where that fails, below the folders
/// beside the root (without one, beside the folder above the referrer's) whose names begin with the
/// same word, as graspit beside graspit-xml: the generations of a model library often lie side by
/// side. That is told as repaired. No other folder outside the root is looked through.
std::filesystem::path find_model(const std::string& name, const std::filesystem::path& referrer,
                                 ModelKind kind, const Place& place, const ReadOptions& options);

}  // namespace clench
