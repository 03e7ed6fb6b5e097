// Verbs of the command. Each returns the exit code: 0 done, 1 failed.
#pragma once
#include <string>
#include <vector>

namespace clench {

struct RunOptions {
  std::vector<std::string> code;       ///< chunks to run first
  std::string file;                    ///< file to run next, "-" for stdin; empty: none
  std::vector<std::string> arguments;  ///< arguments of the file
  bool console = false;                ///< open a console at the end?
  bool view = false;                   ///< open a window next to the console
  std::string confine;  ///< files outside this folder are not read; empty: no restriction
  bool quiet = false;
};

int run_scripts(const RunOptions& options);

/// Runs every *_test.lua below a folder, or one file, each in a separate Lua state.
int run_tests(const std::string& path, const std::string& confine, bool quiet);

/// Writes the API's pages and the editor's stub to a folder; check: only compares them.
int write_docs(const std::string& given, bool check);

/// Prints the description of an entry of the API, or of all if the name is empty.
int describe_entry(const std::string& name, bool json);

/// Options for reading files; empty: not given.
struct ReadingOptions {
  std::string root;     ///< folder that names in them are relative to
  std::string folder;   ///< additional search folder for names in a robot's file
  std::string package;  ///< folder of the packages that a URDF names
  std::string unit;     ///< of a mesh
  std::string confine;  ///< files outside this folder are not read
  bool strict = false;  ///< are warnings errors?
};

/// As arguments of the modules of stdlib/host, which precede all others.
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
  std::string format, dof_order;  ///< for lists of grasps; names of DOFs, separated by commas
  ReadingOptions reading;
};

/// Converts a file to another format, and reports contents that the format cannot represent.
int convert_file(const ConvertOptions& options);

struct RenderVerbOptions {
  std::vector<std::string> words;  ///< as in PlanOptions
  ReadingOptions reading;
};

/// Draws a file, or grasps of a list.
/// returns  2 if an option is invalid
int render_file(const RenderVerbOptions& options);

struct PlanOptions {
  /// Name, value, name, value ... of the given options, as they were typed; numbers have been
  /// checked by the command line.
  std::vector<std::string> words;
  bool quiet = false;
  ReadingOptions reading;
};

/// Searches for grasps of a hand on an object.
/// returns  1 if there are none, 2 if an option is invalid, 128 + the number of the signal that
///          ended it: 130 after Ctrl-C
int plan_grasps(const PlanOptions& options);

struct ServeOptions {
  const char* verb = "serve";      ///< or "mcp"
  std::vector<std::string> words;  ///< as in PlanOptions
  bool quiet = false;
  ReadingOptions reading;
};

/// Serves a world to other programs, until a signal ends it; mcp: until its input ends.
int serve_world(const ServeOptions& options);

struct ViewOptions {
  std::vector<std::string> words;  ///< as in PlanOptions
  bool quiet = false;
  ReadingOptions reading;
};

/// Shows a file or a session in a window, or draws one frame of it.
/// returns  1 if there is no display
int view_world(const ViewOptions& options);

}  // namespace clench
