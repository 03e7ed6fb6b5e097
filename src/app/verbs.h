// What the command's verbs do. Each returns the exit code: 0 done, 1 failed.
#pragma once
#include <string>
#include <vector>

namespace clench {

struct RunOptions {
  std::vector<std::string> code;       ///< chunks to run first
  std::string file;                    ///< then this, "-" for stdin; empty: none
  std::vector<std::string> arguments;  ///< the file's
  bool console = false;                ///< and then a console
  bool view = false;                   ///< with a window beside it
  std::string confine;                 ///< the folder below which files are read; empty: anywhere
  bool quiet = false;
};

int run_scripts(const RunOptions& options);

/// Runs every *_test.lua below a folder, or one file, each in a Lua of its own.
int run_tests(const std::string& path, const std::string& confine, bool quiet);

/// Writes the API's pages and the editor's stub to a folder; check: compares, and writes nothing.
int write_docs(const std::string& given, bool check);

/// Prints the description of an entry of the API, or of all where the name is empty.
int describe_entry(const std::string& name, bool json);

/// What is said of the files that are read; empty: nothing.
struct ReadingOptions {
  std::string root;     ///< where names in them count from
  std::string folder;   ///< where names in a robot's file are looked up, too
  std::string package;  ///< folder of the packages that a URDF names
  std::string unit;     ///< of a mesh
  std::string confine;  ///< the folder below which files are read
  bool strict = false;  ///< is what is warned of an error?
};

/// As the modules of stdlib/host take them, before all else.
std::vector<std::string> words_of(const ReadingOptions& reading);

struct CheckOptions {
  std::vector<std::string> files;
  ReadingOptions reading;
  bool json = false;
};

/// Reads files of any kind and prints what was parsed, inferred, ignored and wrong.
int check_files(const CheckOptions& options);

struct ConvertOptions {
  std::string from, to;
  std::string format, dof_order;  ///< of lists of grasps; names of DOFs, separated by commas
  ReadingOptions reading;
};

/// Writes what a file holds as another format, and says what that cannot hold.
int convert_file(const ConvertOptions& options);

struct RenderVerbOptions {
  std::vector<std::string> words;  ///< as those of PlanOptions
  ReadingOptions reading;
};

/// Draws a file, or grasps of a list.   returns 2 when an option makes no sense
int render_file(const RenderVerbOptions& options);

struct PlanOptions {
  /// Name, value, name, value ... of the options that are said, as they were typed; the command
  /// line has looked at the numbers.
  std::vector<std::string> words;
  bool quiet = false;
  ReadingOptions reading;
};

/// Searches for grasps of a hand on an object.
/// returns  1 when there are none, 2 when an option makes no sense, 128 + the signal that ended it:
///          130 after Ctrl-C
int plan_grasps(const PlanOptions& options);

struct ServeOptions {
  std::vector<std::string> words;  ///< as those of PlanOptions
  bool quiet = false;
  ReadingOptions reading;
};

/// Lets other programs command a world, until a signal ends it.
int serve_world(const ServeOptions& options);

struct ViewOptions {
  std::vector<std::string> words;  ///< as those of PlanOptions
  bool quiet = false;
  ReadingOptions reading;
};

/// Shows a file or a session in a window, or draws one frame of it.
/// returns  1 if there is no display
int view_world(const ViewOptions& options);

}  // namespace clench
